#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "emca/core/mesh.h"
#include "emca/render/interaction.h"
#include "emca/render/ray.h"

// Embree's handles, so that this header needs none of Embree's.
struct RTCDeviceTy;
struct RTCGeometryTy;

namespace emca::render {

/// Where a ray met a shape, as the ray tracer says.
struct RayHit {
    float distance = 0;             ///< along the ray
    std::uint32_t geometry = 0;     ///< index of the shape
    std::uint32_t primitive = 0;    ///< triangle of a mesh; 0 for analytic shapes
    float u = 0, v = 0;             ///< barycentric coordinates of a triangle's second and third vertex
};

/// Point on a shape that a light sampler chose.
struct ShapeSample {
    Vec3f position;             ///< world space
    Vec3f direction;            ///< unit, from the place that asked to `position`
    float distance = 0;
    Vec3f normal;               ///< geometric, unit, towards the front
    float positionError = 0;    ///< as SurfaceInteraction's
    float pdf = 0;              ///< per steradian as seen from the place that asked
    std::int32_t face = -1;     ///< triangle of a mesh; -1: Shape::placeAt() knows
    Vec2f barycentrics = kNoBarycentrics;  ///< as SurfaceInteraction's
};

/// A point of a shape as a place on its displayMesh().
struct ShapePlace {
    std::int32_t face = -1;                ///< -1: of a mesh, whose points have their face with them
    Vec2f barycentrics = kNoBarycentrics;  ///< if they are quick to find
};

/// Completes a sample whose points are chosen with equal density on all of a surface.
/// \return false if the point is seen edge-on or from no distance
inline bool completeAreaSample(Vec3f from, float area, ShapeSample& sample) {
    const Vec3f toPoint = sample.position - from;
    const float squared = dot(toPoint, toPoint);
    const float projected = std::abs(dot(sample.normal, toPoint));  // distance times cosine
    sample.distance = std::sqrt(squared);
    sample.direction = toPoint * (1.f / sample.distance);
    sample.pdf = squared * sample.distance / (projected * area);
    return squared > 0.f && projected > 0.f;
}

/// Surface with one material, in world space. Immutable once it is part of a scene; safe from all threads.
class Shape {
  public:
    virtual ~Shape() = default;

    /// Fills in position, normals, frame, face, barycentrics and positionError; leaves the rest alone.
    virtual void interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const = 0;
    virtual float area() const = 0;  ///< square scene units
    /// Chooses a point to be lit by, as seen from `from`. Written in place, as it is part of a light's sample.
    /// \return false if all of the shape is seen edge-on or has no area; `sample` is then unspecified
    virtual bool sample(Vec3f from, Vec2f u, ShapeSample& sample) const = 0;
    /// Density with which sample() chooses the point that a ray from `from` along `direction` met, per steradian.
    /// \param distance  from `from` to the point
    virtual float pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const = 0;

    /// Texture coordinates of a point of the surface. Where points have a face, that and the barycentric coordinates
    /// are read, else the position.
    virtual Vec2f uv(std::int32_t face, Vec2f barycentrics, Vec3f position) const = 0;

    /// Geometry for the ray tracer; the caller attaches and releases it. The shape must outlive it and stay in place.
    virtual RTCGeometryTy* makeGeometry(RTCDeviceTy* device) const = 0;
    /// Triangles for the explorer; `face` of interact() counts these. World space.
    virtual emca::Mesh displayMesh() const = 0;
    virtual std::uint64_t triangleCount() const = 0;  ///< of displayMesh()
    /// Where a point of the surface is, for shapes whose points come without their face.
    virtual ShapePlace placeAt(Vec3f /*position*/) const { return {}; }

    std::string name;                          ///< id in the scene file, else the plugin's type
    std::shared_ptr<const Bsdf> bsdf;          ///< never null in a scene
    const Emitter* emitter = nullptr;          ///< area light on this shape; owned by the scene
    bool masked = false;                       ///< the BSDF's opacity may be below 1
    std::int32_t index = -1;                   ///< place in Scene::shapes(): the mesh index of interactions
};

/// Relative rounding error of a hit point: 2^-18 of the largest coordinate involved, 64 units in the last place.
inline constexpr float kRelativePositionError = 0x1p-18f;

}  // namespace emca::render
