#include "vertex.h"

#include <cmath>

namespace mixture {

namespace {

using namespace emca;

Vec3f normalOf(const client::Dataset& dataset, PathSet::Surface surface) {
    const auto meshes = dataset.meshes();
    if (!meshes || surface.mesh < 0 || static_cast<std::size_t>(surface.mesh) >= meshes->size()) return {};
    const Mesh& mesh = (*meshes)[static_cast<std::size_t>(surface.mesh)];
    if (surface.face < 0 || static_cast<std::size_t>(surface.face) >= mesh.triangles.size()) return {};
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(surface.face)];
    const Vec3f normal = cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    return isFinite(normal) ? normalize(normal) : Vec3f{};
}

std::optional<Vec3f> surfacePosition(const PathSet& paths, Index vertex) {
    return paths.isEnvironment(vertex) ? std::nullopt : paths.position(vertex);
}

}  // namespace

std::optional<Vertex> selectedVertex(const client::Dataset& dataset, const client::Selection& selection) {
    const auto& selected = selection.state().vertex;
    const PathSet& paths = dataset.paths();
    if (!selected) return std::nullopt;
    const auto path = paths.findPath(selected->path.pixel, selected->path.sample, selected->path.part);
    const auto at = path ? paths.findVertex(*path, selected->depth, selected->subpath) : std::nullopt;
    const auto position = at ? surfacePosition(paths, *at) : std::nullopt;
    if (!position || !isFinite(*position)) return std::nullopt;

    Vertex vertex;
    vertex.id = *selected;
    vertex.position = *position;
    const auto before = *at > paths.vertices(*path).first ? paths.position(*at - 1) : paths.origin(*path);
    const Vec3f back = before ? *before - *position : Vec3f{};
    if (const auto surface = paths.surface(*at)) vertex.normal = normalOf(dataset, *surface);
    if (dot(vertex.normal, back) < 0.f) vertex.normal = -vertex.normal;

    const float reach = 0.02f * length(back);
    for (Index other = 0; other < paths.pathCount(); ++other) {
        const IndexRange range = paths.vertices(other);
        for (Index i = range.first; i + 1 < range.last; ++i) {
            const auto here = surfacePosition(paths, i), next = paths.position(i + 1);
            if (!here || !next || paths.subpath(i) != paths.subpath(i + 1) || length(*here - *position) > reach) continue;
            const Vec3f towards = normalize(*next - *here);
            if (isFinite(towards)) vertex.directions.push_back({normalize(Vec3d{double(towards.x), double(towards.y), double(towards.z)}), 1});
        }
    }
    Vec3f up{0, 1, 0}, ahead{0, 0, -1};
    if (const auto& camera = dataset.camera()) {
        const float x = std::abs(camera->up.x), y = std::abs(camera->up.y), z = std::abs(camera->up.z);
        up = z >= x && z >= y ? Vec3f{0, 0, std::copysign(1.f, camera->up.z)} : y >= x ? Vec3f{0, std::copysign(1.f, camera->up.y), 0} : Vec3f{std::copysign(1.f, camera->up.x), 0, 0};
        ahead = -camera->direction;   // what the camera sees faces it
    }
    vertex.frame = probe::SphereFrame::around(up, ahead);
    return vertex;
}

}  // namespace mixture
