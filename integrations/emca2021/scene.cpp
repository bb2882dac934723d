#include <algorithm>
#include <cmath>
#include <numbers>

#include "bridge_renderer.h"
#include "emca/adapter/parametric_mesh.h"

namespace emca::bridge {

namespace {

bool isUsable(Vec3f v) { return isFinite(v) && length(v) > 0; }

Color displayed(ColorA c) {
    const auto in01 = [](float v) { return v > 0 ? std::min(v, 1.f) : 0.f; };  // NaN: 0
    return {in01(c.r), in01(c.g), in01(c.b)};
}

Mesh tessellated(const PublishedSphere& sphere) {
    const adapter::ParametricMesh grid{.columns = 48, .rows = 24, .firstRowIsPoint = true, .lastRowIsPoint = true, .flipped = true};
    return grid.mesh([&](Vec2f uv) {
        const float theta = uv.y * std::numbers::pi_v<float>, phi = uv.x * 2 * std::numbers::pi_v<float>;
        return sphere.centre + sphere.radius * Vec3f{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    });
}

}  // namespace

float verticalFieldOfView(float degrees, double aspect) {
    const double half = double(degrees) * std::numbers::pi / 360;
    return static_cast<float>(std::atan(std::tan(half) / aspect) * 360 / std::numbers::pi);
}

Camera toCamera(const PublishedCamera& from, bool horizontal, double aspect) {
    Camera camera;
    if (isFinite(from.origin)) camera.position = from.origin;
    if (isUsable(from.direction)) camera.direction = normalize(from.direction);
    // Published servers send the up of the scene file, which leans towards the view.
    const Vec3f wanted = isFinite(from.up) ? from.up - camera.direction * dot(from.up, camera.direction) : Vec3f{};
    if (length(wanted) > 1e-6f) {
        camera.up = normalize(wanted);
    } else {
        const Vec3f other = std::fabs(camera.direction.y) < 0.9f ? Vec3f{0, 1, 0} : Vec3f{0, 0, 1};
        camera.up = normalize(other - camera.direction * dot(other, camera.direction));
    }
    if (from.fieldOfView > 0 && from.fieldOfView < 180) {
        camera.verticalFieldOfView = horizontal ? verticalFieldOfView(from.fieldOfView, aspect) : from.fieldOfView;
    }
    if (from.nearClip > 0 && from.farClip > from.nearClip && std::isfinite(from.farClip)) {
        camera.nearClip = from.nearClip;
        camera.farClip = from.farClip;
    }
    return camera;
}

Result<Mesh> toMesh(const PublishedShape& shape, std::size_t index) {
    Mesh mesh;
    if (shape.sphere) {
        mesh = tessellated(*shape.sphere);
    } else {
        mesh.positions = shape.positions;
        mesh.triangles = shape.triangles;
    }
    mesh.name = (shape.sphere ? "sphere " : "mesh ") + std::to_string(index);
    // Metals have no diffuse colour.
    const Color diffuse = displayed(shape.diffuse);
    mesh.diffuse = isBlack(diffuse) ? displayed(shape.specular) : diffuse;
    if (auto valid = validate(mesh); !valid) {
        return Error{ErrorCode::rendererFailed, "The published server sent a mesh that cannot be: " + valid.error().message};
    }
    return mesh;
}

}  // namespace emca::bridge
