#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/path_set.h"
#include "emca/core/result.h"
#include "emca/query/query.h"

/// What a query may name: for completion, help and forms that write queries.
namespace emca::query {

/// What has the values of an expression: a path has one, of the others it has many.
enum class Owner : std::uint8_t { path, vertex, contribution, shadowTest };

struct Quantity {
    std::string expression;    ///< as it stands in a query: luminance, v.depth, v.`BSDF pdf`
    Owner owner = Owner::path;
    ExpressionType type = ExpressionType::missing;
    int components = 1;        ///< numbers of a value: 3 or 4 of colours, 2 or 3 of vectors, 0 of texts and spectra
    std::string meaning;       ///< of core quantities: a few words; empty for data
    bool data = false;         ///< recorded by the renderer under a name of its own
};

/// Those that every renderer records under the same name, in the order of docs/queries.md.
std::vector<Quantity> coreQuantities();

/// Data that the paths have under names of the renderer, of paths first, by name; each once.
std::vector<Quantity> dataOf(const PathSet& paths);

/// The numbers inside of a colour or vector (`v.throughput.r`, `luminance(v.throughput)`, `length(v.normal)`); none of
/// other types.
std::vector<Quantity> partsOf(const Quantity& quantity);

/// What an expression gives, with the types that `paths` recorded; Quantity::expression is the text without blanks around it.
/// Errors: parseFailed (a sentence that names the character); `where`, if given, then has the same for programs.
Result<Quantity> describe(std::string_view expression, const PathSet& paths, QueryError* where = nullptr);

/// The different texts that an expression gives, most frequent first. Empty if it gives no texts.
std::vector<std::string> textsOf(std::string_view expression, const PathSet& paths, std::size_t maximum = 200);

struct FunctionName {
    std::string name;
    int minimumArguments = 0, maximumArguments = 0;  ///< -1: any number
    std::string meaning;                             ///< a few words, or empty
};
/// Those of docs/queries.md; `min` and `max` occur twice, of two numbers and of many values.
std::vector<FunctionName> functionNames();

}  // namespace emca::query
