#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emca/query/query.h"

namespace emca::query {

namespace detail {
struct TableSyntax;
}

/// A column of a result: as many values as there are rows.
struct TableColumn {
    std::string name;          ///< the expression as written, or what follows `as`
    bool key = false;          ///< rows are grouped by it
    PathValues values;         ///< one per row
};

struct TableRows {
    std::vector<TableColumn> columns;       ///< keys first, unless the query lists them elsewhere
    std::size_t rowCount = 0;               ///< groups, ordered by their keys; 1 without group by
    std::vector<std::string> missing;       ///< names that were not recorded
};

/// Aggregates over paths, vertices, contributions or shadow tests, in groups:
///
///     count(), mean(luminance), quantile(luminance, 0.99) as p99 group by depth where luminance > 0
///     sum(luminance(c.value)) group by c.technique, c.depth
///
/// What is aggregated are paths, unless v., c. or n. is named outside of a nested reduction: then it is those. `where`
/// takes the ones for which it is true. Immutable and cheap to copy.
class Table {
  public:
    /// Errors: as Query::parse.
    static Result<Table> parse(std::string_view text, QueryError* where = nullptr);
    const std::string& text() const { return text_; }
    /// As Query::columns.
    const std::vector<std::string>& columns() const { return columns_; }

    /// Errors: as Query::select. Needs memory for the values of all rows that `where` takes, within the limits.
    Result<TableRows> evaluate(const PathSet& paths, const EvaluationLimits& limits = {}, QueryError* where = nullptr) const;

  private:
    std::string text_;
    std::vector<std::string> columns_;
    std::shared_ptr<const detail::TableSyntax> syntax_;
};

}  // namespace emca::query
