#pragma once

#include <string>
#include <vector>

#include "emca/query/table.h"

namespace emca::cli {

/// Expressions over a path, as `emca pixel --value` takes them.
struct ValueQueries {
    std::vector<query::Query> queries;
    std::vector<std::string> columns;   ///< what a recording needs so that they can be answered
};
/// Errors: parseFailed (a sentence that names expression and character).
Result<ValueQueries> parseValues(const std::vector<std::string>& expressions);

/// A row per path: sample (with part and pixel where they differ), then the value of each expression. Like the axes of
/// the explorer's parallel coordinates. Errors: as Query::evaluate.
Result<query::TableRows> valueRows(const ValueQueries& values, const PathSet& paths);

}  // namespace emca::cli
