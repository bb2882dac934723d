#include "quantities.h"

#include <algorithm>
#include <cmath>

#include "emca/analysis/format.h"

namespace emca::intersection_data {
namespace {

Kind kindOf(ValueType type) {
    switch (type) {
        case ValueType::text: return Kind::text;
        case ValueType::spectrum: return Kind::spectrum;
        case ValueType::color: case ValueType::colorA: return Kind::color;
        default: break;
    }
    const int components = componentCount(type);
    return components == 2 ? Kind::point : components == 3 ? Kind::vector : Kind::scalar;
}

bool isIntegral(ValueType type) {
    return type == ValueType::boolean || type == ValueType::integer || type == ValueType::integer2 || type == ValueType::integer3;
}

std::size_t wordIndex(std::vector<std::string>& words, const std::string& word) {
    const auto found = std::find(words.begin(), words.end(), word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    words.push_back(word);
    return words.size() - 1;
}

/// The numbers of a value; a colour's alpha is no channel of light.
std::vector<double> numbersOf(const Value& value, ValueType type) {
    std::size_t count = static_cast<std::size_t>(componentCount(type));
    if (type == ValueType::colorA) count = 3;
    if (const auto* spectrum = std::get_if<std::vector<float>>(&value)) count = spectrum->size();
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = component(value, i);
    return numbers;
}

Quantity quantityOf(const PathSet& paths, IndexRange vertices, const Column& column) {
    Quantity quantity{column.name, "", kindOf(column.type), isIntegral(column.type), {}, {}};
    if (column.type == ValueType::boolean) quantity.words = {"false", "true"};
    for (Index vertex = vertices.first; vertex < vertices.last; ++vertex) {
        const IndexRange values = column.valuesOf(vertex);
        for (Index i = values.first; i < values.last; ++i) {
            const Value value = paths.value(column, i);
            if (const auto* text = std::get_if<std::string>(&value))
                quantity.entries.push_back({vertex, {double(wordIndex(quantity.words, *text))}});
            else quantity.entries.push_back({vertex, numbersOf(value, column.type)});
        }
    }
    return quantity;
}

std::vector<double> channels(Color c) { return {double(c.r), double(c.g), double(c.b)}; }

void appendIfAny(std::vector<Quantity>& all, Quantity quantity) {
    if (!quantity.entries.empty()) all.push_back(std::move(quantity));
}

void appendCore(const PathSet& paths, IndexRange vertices, std::vector<Quantity>& all) {
    const std::string radiance = "W/(sr m²)";
    Quantity estimate{"estimate so far", radiance, Kind::color, false, {}, {}}, emission{"emission", radiance, Kind::color, false, {}, {}};
    Quantity contribution{"contribution", radiance, Kind::color, false, {}, {}}, weight{"MIS weight", "", Kind::scalar, false, {}, {}};
    for (Index vertex = vertices.first; vertex < vertices.last; ++vertex) {
        if (const auto value = paths.vertexEstimate(vertex)) estimate.entries.push_back({vertex, channels(*value)});
        if (const auto value = paths.emission(vertex)) emission.entries.push_back({vertex, channels(*value)});
        const IndexRange added = paths.contributions(vertex);
        for (Index i = added.first; i < added.last; ++i) {
            contribution.entries.push_back({vertex, channels(paths.contribution(i).value)});
            if (!std::isnan(paths.contribution(i).misWeight)) weight.entries.push_back({vertex, {double(paths.contribution(i).misWeight)}});
        }
    }
    for (Quantity* quantity : {&estimate, &emission, &contribution, &weight}) appendIfAny(all, std::move(*quantity));
}

}  // namespace

std::string Quantity::valueAt(Index vertex) const {
    const auto last = std::find_if(entries.rbegin(), entries.rend(), [&](const Entry& entry) { return entry.vertex == vertex; });
    if (last == entries.rend()) return {};
    const std::vector<double>& n = last->numbers;
    if (!words.empty()) {
        const auto word = static_cast<std::size_t>(n.front());
        return word < words.size() ? words[word] : std::string();
    }
    std::string text;
    for (std::size_t i = 0; i < n.size() && i < 4; ++i)
        text += (i ? "  " : "") + (integral ? analysis::formatInteger(static_cast<std::int64_t>(n[i])) : analysis::formatNumber(n[i]));
    return n.size() > 4 ? text + " … (" + std::to_string(n.size()) + ")" : text;
}

std::vector<Quantity> quantitiesOf(const PathSet& paths, Index path) {
    std::vector<Quantity> all;
    const IndexRange vertices = paths.vertices(path);
    for (const Column& column : paths.userColumns())
        if (column.scope == Scope::vertex) appendIfAny(all, quantityOf(paths, vertices, column));
    appendCore(paths, vertices, all);
    return all;
}

}  // namespace emca::intersection_data
