#include "surface_data.h"

#include <algorithm>

#include "emca/core/surface_tree.h"

namespace emca::explorer {
namespace {

void append(std::vector<Vec3f>& positions, std::vector<Triangle>& triangles, const std::vector<Vec3f>& morePositions,
            const std::vector<Triangle>& moreTriangles) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), morePositions.begin(), morePositions.end());
    for (const Triangle& t : moreTriangles) {
        // An index beyond the vertices: nothing is drawn, but its place is kept.
        const bool usable = t[0] < morePositions.size() && t[1] < morePositions.size() && t[2] < morePositions.size();
        triangles.push_back(usable ? Triangle{base + t[0], base + t[1], base + t[2]} : Triangle{0, 0, 0});
    }
}

Result<void> appendRefined(PreparedSurface& s, const std::atomic<bool>* cancel) {
    for (std::size_t m = 0; m < s.field->meshes.size(); ++m) {
        if (cancel && *cancel) return {};
        const SurfaceMesh& data = s.field->meshes[m];
        if (data.faceCount == 0) continue;
        const Mesh& mesh = (*s.meshes)[m];
        auto locator = SurfaceLocator::make(mesh.triangles.size(), data.subdivision);
        if (!locator) return locator.error();
        s.locators[m] = std::move(*locator);
        if (const auto refined = refine(mesh, data.subdivision)) append(s.positions, s.triangles, refined->positions, refined->triangles);
        else s.triangles.resize(s.triangles.size() + data.faceCount, Triangle{0, 0, 0});   // faulty mesh: values without a place
    }
    s.dataFaces = s.triangles.size();
    return {};
}

/// Walks one base face down to `depth` divisions; what is below is counted, not drawn.
struct CoarseWalk {
    PreparedSurface& s;
    detail::SubdivisionReader reader;
    std::uint32_t depth;
    std::uint32_t next = 0;   ///< data face that comes next

    void face(std::uint32_t level, Vec3f a, Vec3f b, Vec3f c) {
        if (level == depth) {
            draw(a, b, c);
            skip(level);
        } else if (!reader.divided(level)) {
            draw(a, b, c);
            ++next;
        } else {
            const Vec3f ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
            face(level + 1, a, ab, ca);
            face(level + 1, ab, b, bc);
            face(level + 1, ca, bc, c);
            face(level + 1, bc, ca, ab);
        }
    }
    void skip(std::uint32_t level) {
        if (!reader.divided(level)) ++next;
        else for (int i = 0; i < 4; ++i) skip(level + 1);
    }
    void draw(Vec3f a, Vec3f b, Vec3f c) {
        const auto base = static_cast<std::uint32_t>(s.coarsePositions.size());
        s.coarsePositions.insert(s.coarsePositions.end(), {a, b, c});
        s.coarseTriangles.push_back({base, base + 1, base + 2});
        s.coarseFirst.push_back(next);
    }
};

/// Faces of a field whose trees are cut below `depth` divisions, for every depth.
void countLevels(detail::SubdivisionReader& reader, std::uint32_t level, std::array<std::size_t, kMaxSurfaceLevel + 1>& upTo) {
    if (!reader.divided(level)) {
        for (std::uint32_t d = level; d <= kMaxSurfaceLevel; ++d) ++upTo[d];
        return;
    }
    ++upTo[level];
    for (int i = 0; i < 4; ++i) countLevels(reader, level + 1, upTo);
}

