#include "path_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace emca::explorer {
namespace {

BoundingBox boxOfPaths(const PathSet& paths) {
    BoundingBox box;
    for (Index v = 0; v < paths.vertexCount(); ++v) {
        if (paths.isEnvironment(v)) continue;
        if (const auto p = paths.position(v); p && isFinite(*p)) box.extend(*p);
    }
    return box;
}

/// Brings the far end of a segment into the picture.
class Placement {
  public:
    explicit Placement(const BoundingBox& box)
        : centre_(box.empty ? Vec3d{} : Vec3d{box.centre().x, box.centre().y, box.centre().z}),
          dome_(double(domeRadius(box))) {}

    Vec3f place(Vec3f start, Vec3f end, bool environment) const {
        const double radius = environment ? dome_ : 6 * dome_;
        const Vec3d s{start.x, start.y, start.z}, e{end.x, end.y, end.z};
        if (length(e - centre_) <= radius) return end;
        const Vec3d way = e - s;
        const double l = length(way);
        if (!(l > 0)) return end;
        const Vec3d d = way / l;
        // Where the ray leaves the ball around the centre; from outside of it, one radius further.
        const Vec3d o = s - centre_;
        const double b = dot(o, d), c = dot(o, o) - radius * radius;
        const double t = c < 0 ? -b + std::sqrt(b * b - c) : radius;
        const Vec3d p = s + d * std::min(t, l);
        return {float(p.x), float(p.y), float(p.z)};
    }

  private:
    Vec3d centre_;
    double dome_;
};

}  // namespace

float domeRadius(const BoundingBox& box) {
    const float diagonal = box.diagonal();
    return std::isfinite(diagonal) && diagonal > 0 ? 0.75f * diagonal : 1.f;
}

PathGeometry makePathGeometry(const PathSet& paths, const std::optional<Camera>& camera, std::span<const Mesh> meshes,
                              BoundingBox box) {
    if (box.empty) box = boxOfPaths(paths);
    const Placement placement(box);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    PathGeometry g;
    g.points.assign(paths.vertexCount(), Vec3f{kNaN, kNaN, kNaN});
    g.firstSegment.reserve(paths.pathCount() + 1);
    g.firstNextEvent.reserve(paths.pathCount() + 1);
    g.segments.reserve(paths.vertexCount());
    g.nextEvents.reserve(paths.columns().nextEvents.size());
    const bool hasEye = camera && isFinite(camera->position) &&
                        (camera->kind == CameraKind::perspective || camera->kind == CameraKind::spherical);

    for (Index path = 0; path < paths.pathCount(); ++path) {
        const auto first = static_cast<Index>(g.segments.size());
        g.firstSegment.push_back(first);
        for (Index v = paths.vertices(path).first; v < paths.vertices(path).last; ++v) {
            const auto p = paths.position(v);
            if (p && isFinite(*p)) g.points[v] = *p;
            else if (p) ++g.unplacedVertices;
        }
        // The ray from the eye, where the renderer did not say where the path began.
        const IndexRange vertices = paths.vertices(path);
        if (hasEye && !paths.origin(path)) {
            for (Index v = vertices.first; v < vertices.last && paths.subpath(v) == Subpath::camera; ++v) {
                if (!isFinite(g.points[v])) continue;
                analysis::Segment s;
                s.path = path;
                s.to = v;
                s.start = camera->position;
                s.end = g.points[v];
                s.gap = v != vertices.first;
                s.kind = paths.isEnvironment(v)                     ? analysis::SegmentKind::toEnvironment
                         : analysis::isEmitterVertex(paths, v, meshes) ? analysis::SegmentKind::toEmitter
                                                                    : analysis::SegmentKind::scatter;
                if (!(s.start == s.end)) g.segments.push_back(s);
                break;
            }
        }
        analysis::appendSegments(paths, path, meshes, g.segments);
        for (std::size_t i = first; i < g.segments.size(); ++i) {
            analysis::Segment& s = g.segments[i];
            if (s.from != analysis::kNoIndex && isFinite(g.points[s.from])) s.start = g.points[s.from];
            s.end = placement.place(s.start, s.end, paths.isEnvironment(s.to));
            g.points[s.to] = s.end;
        }
        const auto firstNext = static_cast<Index>(g.nextEvents.size());
        g.firstNextEvent.push_back(firstNext);
        analysis::appendNextEventSegments(paths, path, g.nextEvents);
        for (std::size_t i = firstNext; i < g.nextEvents.size(); ++i) {
            analysis::NextEventSegment& s = g.nextEvents[i];
            if (isFinite(g.points[s.vertex])) s.start = g.points[s.vertex];
            const bool outside = !box.empty && length(s.end - box.centre()) > 2 * domeRadius(box);
            s.end = placement.place(s.start, s.end, outside);
        }
    }
    g.firstSegment.push_back(static_cast<Index>(g.segments.size()));
    g.firstNextEvent.push_back(static_cast<Index>(g.nextEvents.size()));
    return g;
}

std::vector<Index> evenlyChosen(Index pathCount, Index count) {
    count = std::min(count, pathCount);
    std::vector<Index> chosen(count);
    for (Index i = 0; i < count; ++i) chosen[i] = static_cast<Index>(std::uint64_t(i) * pathCount / count);
    return chosen;
}

}  // namespace emca::explorer
