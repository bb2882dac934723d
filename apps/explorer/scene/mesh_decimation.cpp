#include "mesh_decimation.h"

#include <algorithm>
#include <cmath>

#include "place_table.h"

namespace emca::explorer {
namespace {

struct Cluster {
    Vec3f position, normal;
    float r = 0, g = 0, b = 0;
    std::uint32_t count = 0;
};

/// Which cluster each vertex is in.
std::vector<std::uint32_t> assign(const ShadedTriangles& full, std::uint32_t cells, std::vector<Cluster>& clusters) {
    BoundingBox box;
    for (const Vec3f& p : full.positions) box.extend(p);
    const Vec3f extent = box.max - box.min;
    const double longest = std::max({double(extent.x), double(extent.y), double(extent.z), 1e-30});
    const double scale = double(std::min(cells, 1u << 20)) / longest;
    const auto step = [scale](float v, float min) {
        return std::clamp<std::int64_t>(static_cast<std::int64_t>((double(v) - double(min)) * scale), 0, PlaceTable::kLargest);
    };
    PlaceTable places(std::min<std::size_t>(full.positions.size(), std::size_t(cells) * cells));
    std::vector<std::uint32_t> numbers(full.positions.size());
    for (std::size_t i = 0; i < full.positions.size(); ++i) {
        const Vec3f p = full.positions[i];
        const auto [number, isNew] = places.number(PlaceTable::key(step(p.x, box.min.x), step(p.y, box.min.y), step(p.z, box.min.z)));
        if (isNew) clusters.emplace_back();
        Cluster& c = clusters[number];
        c.position += p - box.min;   // small numbers: sums of many stay exact enough
        c.normal += full.normals[i];
        c.r += full.colors[i][0];
        c.g += full.colors[i][1];
        c.b += full.colors[i][2];
        ++c.count;
        numbers[i] = number;
    }
    for (Cluster& c : clusters) c.position = box.min + c.position / float(c.count);
    return numbers;
}

/// Rotated so that the smallest comes first: the same triangle whichever corner it began with, its side kept.
Triangle turned(Triangle t) {
    while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
    return t;
}

}  // namespace

ShadedTriangles clustered(const ShadedTriangles& full, std::uint32_t cells) {
    ShadedTriangles out;
    if (full.triangles.empty()) return out;
    std::vector<Cluster> clusters;
    const std::vector<std::uint32_t> numbers = assign(full, std::max(cells, 1u), clusters);
    for (const Triangle& t : full.triangles) {
        const Triangle made{numbers[t[0]], numbers[t[1]], numbers[t[2]]};
        if (made[0] != made[1] && made[1] != made[2] && made[2] != made[0]) out.triangles.push_back(turned(made));
    }
    std::sort(out.triangles.begin(), out.triangles.end());
    out.triangles.erase(std::unique(out.triangles.begin(), out.triangles.end()), out.triangles.end());
    out.positions.reserve(clusters.size());
    out.normals.reserve(clusters.size());
    out.colors.reserve(clusters.size());
    for (const Cluster& c : clusters) {
        const float n = float(c.count);
        const auto channel = [n](float sum) { return static_cast<std::uint8_t>(std::lround(sum / n)); };
        out.positions.push_back(c.position);
        // Two sides of a thin wall in one cell have opposite normals, and none together.
        out.normals.push_back(dot(c.normal, c.normal) > 1e-6f * n * n ? normalize(c.normal) : Vec3f{0, 0, 1});
        out.colors.push_back({channel(c.r), channel(c.g), channel(c.b)});
    }
    return out;
}

ShadedTriangles standIn(const ShadedTriangles& full, std::size_t wanted, const std::atomic<bool>* cancel) {
    // Of a surface, the triangles that remain grow with the square of the number of cells.
    auto cells = static_cast<std::uint32_t>(std::clamp(0.45 * std::sqrt(double(wanted)), 8.0, 4096.0));
    ShadedTriangles best = clustered(full, cells);
    for (int round = 0; round < 3 && !(cancel && *cancel); ++round) {
        const double ratio = double(wanted) / double(std::max<std::size_t>(best.triangles.size(), 1));
        if (ratio > 0.5 && ratio < 2.5) break;
        const auto next = static_cast<std::uint32_t>(std::clamp(double(cells) * std::sqrt(ratio), 4.0, 16384.0));
        if (next == cells) break;
        cells = next;
        best = clustered(full, cells);
    }
    return best;
}

}  // namespace emca::explorer
