#include "emca/query/axis.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "operand.h"

namespace emca::query {
namespace {

std::string shortest(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end.ptr};
}

/// Values are places in a list, whether or not any path has one.
bool isList(const AxisValues& axis) { return axis.type == ExpressionType::text || axis.type == ExpressionType::boolean; }

bool allWhole(const AxisValues& axis) {
    for (std::size_t i = 0; i < axis.size(); ++i)
        if (axis.known[i] && std::isfinite(axis.numbers[i]) && axis.numbers[i] != std::floor(axis.numbers[i])) return false;
    return true;
}

void categorize(std::vector<std::string>& texts, AxisValues& axis) {
    std::map<std::string, double> places;
    for (std::size_t i = 0; i < texts.size(); ++i)
        if (axis.known[i]) places.emplace(texts[i], 0);
    for (auto& [text, place] : places) {
        place = static_cast<double>(axis.categories.size());
        axis.categories.push_back(text);
    }
    axis.numbers.resize(texts.size(), 0);
    for (std::size_t i = 0; i < texts.size(); ++i)
        if (axis.known[i]) axis.numbers[i] = places[texts[i]];
}

/// Categories of which a brush holds the place.
std::vector<std::string> chosen(const AxisValues& values, std::span<const Brush> brushes) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < values.categories.size(); ++i)
        if (std::any_of(brushes.begin(), brushes.end(), [&](const Brush& b) { return b.contains(static_cast<double>(i), true); }))
            texts.push_back(values.categories[i]);
    return texts;
}

/// Of whole numbers the ends are whole: 2.7 to 5.2 is 3 to 5.
Brush tidied(Brush brush, const AxisValues& values) {
    if (!values.integral) return brush;
    brush.low = std::ceil(brush.low);
    brush.high = std::floor(brush.high);
    return brush;
}

std::string intervalQuery(const std::string& x, const Brush& brush) {
    if (brush.low == brush.high) return x + " == " + shortest(brush.low);
    const bool from = std::isfinite(brush.low), to = std::isfinite(brush.high);
    if (!from && !to) return "not nan(" + x + ")";
    const std::string low = from ? x + " >= " + shortest(brush.low) : "", high = to ? x + " <= " + shortest(brush.high) : "";
    return from && to ? low + " and " + high : low + high;
}

std::string conditionOf(const std::string& x, const AxisValues& values, std::span<const Brush> brushes, bool& several) {
    std::vector<std::string> parts;
    if (isList(values)) {
        const std::vector<std::string> texts = chosen(values, brushes);
        if (values.type == ExpressionType::boolean && texts.size() == 2) parts.push_back("has(" + x + ")");
        else if (values.type == ExpressionType::boolean && texts.size() == 1) parts.push_back(texts[0] == "true" ? x : "not " + x);
        else if (texts.size() == 1) parts.push_back(x + " == " + quotedText(texts[0]));
        else if (!texts.empty()) {
            std::string list;
            for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + quotedText(text);
            parts.push_back(x + " in (" + list + ")");
        }
    } else {
        for (const Brush& brush : brushes)
            if (const Brush tidy = tidied(brush, values); tidy.hasNumbers()) parts.push_back(intervalQuery(x, tidy));
        if (std::any_of(brushes.begin(), brushes.end(), [](const Brush& b) { return b.nan; })) parts.push_back("nan(" + x + ")");
    }
    if (std::any_of(brushes.begin(), brushes.end(), [](const Brush& b) { return b.missing; })) parts.push_back("not has(" + x + ")");
    several = parts.size() > 1;
    if (parts.empty()) return "false";
    std::string all;
    for (const std::string& part : parts) all += (all.empty() ? "" : " or ") + (several ? "(" + part + ")" : part);
    return all;
}

}  // namespace

