#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/path_set.h"
#include "emca/core/result.h"

/// The path query language (docs/queries.md): parsed once, evaluated column by column, wherever the paths are.
namespace emca::query {

/// Bytes of the query's text: first and past-the-end.
struct SourceRange {
    std::uint32_t begin = 0, end = 0;
    friend bool operator==(const SourceRange&, const SourceRange&) = default;
};

struct QueryError {
    std::string message;    ///< what was found and what was expected, without full stop
    SourceRange where;      ///< the piece of the query that it is about
};

/// The error as one sentence for people: "At character 12 (…): …."
Error toError(std::string_view query, const QueryError& error);
/// The query and below it a line with ^ under the piece that is wrong.
std::string pointAt(std::string_view query, SourceRange where);

/// What bounds an evaluation.
struct EvaluationLimits {
    std::function<bool()> cancelled;           ///< asked every few thousand vertices; may be empty
    std::size_t temporaryBytes = 256u << 20;   ///< of intermediate results; beyond: tooLarge
};

/// The outcome of a query on a set of paths.
struct Matches {
    std::vector<Index> paths;            ///< for which the query is true; positions in the set, ascending
    Index unknown = 0;                   ///< paths for which it is neither true nor false: something was not recorded
    std::vector<std::string> missing;    ///< names that the query reads and the set does not have
};

/// The type of what an expression gives.
enum class ExpressionType : std::uint8_t {
    missing = 0,  ///< of a name that was not recorded, or (before evaluation) that only a set of paths can tell
    boolean, number, color, vector, text, spectrum,
};
const char* name(ExpressionType type);

/// One value per path of an expression that is no condition.
struct PathValues {
    ExpressionType type = ExpressionType::missing;
    int components = 1;                  ///< numbers per path: 3 or 4 of colours, 2 or 3 of vectors, 0 of texts
    std::vector<double> numbers;         ///< components entries per path; booleans are 0 and 1
    std::vector<std::string> texts;      ///< only of texts
    std::vector<std::uint8_t> known;     ///< 1 per path that has a value
    std::vector<std::string> missing;
};

namespace detail {
struct Node;
}

/// An expression over a path and its vertices: immutable, cheap to copy, safe to use from several threads.
///
///     auto glossy = Query::parse("any(v.lobe == \"glossy\" and v.`BSDF pdf` < 1e-4) and luminance > 10");
///     auto matches = glossy->select(paths);
///
/// Semantics (DESIGN): three-valued logic after Kleene; a value that was not recorded is unknown; NaN is a value.
class Query {
  public:
    /// Longer or deeper queries are refused: they come over the network.
    static constexpr std::size_t kMaximumLength = 64 << 10, kMaximumNodes = 4096, kMaximumDepth = 200;

    /// Errors: parseFailed (a sentence that names the character); `where`, if given, then has the same for programs.
    static Result<Query> parse(std::string_view text, QueryError* where = nullptr);

    const std::string& text() const { return text_; }
    /// What a recording needs so that the query can be answered: names as in RecordingOptions::columns; never empty.
    const std::vector<std::string>& columns() const { return columns_; }
    /// True if other paths of the pixel decide about a path (`luminance > 10 * mean(luminance)`).
    bool readsWholePixels() const { return wholePixels_; }

    /// The paths for which the query is true. Errors: parseFailed (types do not fit what was recorded, or no condition),
    /// tooLarge, cancelled.
    Result<Matches> select(const PathSet& paths, const EvaluationLimits& limits = {}, QueryError* where = nullptr) const;
    /// The value of the expression for every path. Errors: as select().
    Result<PathValues> evaluate(const PathSet& paths, const EvaluationLimits& limits = {}, QueryError* where = nullptr) const;

  private:
    friend class Table;
    std::string text_;
    std::vector<std::string> columns_;
    bool wholePixels_ = false;
    std::shared_ptr<const detail::Node> root_;
};

/// `text` as it stands in a query after `v.`, or alone for a path's value: in backquotes where needed.
std::string quotedName(std::string_view text);
/// `text` as a text in quotes.
std::string quotedText(std::string_view text);

}  // namespace emca::query
