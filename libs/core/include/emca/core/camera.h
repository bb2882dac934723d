#pragma once

#include <cstdint>

#include "emca/core/vector.h"

namespace emca {

enum class CameraKind : std::uint8_t { perspective = 0, spherical = 1, orthographic = 2, other = 3 };

/// Where the image was taken from, as far as a viewer needs it. World space, scene units.
struct Camera {
    CameraKind kind = CameraKind::perspective;
    Vec3f position;
    Vec3f direction{0, 0, -1};      ///< unit, the way it looks
    Vec3f up{0, 1, 0};              ///< unit, upwards in the image, orthogonal to `direction`
    float verticalFieldOfView = 45; ///< degrees, top to bottom edge of the image; unused by spherical cameras
    float nearClip = 0.01f, farClip = 1e4f;  ///< distances along `direction`
    float focusDistance = 0;        ///< thin lens: distance of the plane in focus; 0 for a pinhole
    float apertureRadius = 0;       ///< thin lens; 0 for a pinhole
    /// False for a camera that mirrors the image left to right (as a left-handed transform does).
    bool rightHanded = true;
    friend bool operator==(const Camera&, const Camera&) = default;
};

}  // namespace emca
