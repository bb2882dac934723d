#pragma once

#include <cstdint>
#include <limits>

#include "emca/core/vector.h"
#include "emca/render/frame.h"

namespace emca::render {

/// Barycentric coordinates of a point that was not found on a triangle.
inline constexpr Vec2f kNoBarycentrics{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()};

class Shape;
class Bsdf;
class Emitter;

/// A point where a ray met a surface. World space, scene units.
struct SurfaceInteraction {
    Vec3f position;
    Vec3f geometricNormal;   ///< unit, of the triangle or analytic shape, not turned towards the ray
    Frame shading;           ///< shading.n: interpolated or mapped normal, unit
    Vec3f wo;                ///< local to `shading`: unit, back along the ray (towards the camera)
    float distance = 0;      ///< along the ray
    float positionError = 0; ///< bound on how far rounding put `position` off the surface: offsetOrigin() needs it
    std::int32_t mesh = -1;  ///< index into Scene::meshes(), as the explorer sees it
    std::int32_t face = -1;  ///< triangle of that mesh (analytic shapes: of their tessellation)
    Vec2f barycentrics = kNoBarycentrics;  ///< weights of that triangle's second and third vertex; NaN on analytic shapes
    const Shape* shape = nullptr;
    const Bsdf* bsdf = nullptr;        ///< never null after Scene::intersect
    const Emitter* emitter = nullptr;  ///< area light on this surface, if any

    /// Texture coordinates. Found when asked for: few materials have textures. Without a shape, the barycentric ones.
    Vec2f uv() const;

    Vec3f toWorld(Vec3f local) const { return shading.toWorld(local); }
    Vec3f toLocal(Vec3f world) const { return shading.toLocal(world); }
};

}  // namespace emca::render
