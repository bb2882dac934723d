#include "scene_picker.h"

#include <algorithm>

namespace emca::explorer {
namespace {

std::optional<Index> vertexAmong(const PickContext& c, std::span<const Index> paths, const Projection& projection, double x,
                                 double y) {
    std::vector<Vec3f> points;
    std::vector<Index> vertices;
    for (const Index path : paths) {
        const IndexRange range = c.paths.vertices(path);
        for (Index v = range.first; v < range.last; ++v) {
            points.push_back(c.geometry.points[v]);
            vertices.push_back(v);
        }
    }
    const auto hit = pickPoint(projection, points, x, y, kVertexRadius);
    return hit ? std::optional(vertices[*hit]) : std::nullopt;
}

std::optional<Index> pathAmong(const PickContext& c, std::span<const Index> paths, const Projection& projection, double x,
                               double y) {
    std::vector<PickSegment> segments;
    for (const Index path : paths)
        for (const analysis::Segment& s : c.geometry.segmentsOf(path)) segments.push_back({s.start, s.end, path});
    return pickSegment(projection, segments, x, y, kLineRadius);
}

std::vector<Index> visiblePaths(const PickContext& c) {
    std::vector<Index> all;
    std::ranges::set_union(c.selected, c.drawn, std::back_inserter(all));
    return all;
}

}  // namespace

std::optional<Index> pickVertex(const PickContext& context, const Projection& projection, double x, double y) {
    if (const auto vertex = vertexAmong(context, context.selected, projection, x, y)) return vertex;
    return vertexAmong(context, context.drawn, projection, x, y);
}

std::optional<Picked> pickAt(const PickContext& context, const Projection& projection, double x, double y) {
    for (const std::span<const Index> paths : {context.selected, context.drawn}) {
        if (const auto vertex = vertexAmong(context, paths, projection, x, y))
            return Picked{context.paths.pathOf(*vertex), vertex};
        if (const auto path = pathAmong(context, paths, projection, x, y)) return Picked{*path, std::nullopt};
    }
    return std::nullopt;
}

PickedInside pickInside(const PickContext& context, const Projection& projection, ScreenRect rect) {
    PickedInside inside;
    std::size_t count = 0;
    const std::vector<Index> visible = visiblePaths(context);
    for (const Index path : visible) {
        const IndexRange range = context.paths.vertices(path);
        const auto points = std::span(context.geometry.points).subspan(range.first, range.size());
        const auto hits = pointsInside(projection, points, rect);
        if (hits.empty()) continue;
        inside.paths.push_back(path);
        inside.vertex = range.first + hits.front();
        count += hits.size();
    }
    if (count > 1) inside.vertex.reset();
    if (count > 0) return inside;
    for (const Index path : visible) {
        const auto segments = context.geometry.segmentsOf(path);
        if (std::ranges::any_of(segments, [&](const analysis::Segment& s) { return crosses(projection, s.start, s.end, rect); }))
            inside.paths.push_back(path);
    }
    return inside;
}

}  // namespace emca::explorer
