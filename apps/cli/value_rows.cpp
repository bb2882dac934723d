#include "value_rows.h"

#include <algorithm>

namespace emca::cli {
namespace {

/// Identity of the paths.
query::TableColumn identity(std::string name, const PathSet& paths, auto value) {
    query::TableColumn column{std::move(name), true, {}};
    column.values.type = query::ExpressionType::number;
    for (Index path = 0; path < paths.pathCount(); ++path) column.values.numbers.push_back(static_cast<double>(value(path)));
    column.values.known.assign(paths.pathCount(), 1);
    return column;
}

}  // namespace

Result<ValueQueries> parseValues(const std::vector<std::string>& expressions) {
    ValueQueries values;
    for (const std::string& expression : expressions) {
        query::QueryError where;
        auto parsed = query::Query::parse(expression, &where);
        if (!parsed) return Error{parsed.error().code, parsed.error().message + "\n" + query::pointAt(expression, where.where)};
        for (const std::string& column : parsed->columns())
            if (std::find(values.columns.begin(), values.columns.end(), column) == values.columns.end()) values.columns.push_back(column);
        values.queries.push_back(std::move(*parsed));
    }
    return values;
}

Result<query::TableRows> valueRows(const ValueQueries& values, const PathSet& paths) {
    query::TableRows rows;
    rows.rowCount = paths.pathCount();
    rows.columns.push_back(identity("sample", paths, [&](Index path) { return paths.sample(path); }));
    bool parts = false;
    for (Index path = 0; path < paths.pathCount(); ++path) parts |= paths.part(path) != 0;
    if (parts) rows.columns.push_back(identity("part", paths, [&](Index path) { return paths.part(path); }));
    for (const query::Query& query : values.queries) {
        auto column = query.evaluate(paths);
        if (!column) return column.error();
        for (const std::string& name : column->missing)
            if (std::find(rows.missing.begin(), rows.missing.end(), name) == rows.missing.end()) rows.missing.push_back(name);
        rows.columns.push_back({query.text(), false, std::move(*column)});
    }
    return rows;
}

}  // namespace emca::cli
