#pragma once

#include "emca/render/shape.h"
#include "emca/render/shape_mesh.h"

namespace emca::render {

/// Exact sphere. Intersected in double precision, so that small far spheres and huge near ones are as round.
class SphereShape final : public Shape {
  public:
    /// \param tessellation  of the same sphere, as makeSphere() orders its triangles
    SphereShape(const SphereGeometry& sphere, TriangleMesh tessellation, bool flipped);

    void interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const override;
    float area() const override;
    /// From outside, directions within the cone that the sphere fills are equally likely
    /// (Shirley, Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", 1996); from inside,
    /// points are.
    bool sample(Vec3f from, Vec2f u, ShapeSample& sample) const override;
    float pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const override;
    Vec2f uv(std::int32_t face, Vec2f barycentrics, Vec3f position) const override;
    RTCGeometryTy* makeGeometry(RTCDeviceTy* device) const override;
    emca::Mesh displayMesh() const override;
    ShapePlace placeAt(Vec3f position) const override;
    std::uint64_t triangleCount() const override { return tessellation_.triangles.size(); }

    /// Nearest distance along the ray in (nearest, farthest), or nothing.
    std::optional<double> intersect(Vec3d origin, Vec3d direction, double nearest, double farthest) const;
    /// Corners of a box around it.
    Vec3f lowerCorner() const;
    Vec3f upperCorner() const;

  private:
    Vec3f toLocal(Vec3f position) const;  ///< direction from the centre, in object space
    bool sampleFromInside(Vec3f from, Vec2f u, ShapeSample& sample) const;

    Vec3d center_;
    double radius_;
    float normalSign_;       ///< -1 if the front is the inside
    float positionError_;
    Transform toObject_;     ///< to the unit sphere
    TriangleMesh tessellation_;
};

}  // namespace emca::render
