#include "path_coloring.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "base/qt_compat.h"
#include "base/seen_on.h"
#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "emca/query/vertex_values.h"
#include "emca/query/vocabulary.h"

namespace emca::explorer {
namespace {

/// One number of a colour (luminance, Rec. 709) or vector (length).
double numberOf(const query::PathValues& values, std::size_t i) {
    const auto n = static_cast<std::size_t>(std::max(values.components, 1));
    const double* v = values.numbers.data() + i * n;
    if (values.type == query::ExpressionType::color) return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
    if (values.type != query::ExpressionType::vector) return v[0];
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += v[c] * v[c];
    return std::sqrt(sum);
}

bool sameSet(const PathSet& a, const PathSet& b) {
    return a.vertexCount() == b.vertexCount() && a.columns().depths.data() == b.columns().depths.data() &&
           a.columns().pixels.data() == b.columns().pixels.data();
}

}  // namespace

void PathColoring::update(const PathSet& paths, const PathColorStyle& style, const QColor& ground) {
    const bool stale = style.quantity != style_.quantity || !sameSet(paths, paths_);
    if (!stale && style == style_ && ground == ground_) return;
    style_ = style;
    ground_ = ground;
    if (stale) evaluate(paths);
    recolor();
}

void PathColoring::evaluate(const PathSet& paths) {
    paths_ = paths;
    values_.clear();
    known_.clear();
    categories_.clear();
    error_.clear();
    integral_ = false;
    if (style_.quantity.empty() || paths.empty()) return;
    const auto result = query::vertexValues(style_.quantity, paths);
    if (!result) {
        error_ = toQString(result.error().message);
        return;
    }
    known_ = result->known;
    if (std::ranges::find(known_, 1) == known_.end()) {
        error_ = QString("No vertex of these paths has %1.").arg(toQString(style_.quantity));
        known_.clear();
        return;
    }
    values_.resize(paths.vertexCount());
    if (result->type == query::ExpressionType::text) {
        std::map<std::string, double> numbers;
        for (std::size_t i = 0; i < values_.size(); ++i)
            if (known_[i]) numbers.emplace(result->texts[i], 0);
        for (auto& [text, number] : numbers) {
            number = double(categories_.size());
            categories_.push_back(text);
        }
        for (std::size_t i = 0; i < values_.size(); ++i)
            if (known_[i]) values_[i] = numbers[result->texts[i]];
        return;
    }
    for (std::size_t i = 0; i < values_.size(); ++i)
        if (known_[i]) values_[i] = numberOf(*result, i);
    integral_ = true;
    for (std::size_t i = 0; i < values_.size() && integral_; ++i) integral_ = !known_[i] || !std::isfinite(values_[i]) || values_[i] == std::floor(values_[i]);
}

void PathColoring::recolor() {
    colors_.clear();
    range_ = {};
    if (values_.empty()) return;
    if (!categories_.empty()) {
        range_ = analysis::ValueRange{0, double(std::max<std::size_t>(categories_.size() - 1, 1)), false};
    } else if (style_.limits) {
        range_ = analysis::ValueRange{style_.limits->min, style_.limits->max, style_.log}.repaired();
    } else {
        std::vector<double> present;
        present.reserve(values_.size());
        for (std::size_t i = 0; i < values_.size(); ++i)
            if (known_[i]) present.push_back(values_[i]);
        analysis::RobustRangeOptions options;
        options.log = style_.log;
        options.margin = 0;
        range_ = analysis::robustRange(present, options).range;
    }
    const analysis::ColorMap& map = analysis::ColorMap::get(style_.map);
    colors_.resize(values_.size());
    // A map has few colours, and there may be half a million vertices.
    std::unordered_map<std::uint32_t, analysis::Color8> seen;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const analysis::Color8 c = map.map(values_[i], range_);
        const auto [found, added] = seen.try_emplace(std::uint32_t(c.r) << 16 | std::uint32_t(c.g) << 8 | c.b, c);
        if (added && ground_.isValid()) found->second = seenOn(c, ground_);
        colors_[i] = found->second;
    }
}

QString PathColoring::title() const { return toQString(style_.quantity); }

QColor PathColoring::categoryColor(std::size_t category) const {
    analysis::Color8 c = analysis::ColorMap::get(style_.map).map(double(category), range_);
    if (ground_.isValid()) c = seenOn(c, ground_);
    return {c.r, c.g, c.b};
}

std::optional<double> PathColoring::value(Index vertex) const {
    return vertex < known_.size() && known_[vertex] ? std::optional(values_[vertex]) : std::nullopt;
}

std::string PathColoring::text(Index vertex) const {
    const auto v = value(vertex);
    if (!v) return {};
    return categories_.empty() ? analysis::formatNumber(*v) : categories_[static_cast<std::size_t>(*v)];
}

QColor PathColoring::color(Index vertex, const QColor& otherwise) const {
    if (colors_.empty()) return otherwise;
    if (vertex < known_.size() && known_[vertex]) return {colors_[vertex].r, colors_[vertex].g, colors_[vertex].b};
    QColor none = otherwise;
    none.setAlphaF(0.35 * none.alphaF());
    return none;
}

std::vector<std::string> colorableQuantities(const PathSet& paths) {
    using query::ExpressionType;
    std::vector<std::string> names;
    const auto add = [&](const query::Quantity& q) {
        const bool single = q.owner == query::Owner::path || q.owner == query::Owner::vertex;
        if (!single || q.type == ExpressionType::spectrum || q.type == ExpressionType::missing) return;
        names.push_back(q.expression);
        if (q.type == ExpressionType::color || q.type == ExpressionType::vector)
            for (const query::Quantity& part : query::partsOf(q)) names.push_back(part.expression);
    };
    for (const query::Quantity& q : query::coreQuantities()) add(q);
    for (const query::Quantity& q : query::dataOf(paths)) add(q);
    return names;
}

}  // namespace emca::explorer
