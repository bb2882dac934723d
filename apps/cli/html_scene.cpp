#include "html_scene.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "html_page.h"
#include "mesh_budget.h"

namespace emca::cli {
namespace {

void append(std::vector<std::byte>& bytes, std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> 8 * i & 255));
}

/// [0, 65535] along the box.
std::uint32_t quantised(float value, float min, float extent) {
    if (!(extent > 0)) return 0;
    const double position = (static_cast<double>(value) - static_cast<double>(min)) / static_cast<double>(extent);
    return static_cast<std::uint32_t>(std::lround(std::min(std::max(position, 0.0), 1.0) * 65535));
}

Json meshJson(const Mesh& mesh) {
    const BoundingBox box = boundingBox({mesh});
    const Vec3f extent = box.max - box.min;
    std::vector<std::byte> positions, indices;
    positions.reserve(6 * mesh.positions.size());
    for (const Vec3f p : mesh.positions) {
        append(positions, quantised(p.x, box.min.x, extent.x), 2);
        append(positions, quantised(p.y, box.min.y, extent.y), 2);
        append(positions, quantised(p.z, box.min.z, extent.z), 2);
    }
    const int size = mesh.positions.size() > 65536 ? 4 : 2;
    indices.reserve(static_cast<std::size_t>(3 * size) * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) append(indices, v, size);
    Json out;
    out["name"] = mesh.name;
    out["material"] = mesh.material;
    out["diffuse"] = toJson(mesh.diffuse);
    out["emission"] = toJson(mesh.emission);
    out["min"] = toJson(box.min);
    out["extent"] = toJson(extent);
    out["vertices"] = mesh.positions.size();
    out["triangles"] = mesh.triangles.size();
    out["positions"] = toBase64(positions);
    out["indices"] = toBase64(indices);
    return out;
}

const char* name(CameraKind kind) {
    switch (kind) {
        case CameraKind::perspective:
            return "perspective";
        case CameraKind::spherical:
            return "spherical";
        case CameraKind::orthographic:
            return "orthographic";
        case CameraKind::other:
            break;
    }
    return "other";
}

}  // namespace

Json sceneJson(const std::vector<Mesh>& meshes, std::uint64_t maximumTriangles) {
    const ReducedMeshes reduced = reduceMeshes(meshes, maximumTriangles);
    Json out;
    out["triangles"] = reduced.before;
    out["shown"] = reduced.triangles;
    out["meshes"] = Json::array();
    for (const Mesh& mesh : reduced.meshes) out["meshes"].push_back(meshJson(mesh));
    return out;
}

Json cameraJson(const Camera& camera) {
    Json out;
    out["kind"] = name(camera.kind);
    out["position"] = toJson(camera.position);
    out["direction"] = toJson(camera.direction);
    out["up"] = toJson(camera.up);
    out["verticalFieldOfView"] = toJson(camera.verticalFieldOfView);
    out["rightHanded"] = camera.rightHanded;
    return out;
}

}  // namespace emca::cli