void makeCoarse(PreparedSurface& s, const std::atomic<bool>* cancel) {
    if (s.dataFaces <= kCoarseAbove || (cancel && *cancel)) return;
    std::array<std::size_t, kMaxSurfaceLevel + 1> upTo{};
    for (std::size_t m = 0; m < s.field->meshes.size(); ++m) {
        if (s.field->meshes[m].faceCount == 0) continue;
        detail::SubdivisionReader reader(s.field->meshes[m].subdivision.bits);
        for (std::size_t f = 0; f < (*s.meshes)[m].triangles.size(); ++f) countLevels(reader, 0, upTo);
    }
    std::uint32_t depth = 0;
    while (depth < kMaxSurfaceLevel && upTo[depth + 1] <= kCoarseFaces) ++depth;
    if (upTo[depth] > s.dataFaces / 2) return;   // large by itself: coarser cannot be had this way
    std::uint32_t next = 0;
    for (std::size_t m = 0; m < s.field->meshes.size(); ++m) {
        if (s.field->meshes[m].faceCount == 0) continue;
        const Mesh& mesh = (*s.meshes)[m];
        CoarseWalk walk{s, detail::SubdivisionReader(s.field->meshes[m].subdivision.bits), depth, next};
        const auto at = [&](std::uint32_t v) { return v < mesh.positions.size() ? mesh.positions[v] : Vec3f(); };
        for (const Triangle& t : mesh.triangles) walk.face(0, at(t[0]), at(t[1]), at(t[2]));
        next = walk.next;
    }
    s.coarseFirst.push_back(next);
}

}  // namespace

Result<std::shared_ptr<const PreparedSurface>> prepareSurface(std::shared_ptr<const std::vector<Mesh>> meshes,
                                                              std::shared_ptr<const SurfaceField> field, double lower,
                                                              double upper, const std::atomic<bool>* cancel) {
    if (const auto valid = validate(*field, *meshes); !valid) return valid.error();
    auto s = std::make_shared<PreparedSurface>();
    s->meshes = std::move(meshes);
    s->field = std::move(field);
    s->locators.resize(s->meshes->size());
    if (const auto refined = appendRefined(*s, cancel); !refined) return refined.error();
    makeCoarse(*s, cancel);
    for (std::size_t m = 0; m < s->meshes->size(); ++m) {
        if (s->field->meshes[m].faceCount > 0) continue;
        const Mesh& mesh = (*s->meshes)[m];
        append(s->positions, s->triangles, mesh.positions, mesh.triangles);
        if (!s->coarseFirst.empty()) append(s->coarsePositions, s->coarseTriangles, mesh.positions, mesh.triangles);
    }
    s->picker = SurfacePicker(s->meshes);
    s->areas = analysis::surfaceAreas(*s->field, *s->meshes);
    for (std::size_t i = 0; i < s->field->layers.size(); ++i) {
        if (cancel && *cancel) break;
        const SurfaceLayerData& layer = s->field->layers[i];
        LayerNumbers& numbers = s->layers.emplace_back();
        if (layer.description.kind == LayerKind::meanColor) numbers.scalars = analysis::surfaceScalars(layer);
        const std::span<const float> values = s->scalars(i);
        numbers.statistics = analysis::surfaceStatistics(values, s->areas);
        numbers.lower = lower;
        numbers.upper = upper;
        numbers.linear = analysis::surfaceRange(values, s->areas, rangeOptions(layer.description.kind, lower, upper, false));
        numbers.log = analysis::surfaceRange(values, s->areas, rangeOptions(layer.description.kind, lower, upper, true));
    }
    return std::shared_ptr<const PreparedSurface>(std::move(s));
}

analysis::SurfaceRangeOptions rangeOptions(LayerKind kind, double lower, double upper, bool log) {
    analysis::SurfaceRangeOptions options = analysis::surfaceRangeOptions(kind);
    options.lower = lower;
    options.upper = upper;
    options.log = log;
    return options;
}

std::vector<analysis::Color8> coarseColors(const PreparedSurface& surface, std::span<const analysis::Color8> colors) {
    std::vector<analysis::Color8> coarse;
    if (surface.coarseFirst.empty()) return coarse;
    coarse.reserve(surface.coarseFirst.size() - 1);
    for (std::size_t i = 0; i + 1 < surface.coarseFirst.size(); ++i) {
        std::uint32_t r = 0, g = 0, b = 0;
        const std::uint32_t first = surface.coarseFirst[i], last = surface.coarseFirst[i + 1];
        for (std::uint32_t f = first; f < last; ++f) r += colors[f].r, g += colors[f].g, b += colors[f].b;
        const std::uint32_t n = std::max(last - first, 1u);
        coarse.push_back({static_cast<std::uint8_t>(r / n), static_cast<std::uint8_t>(g / n), static_cast<std::uint8_t>(b / n)});
    }
    return coarse;
}

}  // namespace emca::explorer
