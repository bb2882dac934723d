#include "emca/render/camera.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

constexpr double kDegrees = 3.14159265358979323846 / 180;

/// Distance along the view that a camera-space direction of z = 1 is scaled by in world space.
float viewScale(const Transform& toWorld) {
    const float scale = length(toWorld.vector({0, 0, 1}));
    return scale > 0 ? scale : 1.f;
}

}  // namespace

float diagonalFieldOfView(float focalLengthInMillimetres) {
    const double diagonal = std::sqrt(36.0 * 36.0 + 24.0 * 24.0);
    return static_cast<float>(2 * std::atan(diagonal / (2 * double(focalLengthInMillimetres))) / kDegrees);
}

RayCamera::RayCamera(const CameraSettings& settings, std::uint32_t width, std::uint32_t height)
    : settings_(settings), width_(static_cast<float>(width)), height_(static_cast<float>(height)) {
    const double aspect = double(width) / double(height);
    const double tangent = std::tan(0.5 * double(settings.fieldOfView) * kDegrees);
    const bool wide = aspect >= 1;
    double x = tangent;
    switch (settings.axis) {
        case FieldOfViewAxis::x: break;
        case FieldOfViewAxis::y: x = tangent * aspect; break;
        case FieldOfViewAxis::diagonal: x = tangent * aspect / std::sqrt(1 + aspect * aspect); break;
        case FieldOfViewAxis::smaller: x = wide ? tangent * aspect : tangent; break;
        case FieldOfViewAxis::larger: x = wide ? tangent : tangent * aspect; break;
    }
    tangentX_ = static_cast<float>(x);
    tangentY_ = static_cast<float>(x / aspect);
    position_ = settings.toWorld.point({});
    left_ = settings.toWorld.vector({1, 0, 0});
    up_ = settings.toWorld.vector({0, 1, 0});
    towards_ = settings.toWorld.vector({0, 0, 1});
}

Ray RayCamera::ray(Vec2f film, Vec2f lens) const {
    return settings_.kind == emca::CameraKind::spherical ? sphericalRay(film) : perspectiveRay(film, lens);
}

Ray RayCamera::perspectiveRay(Vec2f film, Vec2f lens) const {
    Vec2f slope{(1.f - 2.f * film.x / width_) * tangentX_, (1.f - 2.f * film.y / height_) * tangentY_};
    Vec3f origin = position_;
    if (hasLens()) {
        const Vec2f aperture = squareToConcentricDisk(lens) * settings_.apertureRadius;
        origin += left_ * aperture.x + up_ * aperture.y;
        slope = slope - aperture * (1.f / settings_.focusDistance);
    }
    // Per unit of distance along the view, in which the clipping planes are given.
    const Vec3f world = left_ * slope.x + up_ * slope.y + towards_;
    const float scale = length(world);
    return {origin, world * (1.f / scale), settings_.nearClip * scale, settings_.farClip * scale};
}

Ray RayCamera::sphericalRay(Vec2f film) const {
    const float phi = 2.f * kPi * film.x / width_;
    const float theta = kPi * film.y / height_;
    const Vec3f direction{std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)};
    return {position_, normalize(settings_.toWorld.vector(direction))};
}

emca::Camera RayCamera::view() const {
    const Transform& toWorld = settings_.toWorld;
    const float scale = viewScale(toWorld);
    emca::Camera view;
    view.kind = settings_.kind;
    view.position = toWorld.point({});
    // The centre of a spherical image looks along +z too: phi = pi.
    view.direction = normalize(toWorld.vector({0, 0, 1}));
    const Vec3f up = toWorld.vector({0, 1, 0});
    view.up = normalize(up - view.direction * dot(up, view.direction));
    view.verticalFieldOfView = static_cast<float>(2 * std::atan(double(tangentY_)) / kDegrees);
    view.nearClip = settings_.nearClip * scale;
    view.farClip = settings_.farClip * scale;
    view.focusDistance = settings_.focusDistance * scale;
    view.apertureRadius = settings_.apertureRadius * scale;
    view.rightHanded = toWorld.determinant() >= 0;
    return view;
}

}  // namespace emca::render
