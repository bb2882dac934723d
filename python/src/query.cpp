// The query language over received paths.
#include "emca/query/query.h"

#include "arrays.h"
#include "bindings.h"
#include "emca/query/table.h"
#include "waiting.h"

namespace emca::python {
namespace {

template <typename T>
T checked(Result<T> result, const std::string& text, const query::QueryError& where) {
    if (!result.ok() && result.error().code == ErrorCode::parseFailed)
        throw Failure(result.error(), text, where.where.begin, where.where.end);
    return unwrap(std::move(result));
}

template <typename What>
What parsed(const std::string& text) {
    query::QueryError where;
    return checked(What::parse(text, &where), text, where);
}

/// Evaluates without the interpreter's lock, until it is done or Ctrl-C is pressed.
template <typename Evaluate>
auto evaluated(const std::string& text, const Evaluate& evaluate) {
    query::QueryError where;
    std::optional<std::invoke_result_t<Evaluate, const query::EvaluationLimits&, query::QueryError*>> result;
    runInterruptibly([&](const client::RequestObserver& observer) {
        query::EvaluationLimits limits;
        limits.cancelled = [cancel = observer.cancel] { return cancel->load(); };
        result.emplace(evaluate(limits, &where));
    });
    return checked(std::move(*result), text, where);
}

/// (type, values or list of texts, known)
py::tuple toTuple(query::PathValues values) {
    const char* type = name(values.type);
    py::object entries;
    if (values.type == query::ExpressionType::text)
        entries = toList(values.texts);
    else
        entries =
            moved(std::move(values.numbers), Number::float64, static_cast<std::size_t>(std::max(1, values.components)));
    return py::make_tuple(type, entries, moved(std::move(values.known), Number::boolean));
}

py::tuple select(const PathSet& paths, const std::string& text) {
    const auto query = parsed<query::Query>(text);
    query::Matches found =
        evaluated(text, [&](const auto& limits, auto* where) { return query.select(paths, limits, where); });
    return py::make_tuple(moved(std::move(found.paths), Number::uint32), found.unknown, toList(found.missing));
}

py::tuple evaluate(const PathSet& paths, const std::string& text) {
    const auto query = parsed<query::Query>(text);
    query::PathValues values =
        evaluated(text, [&](const auto& limits, auto* where) { return query.evaluate(paths, limits, where); });
    const py::list missing = toList(values.missing);
    return py::make_tuple(toTuple(std::move(values)), missing);
}

/// (columns as (name, key, type, values, known), number of rows, missing names)
py::tuple table(const PathSet& paths, const std::string& text) {
    const auto query = parsed<query::Table>(text);
    query::TableRows rows =
        evaluated(text, [&](const auto& limits, auto* where) { return query.evaluate(paths, limits, where); });
    py::list columns;
    for (query::TableColumn& column : rows.columns)
        columns.append(py::make_tuple(toText(column.name), column.key, toTuple(std::move(column.values))));
    return py::make_tuple(columns, rows.rowCount, toList(rows.missing));
}

}  // namespace

void bindQuery(py::module_& module) {
    module.def("select", &select);
    module.def("evaluate", &evaluate);
    module.def("table", &table);
    module.def("query_columns", [](const std::string& text) { return toList(parsed<query::Query>(text).columns()); });
    module.def("quoted_name", [](const std::string& text) { return query::quotedName(text); });
    module.def("quoted_text", [](const std::string& text) { return query::quotedText(text); });
}

}  // namespace emca::python
