#pragma once

#include <limits>

#include "emca/core/vector.h"

namespace emca::render {

/// Half-line or segment: points origin + t direction, t from minimumDistance to maximumDistance. World space.
struct Ray {
    Vec3f origin;
    Vec3f direction;  ///< unit
    float minimumDistance = 0;
    float maximumDistance = std::numeric_limits<float>::infinity();
    Vec3f at(float t) const { return origin + direction * t; }
};

/// Moves a point off the surface, to the side towards which `direction` points, so that a ray that starts there does
/// not meet the surface again.
/// \param error  how far rounding may have put the point off its surface (SurfaceInteraction::positionError)
inline Vec3f offsetOrigin(Vec3f position, Vec3f geometricNormal, float error, Vec3f direction) {
    return position + geometricNormal * (dot(direction, geometricNormal) < 0.f ? -error : error);
}

}  // namespace emca::render
