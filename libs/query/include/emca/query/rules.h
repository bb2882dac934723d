#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/path_set.h"
#include "emca/core/result.h"
#include "emca/query/query.h"

/// Rules (quantity, operator, value), for people who fill in a form: they are written as a query.
namespace emca::query {

/// Of many values of a path: for which of them a rule has to hold. Session files keep the numbers: new ones come last.
enum class Quantifier : std::uint8_t { any, every, none, first, last };

/// Session files keep the numbers: new ones come last.
enum class RuleOperator : std::uint8_t {
    equal, notEqual, less, lessEqual, greater, greaterEqual, oneOf,
    contains, startsWith, matches,
    isTrue, isFalse,
    isNan, isInfinite, isFinite,
    recorded, notRecorded,
};

struct Rule {
    std::string quantity;    ///< a name or an expression: "v.pdf", "luminance(c.value)"
    Quantifier over = Quantifier::any;   ///< not read where a path has one value
    RuleOperator op = RuleOperator::greater;
    std::string value;       ///< of texts: as it is, without quotes; of numbers: an expression; of oneOf: several, with commas
    friend bool operator==(const Rule&, const Rule&) = default;
};

/// What can be asked about values of a type, the usual one first. Of ExpressionType::missing: everything.
std::vector<RuleOperator> operatorsOf(ExpressionType type);
/// "=", "contains", "is NaN", …
const char* label(RuleOperator op);
bool needsValue(RuleOperator op);
/// Nothing is left to fill in.
bool isComplete(const Rule& rule);

/// The condition that a rule stands for: any(v.pdf < 1e-4). \param paths  tell the types of data
/// Errors: invalidArgument (incomplete), parseFailed (quantity or value is no expression).
Result<std::string> toQuery(const Rule& rule, const PathSet& paths);
/// All complete rules, joined by `and`; empty if there are none. Errors: those of the first rule that has one.
Result<std::string> toQuery(std::span<const Rule> rules, const PathSet& paths);

}  // namespace emca::query
