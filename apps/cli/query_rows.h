#pragma once

#include <string>

#include "emca/query/table.h"
#include "json.h"

// The rows of a query's table, as every command shows them. A value that nothing is known of is "-", empty or null.
namespace emca::cli {

std::string rowsText(const query::TableRows& rows);
std::string rowsCsv(const query::TableRows& rows);
/// One object per row, members named as the columns.
Json rowsJson(const query::TableRows& rows);

}  // namespace emca::cli
