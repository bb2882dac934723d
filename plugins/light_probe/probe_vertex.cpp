#include "probe_vertex.h"

#include <cmath>

namespace emca::light_probe {

namespace {

constexpr float kSamePlace = 0.02f;   ///< of the length of the segment before

Vec3f normalOf(const client::Dataset& dataset, PathSet::Surface surface) {
    const auto meshes = dataset.meshes();
    if (!meshes || surface.mesh < 0 || static_cast<std::size_t>(surface.mesh) >= meshes->size()) return {};
    const Mesh& mesh = (*meshes)[static_cast<std::size_t>(surface.mesh)];
    if (surface.face < 0 || static_cast<std::size_t>(surface.face) >= mesh.triangles.size()) return {};
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(surface.face)];
    const Vec3f a = mesh.positions[t[0]];
    const Vec3f normal = normalize(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
    return isFinite(normal) && dot(normal, normal) > 0.5f ? normal : Vec3f{};
}

/// The vertices around one of a path: positions in the set, nothing at its ends.
std::optional<Index> neighbour(const PathSet& paths, Index path, Index vertex, int step) {
    const IndexRange range = paths.vertices(path);
    const auto subpath = paths.subpath(vertex);
    for (std::int64_t i = std::int64_t(vertex) + step; i >= range.first && i < range.last; i += step) {
        const auto at = static_cast<Index>(i);
        if (paths.subpath(at) != subpath) break;
        if (paths.position(at)) return at;
    }
    return std::nullopt;
}

client::VertexId idOf(const PathSet& paths, Index path, Index vertex) {
    return {{paths.pixel(path), paths.sample(path), paths.part(path)}, paths.depthIndex(vertex), paths.subpath(vertex)};
}

struct Segment {
    Vec3f towards;
    float length = 0;
};
std::optional<Segment> segment(Vec3f from, Vec3f to) {
    const Vec3f difference = to - from;
    const float size = length(difference);
    if (!std::isfinite(size) || !(size > 0.f)) return std::nullopt;
    return Segment{difference / size, size};
}

void addOutgoing(const PathSet& paths, Index path, Index vertex, Vec3f from, bool own, std::vector<Direction>& directions) {
    const auto next = neighbour(paths, path, vertex, 1);
    if (!next) return;
    const auto way = segment(from, *paths.position(*next));
    if (!way) return;
    const auto emission = paths.emission(*next);
    const bool lit = paths.isEnvironment(*next) || (emission && !isBlack(*emission));
    directions.push_back({!own ? DirectionKind::other : lit ? DirectionKind::emitter : DirectionKind::outgoing, way->towards,
                          idOf(paths, path, *next), way->length});
}

}  // namespace

QString ProbeVertex::label() const {
    return QStringLiteral("path %1, vertex %2").arg(id.path.sample).arg(id.depth);
}

VertexAnswer probeVertex(const client::Dataset& dataset, const client::Selection& selection) {
    const auto& selected = selection.state().vertex;
    if (!selected) return {std::nullopt, QObject::tr("Select a vertex: in the 3D view, the path tree or a plot.")};
    const PathSet& paths = dataset.paths();
    const auto path = paths.findPath(selected->path.pixel, selected->path.sample, selected->path.part);
    const auto vertex = path ? paths.findVertex(*path, selected->depth, selected->subpath) : std::nullopt;
    if (!vertex) return {std::nullopt, QObject::tr("The selected vertex is not among the loaded paths.")};
    if (paths.isEnvironment(*vertex)) return {std::nullopt, QObject::tr("The path left the scene here: choose a vertex on a surface.")};
    const auto position = paths.position(*vertex);
    if (!position || !isFinite(*position)) return {std::nullopt, QObject::tr("This vertex has no position: choose another one.")};

    ProbeVertex found;
    found.id = *selected;
    found.position = *position;
    float reach = 0;
    const auto previous = neighbour(paths, *path, *vertex, -1);
    const std::optional<Vec3f> before = previous ? paths.position(*previous) : paths.origin(*path);
    const auto back = before ? segment(*position, *before) : std::nullopt;
    if (back) {
        found.towardsPrevious = back->towards;
        reach = kSamePlace * back->length;
    }
    if (const auto surface = paths.surface(*vertex)) found.normal = normalOf(dataset, *surface);
    if (dot(found.normal, found.towardsPrevious) < 0.f) found.normal = -found.normal;

    for (Index other = 0; other < paths.pathCount(); ++other) {
        if (other == *path) continue;
        const IndexRange range = paths.vertices(other);
        for (Index at = range.first; at < range.last; ++at) {
            const auto place = paths.isEnvironment(at) ? std::nullopt : paths.position(at);
            if (place && length(*place - *position) <= reach) addOutgoing(paths, other, at, *place, false, found.directions);
        }
    }
    // Of a pixel's first vertices all are here; as many as a picture can show are enough.
    if (const std::size_t all = found.directions.size(); all > kMostOthers) {
        for (std::size_t i = 0; i < kMostOthers; ++i) found.directions[i] = found.directions[i * all / kMostOthers];
        found.directions.resize(kMostOthers);
    }
    const IndexRange events = paths.nextEvents(*vertex);
    for (Index i = events.first; i < events.last; ++i) {
        const NextEvent& event = paths.nextEvent(i);
        const auto way = segment(*position, event.position);
        if (way) found.directions.push_back({event.visible ? DirectionKind::nextEventVisible : DirectionKind::nextEventOccluded, way->towards, {}, way->length});
    }
    addOutgoing(paths, *path, *vertex, *position, true, found.directions);
    if (back) {
        std::optional<client::VertexId> end;
        if (previous) end = idOf(paths, *path, *previous);
        found.directions.push_back({DirectionKind::incoming, back->towards, end, back->length});
    }
    return {std::move(found), {}};
}

probe::SphereFrame frameOf(const ProbeVertex& vertex, Orientation orientation, const std::optional<Camera>& camera) {
    if (orientation == Orientation::surface && vertex.normal != Vec3f{}) {
        return probe::SphereFrame::around(vertex.normal, -vertex.towardsPrevious);
    }
    Vec3f up{0, 1, 0}, ahead{0, 0, -1};
    if (camera) {
        const Vec3f u = camera->up;
        const float x = std::abs(u.x), y = std::abs(u.y), z = std::abs(u.z);
        up = z >= x && z >= y ? Vec3f{0, 0, std::copysign(1.f, u.z)} : y >= x ? Vec3f{0, std::copysign(1.f, u.y), 0} : Vec3f{std::copysign(1.f, u.x), 0, 0};
        ahead = -camera->direction;   // what the camera sees faces it
    }
    return probe::SphereFrame::around(up, ahead);
}

}  // namespace emca::light_probe
