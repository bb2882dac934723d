// Camera, meshes and 3D data on them.
#include "scene.h"

#include <string>

#include "arrays.h"
#include "bindings.h"
#include "errors.h"

namespace emca::python {
namespace {

constexpr const char* kCameraKinds[] = {"perspective", "spherical", "orthographic", "other"};

CameraKind toCameraKind(const std::string& kind) {
    for (std::size_t i = 0; i < std::size(kCameraKinds); ++i)
        if (kind == kCameraKinds[i]) return static_cast<CameraKind>(i);
    throw py::value_error("a camera's kind is \"perspective\", \"spherical\", \"orthographic\" or \"other\", not \"" +
                          kind + "\"");
}

template <typename Element, typename Source>
std::vector<Element> threes(const std::vector<Source>& values, const std::string& what) {
    if (values.size() % 3 != 0) throw py::value_error(what + " must have three numbers each");
    std::vector<Element> out(values.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return out;
}

Mesh toMesh(py::handle mesh) {
    Mesh out;
    out.name = mesh.attr("name").cast<std::string>();
    out.material = mesh.attr("material").cast<std::string>();
    out.positions = threes<Vec3f>(toFloats(mesh.attr("positions")).values, "positions");
    out.triangles = threes<Triangle>(toIndices(mesh.attr("triangles")), "triangles");
    out.diffuse = toColor(mesh.attr("diffuse"), "diffuse");
    out.emission = toColor(mesh.attr("emission"), "emission");
    unwrap(validate(out));
    return out;
}

py::dict meshDict(const Mesh& mesh, const std::shared_ptr<const void>& owner) {
    py::dict out;
    out["name"] = toText(mesh.name);
    out["material"] = toText(mesh.material);
    out["positions"] = view(mesh.positions.data(), Number::float32, mesh.positions.size(), 3, sizeof(Vec3f), owner);
    out["triangles"] = view(mesh.triangles.data(), Number::uint32, mesh.triangles.size(), 3, sizeof(Triangle), owner);
    out["diffuse"] = toTuple(mesh.diffuse);
    out["emission"] = toTuple(mesh.emission);
    return out;
}

py::list layersOf(const SharedField& surface) {
    py::list out;
    for (const SurfaceLayerData& layer : surface.field->layers) {
        py::dict item = toDict(layer.description);
        item["values"] =
            view(layer.values.data(), Number::float32, surface.field->faceCount(), channelCount(layer.description.kind),
                 channelCount(layer.description.kind) * sizeof(float), layer.values.owner());
        item["samples"] = layer.samples;
        item["total"] = layer.total;
        out.append(item);
    }
    return out;
}

py::dict countsOf(const SharedField& surface) {
    const SurfaceCounts& counts = surface.field->counts;
    py::dict out;
    out["points"] = counts.points;
    out["coarse"] = counts.coarse;
    out["invalid"] = counts.invalid;
    out["refused_divisions"] = counts.refusedDivisions;
    out["bytes_used"] = counts.bytesUsed;
    out["budget_bytes"] = counts.budgetBytes;
    return out;
}

/// (first face, number of faces) per mesh
py::list facesOf(const SharedField& surface) {
    py::list out;
    for (const SurfaceMesh& mesh : surface.field->meshes) out.append(py::make_tuple(mesh.firstFace, mesh.faceCount));
    return out;
}

/// (positions, triangles, base face) of a mesh after its subdivision
py::tuple refined(const SharedField& surface, std::size_t index, py::handle mesh) {
    if (index >= surface.field->meshes.size()) throw py::index_error();
    RefinedMesh out = unwrap(refine(toMesh(mesh), surface.field->meshes[index].subdivision));
    return py::make_tuple(moved(std::move(out.positions), Number::float32, 3),
                          moved(std::move(out.triangles), Number::uint32, 3),
                          moved(std::move(out.baseFace), Number::uint32));
}

}  // namespace

Camera toCamera(py::handle camera) {
    const auto number = [&](const char* name) { return camera.attr(name).cast<float>(); };
    Camera out;
    out.kind = toCameraKind(camera.attr("kind").cast<std::string>());
    out.position = toVec3(camera.attr("position"), "a camera's position");
    out.direction = normalize(toVec3(camera.attr("direction"), "a camera's direction"));
    const Vec3f up = toVec3(camera.attr("up"), "a camera's up");
    out.up = normalize(up - dot(up, out.direction) * out.direction);
    out.verticalFieldOfView = number("vertical_field_of_view");
    out.nearClip = number("near_clip");
    out.farClip = number("far_clip");
    out.focusDistance = number("focus_distance");
    out.apertureRadius = number("aperture_radius");
    out.rightHanded = camera.attr("right_handed").cast<bool>();
    return out;
}

py::dict toDict(const Camera& camera) {
    const auto kind = static_cast<std::size_t>(camera.kind);
    py::dict out;
    out["kind"] = kCameraKinds[kind < std::size(kCameraKinds) ? kind : 3];
    out["position"] = toTuple(camera.position);
    out["direction"] = toTuple(camera.direction);
    out["up"] = toTuple(camera.up);
    out["vertical_field_of_view"] = camera.verticalFieldOfView;
    out["near_clip"] = camera.nearClip;
    out["far_clip"] = camera.farClip;
    out["focus_distance"] = camera.focusDistance;
    out["aperture_radius"] = camera.apertureRadius;
    out["right_handed"] = camera.rightHanded;
    return out;
}

std::vector<Mesh> toMeshes(py::handle meshes) {
    std::vector<Mesh> out;
    for (const py::handle mesh : py::reinterpret_borrow<py::iterable>(meshes)) out.push_back(toMesh(mesh));
    return out;
}

py::list toList(const std::shared_ptr<const std::vector<Mesh>>& meshes) {
    py::list out;
    if (meshes)
        for (const Mesh& mesh : *meshes) out.append(meshDict(mesh, meshes));
    return out;
}

py::dict toDict(const LayerDescription& layer) {
    py::dict out;
    out["name"] = toText(layer.name);
    out["kind"] = name(layer.kind);
    out["unit"] = toText(layer.unit);
    out["description"] = toText(layer.description);
    return out;
}

void bindScene(py::module_& module) {
    py::class_<SharedField>(module, "Surface")
        .def("layers", &layersOf)
        .def("counts", &countsOf)
        .def("faces", &facesOf)
        .def("points", [](const SharedField& surface) { return view(surface.field->points, Number::float32); })
        .def("refined", &refined);
}

}  // namespace emca::python
