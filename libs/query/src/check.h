#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "emca/core/path_set.h"
#include "syntax.h"

namespace emca::query::detail {

/// What is known of user data before it is evaluated.
struct UserType {
    Type type = Type::missing;
    int components = 1;
    bool single = false;     ///< all of it is float
};

/// The type of user data of one scope and name. `wantsText`: it is compared with a text, where a name has several types.
using UserTypes = std::function<UserType(Domain scope, const std::string& name, bool wantsText)>;

/// The types that a set of paths has recorded.
UserTypes typesOf(const PathSet& paths);
/// Before there is a set: everything may be anything.
UserTypes anyTypes();

/// Fills in types and domains. False: `error` says what does not fit. Afterwards root.domain is pixel, path or constant.
bool check(Node& root, const UserTypes& types, QueryError& error);
/// The same inside an aggregate over rows of `domain` and in what rows are grouped by: root.domain may be anything that
/// encloses it.
bool checkWithin(Node& root, Domain domain, const UserTypes& types, QueryError& error);

/// Checks a column of a table whose rows are elements of `rows`: its outermost reductions become aggregates over rows,
/// and what stands outside of them must be the same for a whole group.
bool checkAggregate(Node& root, Domain rows, const UserTypes& types, QueryError& error);

/// The narrowest domain that a node names outside of reductions. False: it mixes contributions and shadow tests.
bool directDomain(const Node& node, Domain& domain, QueryError& error);

/// Sorted names of the recorded columns that are read.
std::vector<std::string> columnsOf(const Node& root);
/// True if a reduction goes over the paths of a pixel.
bool readsWholePixels(const Node& root);

/// True if a value type counts as this type in queries.
UserType userTypeOf(ValueType type);

}  // namespace emca::query::detail
