#include "query_rows.h"

#include <cmath>
#include <span>

#include "csv.h"
#include "emca/analysis/format.h"
#include "table.h"

namespace emca::cli {
namespace {

using query::ExpressionType;
using query::PathValues;
using query::TableColumn;
using query::TableRows;

bool isNumber(const PathValues& values) { return values.type == ExpressionType::number; }

std::span<const double> numbers(const PathValues& values, std::size_t row) {
    const auto components = static_cast<std::size_t>(values.components);
    return std::span(values.numbers).subspan(row * components, components);
}

/// Counts in full, other numbers by `format`.
template <typename Format>
std::string cell(const PathValues& values, std::size_t row, const char* unknown, const Format& format) {
    if (row >= values.known.size() || !values.known[row] || values.type == ExpressionType::missing) return unknown;
    if (values.type == ExpressionType::text) return values.texts[row];
    if (values.type == ExpressionType::boolean) return values.numbers[row] != 0 ? "true" : "false";
    std::string text;
    for (const double v : numbers(values, row)) text += (text.empty() ? "" : ", ") + format(v);
    return isNumber(values) ? text : "(" + text + ")";
}

std::string shortNumber(double value) {
    const bool whole = std::abs(value) < 1e15 && value == std::floor(value);
    return whole ? analysis::formatInteger(static_cast<std::int64_t>(value)) : analysis::formatNumber(value);
}

Json json(const PathValues& values, std::size_t row) {
    if (row >= values.known.size() || !values.known[row] || values.type == ExpressionType::missing) return nullptr;
    if (values.type == ExpressionType::text) return values.texts[row];
    if (values.type == ExpressionType::boolean) return values.numbers[row] != 0;
    if (isNumber(values)) return toJson(values.numbers[row]);
    Json array = Json::array();
    for (const double v : numbers(values, row)) array.push_back(toJson(v));
    return array;
}

}  // namespace

std::string rowsText(const TableRows& rows) {
    std::vector<Table::Column> columns;
    for (const TableColumn& column : rows.columns)
        columns.push_back({column.name, isNumber(column.values) ? Table::Align::right : Table::Align::left});
    Table table(std::move(columns));
    for (std::size_t row = 0; row < rows.rowCount; ++row) {
        std::vector<std::string> cells;
        for (const TableColumn& column : rows.columns) cells.push_back(cell(column.values, row, "-", shortNumber));
        table.add(std::move(cells));
    }
    return table.text();
}

std::string rowsCsv(const TableRows& rows) {
    std::vector<std::string> cells;
    for (const TableColumn& column : rows.columns) cells.push_back(column.name);
    std::string text = csvLine(cells);
    for (std::size_t row = 0; row < rows.rowCount; ++row) {
        cells.clear();
        for (const TableColumn& column : rows.columns)
            cells.push_back(cell(column.values, row, "", [](double v) { return analysis::formatFull(v); }));
        text += csvLine(cells);
    }
    return text;
}

Json rowsJson(const TableRows& rows) {
    Json out = Json::array();
    for (std::size_t row = 0; row < rows.rowCount; ++row) {
        Json one = Json::object();
        for (const TableColumn& column : rows.columns) one[column.name] = json(column.values, row);
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace emca::cli
