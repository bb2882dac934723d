#include "loaded_scene.h"

#include <algorithm>
#include <cmath>
#include <cxxabi.h>
#include <typeinfo>
#include <variant>

#include "parsers/parse_scene.h"
#undef Error

namespace emca::lajolla {

namespace {

/// Name of the type that a variant holds, so that materials which a course adds have theirs.
template <typename Variant>
std::string typeName(const Variant& variant) {
    return std::visit(
        [](const auto& content) -> std::string {
            int status = 0;
            char* readable = abi::__cxa_demangle(typeid(content).name(), nullptr, nullptr, &status);
            std::string name = status == 0 ? readable : typeid(content).name();
            std::free(readable);
            return name;
        },
        variant);
}

template <typename Variant>
std::vector<std::string> namesOf(const std::vector<Variant>& all) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) names.push_back(typeName(all[i]) + " " + std::to_string(i));
    return names;
}

Vec2f sphereParameters(const Vector2& azimuthAndElevation) {
    const auto u = static_cast<float>(azimuthAndElevation.x);
    return {u < 0 ? u + 1 : u, static_cast<float>(azimuthAndElevation.y)};
}

}  // namespace

Result<std::unique_ptr<LoadedScene>> LoadedScene::load(const std::filesystem::path& file) {
    std::error_code ignored;
    // lajolla changes to the scene's folder, which a bare file name does not have.
    const std::filesystem::path absolute = std::filesystem::absolute(file, ignored);
    if (!std::filesystem::is_regular_file(absolute, ignored)) {
        return Error{ErrorCode::fileNotFound, "There is no scene file " + file.string() + "."};
    }
    std::unique_ptr<LoadedScene> loaded(new LoadedScene(file.stem().string()));
    loaded->device_ = rtcNewDevice(nullptr);
    try {
        loaded->scene_ = parse_scene(absolute, loaded->device_);
    } catch (const std::exception& e) {
        return Error{ErrorCode::fileUnreadable, "lajolla could not read " + file.string() + ": " + e.what() + "."};
    }
    loaded->nameEverything();
    return loaded;
}

LoadedScene::~LoadedScene() {
    scene_.reset();
    if (device_) rtcReleaseDevice(device_);
}

void LoadedScene::nameEverything() {
    shapeNames_ = namesOf(scene_->shapes);
    materialNames_ = namesOf(scene_->materials);
    lightNames_ = namesOf(scene_->lights);
}

const std::string& LoadedScene::materialName(int material) const {
    static const std::string none = "no material";
    return material < 0 ? none : materialNames_[static_cast<std::size_t>(material)];
}

Camera LoadedScene::camera() const {
    const ::Camera& theirs = scene_->camera;
    const Vector3 x = xform_vector(theirs.cam_to_world, Vector3{1, 0, 0}), y = xform_vector(theirs.cam_to_world, Vector3{0, 1, 0}),
                  z = xform_vector(theirs.cam_to_world, Vector3{0, 0, 1});
    const Vector3 top = xform_point(theirs.sample_to_cam, Vector3{Real(0.5), Real(0), Real(0)}),
                  bottom = xform_point(theirs.sample_to_cam, Vector3{Real(0.5), Real(1), Real(0)});
    Camera camera;
    camera.position = toVec3f(xform_point(theirs.cam_to_world, Vector3{0, 0, 0}));
    camera.direction = toVec3f(::normalize(z));
    camera.up = toVec3f(::normalize(y));
    // It looks along +z, and its x axis points to the left of the image.
    camera.rightHanded = ::dot(::cross(x, y), z) > 0;
    const Real angle = std::atan2(std::abs(top.y), top.z) + std::atan2(std::abs(bottom.y), bottom.z);
    camera.verticalFieldOfView = static_cast<float>(degrees(angle));
    camera.nearClip = static_cast<float>(scene_->bounds.radius * 1e-4);
    camera.farClip = static_cast<float>(scene_->bounds.radius * 100);
    return camera;
}

Mesh LoadedScene::meshOf(const TriangleMesh& shape) const {
    Mesh mesh;
    for (const Vector3& p : shape.positions) mesh.positions.push_back(toVec3f(p));
    for (const Vector3i& t : shape.indices) {
        mesh.triangles.push_back({static_cast<std::uint32_t>(t.x), static_cast<std::uint32_t>(t.y), static_cast<std::uint32_t>(t.z)});
    }
    return mesh;
}

Mesh LoadedScene::meshOf(const Sphere& shape) const {
    return sphere_.mesh([&](Vec2f uv) {
        const Real azimuth = c_TWOPI * Real(uv.x), elevation = c_PI * Real(uv.y);
        return toVec3f(shape.position + shape.radius * Vector3{std::sin(elevation) * std::cos(azimuth), std::cos(elevation),
                                                               std::sin(elevation) * std::sin(azimuth)});
    });
}

std::vector<Mesh> LoadedScene::meshes() const {
    std::vector<Mesh> meshes;
    for (std::size_t i = 0; i < scene_->shapes.size(); ++i) {
        const Shape& shape = scene_->shapes[i];
        Mesh mesh = std::visit([&](const auto& s) { return meshOf(s); }, shape);
        const int material = get_material_id(shape), light = get_area_light_id(shape);
        mesh.name = shapeNames_[i];
        mesh.material = materialName(material);
        if (material >= 0) {
            // A footprint of the whole texture: its mean.
            const Color mean = toColor(eval(get_texture(scene_->materials[static_cast<std::size_t>(material)]),
                                            Vector2{Real(0.5), Real(0.5)}, Real(1), scene_->texture_pool));
            mesh.diffuse = {std::clamp(mean.r, 0.f, 1.f), std::clamp(mean.g, 0.f, 1.f), std::clamp(mean.b, 0.f, 1.f)};
        }
        if (light >= 0) {
            if (const auto* area = std::get_if<DiffuseAreaLight>(&scene_->lights[static_cast<std::size_t>(light)])) {
                mesh.emission = toColor(area->intensity);
            }
        }
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

std::int32_t LoadedScene::faceOf(const PathVertex& hit) const {
    const Shape& shape = scene_->shapes[static_cast<std::size_t>(hit.shape_id)];
    return std::holds_alternative<Sphere>(shape) ? sphere_.face(sphereParameters(hit.st)) : hit.primitive_id;
}

std::optional<LoadedScene::LightPlace> LoadedScene::placeOf(const Light& light, const PointAndNormal& point, Real shapeChoice) const {
    const auto* area = std::get_if<DiffuseAreaLight>(&light);
    if (!area) return std::nullopt;
    const Shape& shape = scene_->shapes[static_cast<std::size_t>(area->shape_id)];
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        return LightPlace{area->shape_id, sample(mesh->triangle_sampler, shapeChoice)};
    }
    const auto* sphere = std::get_if<Sphere>(&shape);
    if (!sphere) return std::nullopt;
    const Vector3 d = (point.position - sphere->position) / sphere->radius;
    const Vector2 parameters{std::atan2(d.z, d.x) / c_TWOPI, std::acos(std::clamp(d.y, Real(-1), Real(1))) / c_PI};
    return LightPlace{area->shape_id, sphere_.face(sphereParameters(parameters))};
}

Vector3 LoadedScene::beyond(const Ray& ray) const {
    return ray.org + ray.dir * (::length(ray.org - scene_->bounds.center) + 2 * scene_->bounds.radius);
}

}  // namespace emca::lajolla
