#include "emca/analysis/path_quantities.h"

#include <cmath>
#include <limits>

namespace emca::analysis {
namespace {

std::optional<Vec3f> finitePosition(const PathSet& paths, Index vertex) {
    const std::optional<Vec3f> p = paths.position(vertex);
    return p && isFinite(*p) ? p : std::nullopt;
}

std::optional<Vec3f> finiteOrigin(const PathSet& paths, Index path) {
    const std::optional<Vec3f> p = paths.origin(path);
    return p && isFinite(*p) ? p : std::nullopt;
}

SegmentKind kindOf(const PathSet& paths, const Segment& segment, std::span<const Mesh> meshes) {
    if (paths.isEnvironment(segment.to)) return SegmentKind::toEnvironment;
    // A light subpath runs from the light: what a viewer sees as "into the emitter" is its first segment.
    const Index end = segment.subpath == Subpath::light ? segment.from : segment.to;
    if (end == kNoIndex) return SegmentKind::scatter;
    if (paths.isEnvironment(end)) return SegmentKind::toEnvironment;
    return isEmitterVertex(paths, end, meshes) ? SegmentKind::toEmitter : SegmentKind::scatter;
}

}  // namespace

std::string_view label(PathQuantity quantity) {
    switch (quantity) {
        case PathQuantity::sample:
            return "sample index";
        case PathQuantity::luminance:
            return "luminance";
        case PathQuantity::red:
            return "red";
        case PathQuantity::green:
            return "green";
        case PathQuantity::blue:
            return "blue";
        case PathQuantity::depth:
            return "path depth";
        case PathQuantity::vertexCount:
            return "vertices";
    }
    return "unknown";
}

std::string_view unit(PathQuantity quantity) {
    switch (quantity) {
        case PathQuantity::luminance:
        case PathQuantity::red:
        case PathQuantity::green:
        case PathQuantity::blue:
            return "W/(sr m²)";
        default:
            return "";
    }
}

std::optional<double> pathValue(const PathSet& paths, Index path, PathQuantity quantity) {
    switch (quantity) {
        case PathQuantity::sample:
            return static_cast<double>(paths.sample(path));
        case PathQuantity::depth:
            return static_cast<double>(paths.depth(path));
        case PathQuantity::vertexCount:
            return static_cast<double>(paths.vertices(path).size());
        default:
            break;
    }
    const std::optional<Color> estimate = paths.estimate(path);
    if (!estimate) return std::nullopt;
    switch (quantity) {
        case PathQuantity::red:
            return static_cast<double>(estimate->r);
        case PathQuantity::green:
            return static_cast<double>(estimate->g);
        case PathQuantity::blue:
            return static_cast<double>(estimate->b);
        default:
            return static_cast<double>(luminance(*estimate));
    }
}

PathSeries pathSeries(const PathSet& paths, PathQuantity quantity) {
    PathSeries series;
    series.values.reserve(paths.pathCount());
    series.paths.reserve(paths.pathCount());
    for (Index path = 0; path < paths.pathCount(); ++path)
        if (const std::optional<double> value = pathValue(paths, path, quantity)) {
            series.values.push_back(*value);
            series.paths.push_back(path);
        }
    return series;
}

std::vector<Index> brightestFirst(const PathSet& paths) {
    std::vector<double> keys(paths.pathCount());
    std::vector<Index> order(paths.pathCount());
    for (Index i = 0; i < paths.pathCount(); ++i) {
        const auto value = pathValue(paths, i, PathQuantity::luminance);
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        keys[i] = !value ? -kInfinity : std::isfinite(*value) ? *value : kInfinity;
        order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return keys[a] > keys[b]; });
    return order;
}

bool isEmitterVertex(const PathSet& paths, Index vertex, std::span<const Mesh> meshes) {
    // A recorded emission decides: a lamp seen from its dark side is no emitter.
    if (const std::optional<Color> emission = paths.emission(vertex)) return !isBlack(*emission);
    if (paths.isEnvironment(vertex)) return true;
    if (const auto scattering = paths.scattering(vertex))
        if (scattering->event == Event::emission || scattering->event == Event::background) return true;
    if (const auto surface = paths.surface(vertex))
        if (surface->mesh >= 0 && static_cast<std::size_t>(surface->mesh) < meshes.size())
            return meshes[static_cast<std::size_t>(surface->mesh)].isEmitter();
    return false;
}

void appendSegments(const PathSet& paths, Index path, std::span<const Mesh> meshes, std::vector<Segment>& out) {
    const IndexRange vertices = paths.vertices(path);
    std::optional<Vec3f> start = finiteOrigin(paths, path);
    Index from = kNoIndex;
    std::int32_t lastDepth = 0;  // the origin is the camera's vertex
    Subpath subpath = Subpath::camera;
    for (Index v = vertices.first; v < vertices.last; ++v) {
        if (paths.subpath(v) != subpath) {
            subpath = paths.subpath(v);
            start.reset();
            from = kNoIndex;
        }
        const std::optional<Vec3f> end = finitePosition(paths, v);
        if (!end) continue;
        if (start && !(*start == *end)) {
            Segment segment{path, from, v, *start, *end, SegmentKind::scatter, subpath, false};
            // From the origin on, renderers count the first hit as 0 or as 1.
            segment.gap = from == kNoIndex ? v != vertices.first : paths.depthIndex(v) != lastDepth + 1;
            segment.kind = kindOf(paths, segment, meshes);
            out.push_back(segment);
        }
        start = end;
        from = v;
        lastDepth = paths.depthIndex(v);
    }
}

void appendNextEventSegments(const PathSet& paths, Index path, std::vector<NextEventSegment>& out) {
    const IndexRange vertices = paths.vertices(path);
    for (Index v = vertices.first; v < vertices.last; ++v) {
        const std::optional<Vec3f> start = finitePosition(paths, v);
        if (!start) continue;
        const IndexRange events = paths.nextEvents(v);
        for (Index i = events.first; i < events.last; ++i) {
            const NextEvent& event = paths.nextEvent(i);
            if (isFinite(event.position)) out.push_back({path, v, i, *start, event.position, event.visible != 0});
        }
    }
}

std::vector<Segment> pathSegments(const PathSet& paths, Index path, std::span<const Mesh> meshes) {
    std::vector<Segment> segments;
    appendSegments(paths, path, meshes, segments);
    return segments;
}

std::vector<NextEventSegment> nextEventSegments(const PathSet& paths, Index path) {
    std::vector<NextEventSegment> segments;
    appendNextEventSegments(paths, path, segments);
    return segments;
}

std::optional<Vec3f> previousPosition(const PathSet& paths, Index vertex) {
    const Index path = paths.pathOf(vertex);
    for (Index v = vertex; v > paths.vertices(path).first && paths.subpath(v - 1) == paths.subpath(vertex); --v)
        if (const auto position = finitePosition(paths, v - 1)) return position;
    return paths.subpath(vertex) == Subpath::camera ? finiteOrigin(paths, path) : std::nullopt;
}

std::optional<Vec3f> nextPosition(const PathSet& paths, Index vertex) {
    const Index last = paths.vertices(paths.pathOf(vertex)).last;
    for (Index v = vertex + 1; v < last && paths.subpath(v) == paths.subpath(vertex); ++v)
        if (const auto position = finitePosition(paths, v)) return position;
    return std::nullopt;
}

}  // namespace emca::analysis
