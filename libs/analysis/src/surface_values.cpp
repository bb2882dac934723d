#include "emca/analysis/surface_values.h"

#include <algorithm>
#include <cmath>

#include "emca/core/surface_tree.h"

namespace emca::analysis {
namespace {

double triangleArea(const Mesh& mesh, const Triangle& t) {
    for (const std::uint32_t vertex : t) if (vertex >= mesh.positions.size()) return 0;
    const Vec3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const auto edge = [&](const Vec3f& to) {
        return Vec3<double>{static_cast<double>(to.x) - static_cast<double>(a.x), static_cast<double>(to.y) - static_cast<double>(a.y),
                            static_cast<double>(to.z) - static_cast<double>(a.z)};
    };
    const double area = length(cross(edge(b), edge(c))) / 2;
    return std::isfinite(area) ? area : 0;
}

/// Appends the areas of all that one triangle of the scene was divided into, in pre-order.
void appendAreas(detail::SubdivisionReader& reader, double area, std::uint32_t level, std::vector<float>& out) {
    if (!reader.divided(level)) {
        out.push_back(static_cast<float>(area));
        return;
    }
    for (int part = 0; part < 4; ++part) appendAreas(reader, area / 4, level + 1, out);
}

struct Weighted {
    float value;
    float weight;
};

/// The smallest value such that at least the share p of the weight is not above it. By selection: sorting a million
/// faces takes longer than a frame. Changes the order of the entries.
double weightedQuantile(std::vector<Weighted>& entries, double total, double p) {
    const double target = p * total;
    double below = 0;  // weight of all before `first`
    auto first = entries.begin(), last = entries.end();
    while (last - first > 1) {
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
        double left = 0;
        for (auto entry = first; entry != middle; ++entry) left += static_cast<double>(entry->weight);
        if (below + left >= target) {
            last = middle;
        } else {
            below += left;
            first = middle;
        }
    }
    return static_cast<double>(first->value);
}

}  // namespace

std::vector<float> surfaceAreas(const SurfaceField& field, std::span<const Mesh> meshes) {
    std::vector<float> areas;
    areas.reserve(field.faceCount());
    for (std::size_t m = 0; m < field.meshes.size() && m < meshes.size(); ++m) {
        if (field.meshes[m].faceCount == 0) continue;
        detail::SubdivisionReader reader(field.meshes[m].subdivision.bits);
        for (const Triangle& triangle : meshes[m].triangles) appendAreas(reader, triangleArea(meshes[m], triangle), 0, areas);
    }
    return areas;
}

std::vector<float> surfaceScalars(const SurfaceLayerData& layer) {
    if (layer.description.kind != LayerKind::meanColor) return {layer.values.begin(), layer.values.end()};
    std::vector<float> scalars(layer.values.size() / 3);
    for (std::size_t i = 0; i < scalars.size(); ++i) {
        scalars[i] = luminance(Color(layer.values[3 * i], layer.values[3 * i + 1], layer.values[3 * i + 2]));
    }
    return scalars;
}

ValueRange surfaceRange(std::span<const float> values, std::span<const float> areas, const SurfaceRangeOptions& options) {
    std::vector<Weighted> entries;
    entries.reserve(values.size());
    double total = 0;
    const auto counts = [&](float v) { return std::isfinite(v) && (!options.log || v > 0) && (options.zeros || v != 0); };
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!counts(values[i])) continue;
        const float weight = i < areas.size() ? areas[i] : areas.empty() ? 1.f : 0.f;
        if (!(weight > 0)) continue;
        entries.push_back({values[i], weight});
        total += static_cast<double>(weight);
    }
    if (entries.empty()) {
        // Values on faces without area only: they count alike.
        const bool anywhere = std::any_of(values.begin(), values.end(), counts);
        if (!areas.empty() && anywhere) return surfaceRange(values, {}, options);
        return options.log ? ValueRange{1e-3, 1, true} : ValueRange{};
    }
    const double low = weightedQuantile(entries, total, options.lower), high = weightedQuantile(entries, total, options.upper);
    return ValueRange{low, high, options.log}.repaired();
}

SurfaceStatistics surfaceStatistics(std::span<const float> values, std::span<const float> areas) {
    SurfaceStatistics s;
    s.faces = values.size();
    double sumOfSquares = 0;  // of distances from the running mean, weighted: West 1979
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        const double value = static_cast<double>(values[i]);
        const double weight = i < areas.size() ? static_cast<double>(areas[i]) : areas.empty() ? 1.0 : 0.0;
        s.min = s.finite == 0 ? value : std::min(s.min, value);
        s.max = s.finite == 0 ? value : std::max(s.max, value);
        ++s.finite;
        if (!(weight > 0)) continue;
        s.area += weight;
        s.integral += value * weight;
        const double distance = value - s.mean;
        s.mean += distance * weight / s.area;
        sumOfSquares += weight * distance * (value - s.mean);
    }
    if (s.area > 0) s.deviation = std::sqrt(std::max(0.0, sumOfSquares / s.area));
    return s;
}

std::vector<Color8> surfaceColors(std::span<const float> values, const ColorMap& map, const ValueRange& range) {
    std::vector<Color8> colors;
    colors.reserve(values.size());
    for (const float value : values) {
        colors.push_back(std::isnan(value) ? kNoDataColor : map.map(static_cast<double>(value), range));
    }
    return colors;
}

std::vector<Color8> surfaceColors(const SurfaceLayerData& layer, const ToneMapper& tones) {
    std::vector<Color8> colors(layer.values.size() / channelCount(layer.description.kind));
    const bool isColor = channelCount(layer.description.kind) == 3;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Color value = isColor ? Color(layer.values[3 * i], layer.values[3 * i + 1], layer.values[3 * i + 2]) : Color(layer.values[i]);
        const bool none = std::isnan(value.r) || std::isnan(value.g) || std::isnan(value.b);
        colors[i] = none ? kNoDataColor : tones.color(value);
    }
    return colors;
}

}  // namespace emca::analysis
