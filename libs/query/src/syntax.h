#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emca/query/query.h"

namespace emca::query::detail {

using Type = ExpressionType;

/// What one value of an expression belongs to, from the widest to the narrowest. Contributions and shadow tests both
/// belong to vertices and have nothing to do with each other.
enum class Domain : std::uint8_t { constant, pixel, path, vertex, contribution, nextEvent };
inline constexpr std::size_t kDomainCount = 6;

Domain parent(Domain domain);
/// True if every `inner` belongs to one `outer`, or they are the same.
bool encloses(Domain outer, Domain inner);
/// The prefix of names of this domain in queries: "v", "c", "n"; empty for paths.
const char* prefix(Domain domain);

/// Quantities that every renderer records under the same name (DESIGN: core names win over user names).
enum class Core : std::uint8_t {
    pixel, sample, part, origin, estimate, luminance, depth, vertices, contributions, splats,
    vertexDepth, vertexIndex, position, segment, vertexEstimate, vertexLuminance, emission, mesh, face, event, lobe, label,
    environment, subpath, isLast,
    value, valueLuminance, technique, weight, end, contributionDepth,
    nextEventPosition, visible, nextEventDepth,
};

struct CoreName {
    const char* name;
    Domain domain;
    Core core;
    Type type;
    int components;
    const char* columns;     ///< those it is recorded in, separated by commas; empty: always there
    const char* meaning;
};
const std::vector<CoreName>& coreNames();
const CoreName* findCore(Domain domain, std::string_view name);

enum class Op : std::uint8_t {
    // operators
    negate, invert, add, subtract, multiply, divide, modulo, power, less, lessEqual, greater, greaterEqual, equal,
    notEqual, both, either, in,
    // functions of values that belong together
    luminance, abs, sqrt, exp, log, log2, log10, floor, ceil, round, sin, cos, tan, asin, acos, atan, atan2, minimum,
    maximum, clamp, length, distance, dot, cross, normalize, makeVector, makeColor, isNan, isInf, isFinite, has,
    contains, startsWith, matches, choose, member, subscript,
    // reductions
    any, all, none, count, first, last, sum, mean, variance, least, greatest, quantile,
};

struct Function {
    const char* name;
    Op op;
    int minimumArguments, maximumArguments;    ///< -1: any number
    const char* meaning;
};
const std::vector<Function>& functions();
/// Functions with one name differ in their numbers of arguments (min and max also reduce).
const Function* findFunction(std::string_view name, std::size_t arguments);
bool isReduction(Op op);

enum class Kind : std::uint8_t { number, boolean, text, core, user, lightPath, operation, reduction };

class LightPathExpression;

/// A node of the syntax tree; the last group is filled in by check().
struct Node {
    Kind kind = Kind::number;
    SourceRange where;
    Op op = Op::add;
    double number = 0;               ///< of numbers and booleans; subscript and member: which component
    std::string text;                ///< text, name of user data, light path expression, name of a function
    Core core = Core::luminance;
    Domain scope = Domain::constant; ///< of core quantities and user data
    std::vector<Node> children;
    std::shared_ptr<const LightPathExpression> lightPath;  ///< see prepare()

    Type type = Type::missing;
    int components = 1;              ///< of vectors and colours
    bool single = false;             ///< floats as recorded: numbers that it is compared with are rounded to float
    Domain domain = Domain::constant;
    Domain argument = Domain::path;  ///< of reductions: over what they go
};

/// True of words that stand for something else than a quantity: and, true, pi, v, …
bool hasMeaning(std::string_view word);
/// Parses an expression. False: `error` says why not.
bool parseExpression(std::string_view text, Node& root, QueryError& error);

/// A column of a table, the whole of it being the aggregate: `mean(v.pdf)`; or a plain expression that it is grouped by.
struct TableSyntax {
    struct Item {
        Node value;
        std::string label;           ///< the piece of text, or what follows `as`
    };
    std::vector<Item> columns, groups;
    std::optional<Node> where;
};
bool parseTable(std::string_view text, TableSyntax& table, QueryError& error);

}  // namespace emca::query::detail
