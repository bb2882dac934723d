#pragma once

#include <cstdint>

#include "emca/core/camera.h"
#include "emca/render/ray.h"
#include "emca/render/transform.h"

namespace emca::render {

/// Which extent of the image a field of view spans.
enum class FieldOfViewAxis : std::uint8_t { x, y, diagonal, smaller, larger };

/// What a sensor is made of, in Mitsuba's terms. Camera space: +z along the view, +y up, +x to the LEFT of the image.
struct CameraSettings {
    emca::CameraKind kind = emca::CameraKind::perspective;  ///< perspective or spherical
    Transform toWorld;
    float fieldOfView = 50;  ///< degrees, in (0, 180), along `axis`
    FieldOfViewAxis axis = FieldOfViewAxis::x;
    float nearClip = 0.01f, farClip = 1e4f;  ///< distances along the view
    float focusDistance = 0;                 ///< thin lens, scene units along the view
    float apertureRadius = 0;                ///< thin lens, scene units; 0 for a pinhole
};

/// Field of view in degrees along the image diagonal of a lens on 35 mm film (36 mm x 24 mm).
float diagonalFieldOfView(float focalLengthInMillimetres);

/// Makes rays from places in the image. Immutable; safe from all threads.
class RayCamera {
  public:
    RayCamera() : RayCamera(CameraSettings(), 1, 1) {}
    RayCamera(const CameraSettings& settings, std::uint32_t width, std::uint32_t height);

    /// Ray through a point of the film, from the camera's position or its aperture; nothing before the near plane is met.
    /// \param film  pixels; (0, 0) is the top-left corner of the image
    /// \param lens  in [0, 1)^2, the place on the aperture; pinholes ignore it
    Ray ray(Vec2f film, Vec2f lens) const;

    bool hasLens() const { return settings_.apertureRadius > 0; }
    const CameraSettings& settings() const { return settings_; }
    /// What a viewer needs.
    emca::Camera view() const;

  private:
    Ray perspectiveRay(Vec2f film, Vec2f lens) const;
    Ray sphericalRay(Vec2f film) const;

    CameraSettings settings_;
    float width_, height_;
    float tangentX_, tangentY_;  ///< half extents of the image plane at distance 1
    Vec3f position_;                 ///< world space
    Vec3f left_, up_, towards_;      ///< the camera's axes in world space, as long as `toWorld` makes them
};

}  // namespace emca::render
