#include "emca/query/rules.h"

#include <algorithm>
#include <cstdlib>

#include "emca/query/vocabulary.h"
#include "operand.h"

namespace emca::query {
namespace {

using detail::operand;

bool isBlank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

bool isNumber(const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return !isBlank(text) && isBlank(end);
}

std::vector<std::string> listed(std::string_view values) {
    std::vector<std::string> out;
    while (true) {
        const auto comma = values.find(',');
        std::string_view one = values.substr(0, comma);
        while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
        while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
        if (!one.empty()) out.emplace_back(one);
        if (comma == values.npos) return out;
        values.remove_prefix(comma + 1);
    }
}

/// A value as it stands in a query. What was not recorded may be anything: then what looks like no number is a text.
Result<std::string> literal(const std::string& value, ExpressionType type) {
    if (type == ExpressionType::text || (type == ExpressionType::missing && !isNumber(value))) return quotedText(value);
    return operand(value);
}

const char* symbol(RuleOperator op) {
    switch (op) {
        case RuleOperator::equal: return " == ";
        case RuleOperator::notEqual: return " != ";
        case RuleOperator::less: return " < ";
        case RuleOperator::lessEqual: return " <= ";
        case RuleOperator::greater: return " > ";
        default: return " >= ";
    }
}

/// The condition on one value, of which `x` is the expression.
Result<std::string> condition(const std::string& x, const Rule& rule, ExpressionType type) {
    switch (rule.op) {
        case RuleOperator::isTrue: return x;
        case RuleOperator::isFalse: return "not " + x;
        case RuleOperator::isNan: return "nan(" + x + ")";
        case RuleOperator::isInfinite: return "inf(" + x + ")";
        case RuleOperator::isFinite: return "finite(" + x + ")";
        case RuleOperator::recorded: return "has(" + x + ")";
        case RuleOperator::notRecorded: return "not has(" + x + ")";
        case RuleOperator::contains: return "contains(" + x + ", " + quotedText(rule.value) + ")";
        case RuleOperator::startsWith: return "starts_with(" + x + ", " + quotedText(rule.value) + ")";
        case RuleOperator::matches: return "matches(" + x + ", " + quotedText(rule.value) + ")";
        case RuleOperator::oneOf: {
            std::string all;
            for (const std::string& value : listed(rule.value)) {
                const auto one = literal(value, type);
                if (!one) return one;
                all += (all.empty() ? "" : ", ") + *one;
            }
            return x + " in (" + all + ")";
        }
        default: {
            const auto value = literal(rule.value, type);
            if (!value) return value;
            return x + symbol(rule.op) + *value;
        }
    }
}

}  // namespace

std::vector<RuleOperator> operatorsOf(ExpressionType type) {
    using enum RuleOperator;
    switch (type) {
        case ExpressionType::boolean: return {isTrue, isFalse, recorded, notRecorded};
        case ExpressionType::number: return {greater, greaterEqual, less, lessEqual, equal, notEqual, oneOf, isNan, isInfinite, isFinite, recorded, notRecorded};
        case ExpressionType::text: return {equal, notEqual, oneOf, contains, startsWith, matches, recorded, notRecorded};
        case ExpressionType::color:
        case ExpressionType::vector: return {isNan, isInfinite, isFinite, equal, notEqual, recorded, notRecorded};
        case ExpressionType::spectrum: return {isNan, isInfinite, isFinite, recorded, notRecorded};
        case ExpressionType::missing: break;
    }
    return {greater, greaterEqual, less, lessEqual, equal, notEqual, oneOf, contains, startsWith, matches, isTrue, isFalse,
            isNan, isInfinite, isFinite, recorded, notRecorded};
}

const char* label(RuleOperator op) {
    switch (op) {
        case RuleOperator::equal: return "=";
        case RuleOperator::notEqual: return "≠";
        case RuleOperator::less: return "<";
        case RuleOperator::lessEqual: return "≤";
        case RuleOperator::greater: return ">";
        case RuleOperator::greaterEqual: return "≥";
        case RuleOperator::oneOf: return "is one of";
        case RuleOperator::contains: return "contains";
        case RuleOperator::startsWith: return "begins with";
        case RuleOperator::matches: return "matches";
        case RuleOperator::isTrue: return "is true";
        case RuleOperator::isFalse: return "is false";
        case RuleOperator::isNan: return "is NaN";
        case RuleOperator::isInfinite: return "is infinite";
        case RuleOperator::isFinite: return "is finite";
        case RuleOperator::recorded: return "is recorded";
        case RuleOperator::notRecorded: return "is not recorded";
    }
    return "";
}

bool needsValue(RuleOperator op) { return op < RuleOperator::isTrue; }

bool isComplete(const Rule& rule) {
    if (isBlank(rule.quantity)) return false;
    if (rule.op == RuleOperator::oneOf) return !listed(rule.value).empty();
    return !needsValue(rule.op) || !isBlank(rule.value);
}

Result<std::string> toQuery(const Rule& rule, const PathSet& paths) {
    if (!isComplete(rule)) return Error{ErrorCode::invalidArgument, "The rule is not complete: it needs a quantity, an operator and a value."};
    const auto quantity = describe(rule.quantity, paths);
    if (!quantity) return quantity.error();
    const auto x = operand(quantity->expression);
    if (!x) return x;
    if (quantity->owner == Owner::path) return condition(*x, rule, quantity->type);
    const bool presence = rule.op == RuleOperator::recorded || rule.op == RuleOperator::notRecorded;
    if ((rule.over == Quantifier::first || rule.over == Quantifier::last) && !presence)
        return condition((rule.over == Quantifier::first ? "first(" : "last(") + *x + ")", rule, quantity->type);
    const auto inner = condition(*x, rule, quantity->type);
    if (!inner) return inner;
    const char* over = rule.over == Quantifier::every ? "all(" : rule.over == Quantifier::none ? "none(" : "any(";
    return over + *inner + ")";
}

Result<std::string> toQuery(std::span<const Rule> rules, const PathSet& paths) {
    std::string all;
    for (const Rule& rule : rules) {
        if (!isComplete(rule)) continue;
        const auto one = toQuery(rule, paths);
        if (!one) return one;
        all += (all.empty() ? "" : " and ") + *one;
    }
    return all;
}

}  // namespace emca::query