Result<AxisValues> axisValues(const Query& query, const PathSet& paths, const EvaluationLimits& limits) {
    auto values = query.evaluate(paths, limits);
    if (!values) return values.error();
    if (values->type == ExpressionType::color || values->type == ExpressionType::vector)
        return Error{ErrorCode::parseFailed,
                     "The expression gives a " + std::string(name(values->type)) + ": an axis needs one number, such as " +
                         (values->type == ExpressionType::color ? "luminance(" + query.text() + ")." : "length(" + query.text() + ").")};
    AxisValues axis;
    axis.type = values->type;
    axis.known = std::move(values->known);
    if (axis.type == ExpressionType::text) {
        categorize(values->texts, axis);
    } else {
        axis.numbers = std::move(values->numbers);
        if (axis.type == ExpressionType::boolean) axis.categories = {"false", "true"};
    }
    axis.numbers.resize(axis.known.size(), 0);
    axis.integral = allWhole(axis);
    return axis;
}

std::vector<Index> brushedPaths(std::span<const BrushedAxis> axes, Index pathCount) {
    std::vector<std::uint8_t> taken(pathCount, 1);
    for (const BrushedAxis& axis : axes) {
        if (axis.brushes.empty() || !axis.values) continue;
        const Index count = std::min<Index>(pathCount, static_cast<Index>(axis.values->size()));
        for (Index path = 0; path < count; ++path) {
            if (!taken[path]) continue;
            const double value = axis.values->numbers[path];
            const bool known = axis.values->known[path] != 0;
            taken[path] = std::any_of(axis.brushes.begin(), axis.brushes.end(), [&](const Brush& b) { return b.contains(value, known); });
        }
    }
    std::vector<Index> paths;
    for (Index path = 0; path < pathCount; ++path)
        if (taken[path]) paths.push_back(path);
    return paths;
}

std::string brushQuery(std::string_view expression, const AxisValues& values, std::span<const Brush> brushes) {
    if (brushes.empty()) return {};
    const auto x = detail::operand(expression);
    bool several = false;
    const std::string condition = conditionOf(x ? *x : std::string(expression), values, brushes, several);
    return several ? "(" + condition + ")" : condition;
}

std::optional<std::vector<Rule>> brushRules(std::string_view expression, const AxisValues& values, std::span<const Brush> brushes) {
    const std::string x(expression);
    const auto rule = [&](RuleOperator op, std::string value = {}) { return Rule{x, Quantifier::any, op, std::move(value)}; };
    if (brushes.empty()) return std::vector<Rule>{};
    const auto has = [&](auto test) { return std::any_of(brushes.begin(), brushes.end(), test); };
    const bool missing = has([](const Brush& b) { return b.missing; }), nan = has([](const Brush& b) { return b.nan; });
    if (isList(values)) {
        const std::vector<std::string> texts = chosen(values, brushes);
        if (missing) return texts.empty() ? std::optional(std::vector{rule(RuleOperator::notRecorded)}) : std::nullopt;
        if (texts.empty()) return std::nullopt;
        if (values.type == ExpressionType::boolean)
            return std::vector{rule(texts.size() == 2 ? RuleOperator::recorded : texts[0] == "true" ? RuleOperator::isTrue : RuleOperator::isFalse)};
        std::string list;
        for (const std::string& text : texts) {
            // A list is cut at commas and its blanks are dropped; `==` takes the text as it is.
            if (texts.size() > 1 && (text.find(',') != text.npos || text.empty() || text.front() == ' ' || text.back() == ' ')) return std::nullopt;
            list += (list.empty() ? "" : ", ") + text;
        }
        return std::vector{rule(texts.size() == 1 ? RuleOperator::equal : RuleOperator::oneOf, list)};
    }
    std::vector<Brush> intervals;
    for (const Brush& brush : brushes)
        if (const Brush tidy = tidied(brush, values); tidy.hasNumbers()) intervals.push_back(tidy);
    if (intervals.size() + nan + missing != 1) return std::nullopt;
    if (nan) return std::vector{rule(RuleOperator::isNan)};
    if (missing) return std::vector{rule(RuleOperator::notRecorded)};
    const Brush& only = intervals.front();
    if (only.low == only.high) return std::vector{rule(RuleOperator::equal, shortest(only.low))};
    std::vector<Rule> rules;
    if (std::isfinite(only.low)) rules.push_back(rule(RuleOperator::greaterEqual, shortest(only.low)));
    if (std::isfinite(only.high)) rules.push_back(rule(RuleOperator::lessEqual, shortest(only.high)));
    if (rules.empty()) return std::nullopt;
    return rules;
}

}  // namespace emca::query
