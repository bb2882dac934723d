#include "paths/value_rules.h"

#include <cmath>
#include <type_traits>
#include <variant>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/core/event.h"
#include "emca/query/vocabulary.h"

namespace emca::explorer {
namespace {

using query::RuleOperator;
using Kind = Entry::Kind;

std::vector<ValueRule> ofText(const std::string& quantity, std::string_view text) {
    return {valueRule(quantity, RuleOperator::equal, std::string(text), QStringLiteral("“%1”").arg(toQString(text)))};
}

std::vector<ValueRule> ofTruth(const std::string& quantity, bool value) {
    return {valueRule(quantity, value ? RuleOperator::isTrue : RuleOperator::isFalse, {}, {})};
}

std::vector<ValueRule> ofInteger(const std::string& quantity, std::int64_t value) {
    const std::string full = std::to_string(value);
    const QString shown = toQString(analysis::formatInteger(value));
    return {valueRule(quantity, RuleOperator::equal, full, shown), valueRule(quantity, RuleOperator::greaterEqual, full, shown),
            valueRule(quantity, RuleOperator::lessEqual, full, shown)};
}

std::vector<ValueRule> ofColor(const std::string& quantity, Color color) {
    // Computed as the query does it, in double and in this order, so that "=" finds the value itself.
    double sum = 0.2126 * double(color.r);
    sum += 0.7152 * double(color.g);
    sum += 0.0722 * double(color.b);
    return rulesForNumber("luminance(" + quantity + ")", sum);
}

/// How a query names the data of a column.
std::string expressionOf(const PathSet& paths, std::uint32_t column) {
    const auto all = query::dataOf(paths);
    const auto columns = paths.userColumns();
    std::size_t position = 0;
    for (std::uint32_t c = 1; c <= column; ++c)   // columns of one name, by type, are neighbours and one quantity
        position += columns[c].name != columns[c - 1].name || columns[c].scope != columns[c - 1].scope;
    return position < all.size() ? all[position].expression : std::string();
}

std::vector<ValueRule> ofData(const PathSet& paths, const Entry& entry) {
    const std::string name = expressionOf(paths, entry.column);
    if (name.empty()) return {};
    return std::visit([&](const auto& value) -> std::vector<ValueRule> {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, bool>) return ofTruth(name, value);
        else if constexpr (std::is_integral_v<T>) return ofInteger(name, static_cast<std::int64_t>(value));
        else if constexpr (std::is_floating_point_v<T>) return rulesForNumber(name, double(value));
        else if constexpr (std::is_same_v<T, Color>) return ofColor(name, value);
        else if constexpr (std::is_convertible_v<T, std::string_view>) return ofText(name, value);
        else return {};
    }, paths.value(paths.userColumns()[entry.column], entry.item));
}

std::vector<ValueRule> joined(std::vector<ValueRule> a, std::vector<ValueRule> b) {
    a.insert(a.end(), std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()));
    return a;
}

}  // namespace

std::vector<ValueRule> rulesForVertex(const PathSet& paths, Index vertex) {
    std::vector<ValueRule> rules;
    if (const auto scattering = paths.scattering(vertex)) {
        if (!scattering->label.empty()) rules = ofText("v.label", scattering->label);
        if (scattering->lobe != Lobe::none) rules = joined(std::move(rules), ofText("v.lobe", name(scattering->lobe)));
        rules = joined(std::move(rules), ofText("v.event", name(scattering->event)));
    }
    return joined(std::move(rules), {ofInteger("v.depth", paths.depthIndex(vertex)).front()});
}

std::vector<ValueRule> rulesFor(const PathSet& paths, const Entry& entry) {
    switch (entry.kind) {
        case Kind::finalEstimate:
        case Kind::luminance:
            if (const auto estimate = paths.estimate(entry.owner)) return rulesForNumber("luminance", double(luminance(*estimate)));
            break;
        case Kind::depth: return ofInteger("depth", paths.depth(entry.owner));
        case Kind::estimate:
            if (const auto estimate = paths.vertexEstimate(entry.owner)) return ofColor("v.estimate", *estimate);
            break;
        case Kind::emission:
            if (const auto emission = paths.emission(entry.owner)) return ofColor("v.emission", *emission);
            break;
        case Kind::contribution: {
            const Contribution& contribution = paths.contribution(entry.item);
            auto rules = joined(ofText("c.technique", paths.text(contribution.technique)), ofColor("c.value", contribution.value));
            if (!std::isnan(contribution.misWeight)) rules = joined(std::move(rules), rulesForNumber("c.weight", double(contribution.misWeight)));
            return rules;
        }
        case Kind::nextEvent: return ofTruth("n.visible", paths.nextEvent(entry.item).visible != 0);
        case Kind::data: return ofData(paths, entry);
        case Kind::origin: case Kind::splat: case Kind::position: case Kind::surface: break;
    }
    return {};
}

}  // namespace emca::explorer
