#pragma once

#include "emca/render/shape.h"
#include "emca/render/shape_mesh.h"

namespace emca::render {

/// Exact disk or ellipse.
class DiskShape final : public Shape {
  public:
    /// \param tessellation  of the same disk, as makeDisk() orders its triangles
    DiskShape(const DiskGeometry& disk, TriangleMesh tessellation, bool flipped);

    void interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const override;
    float area() const override { return area_; }
    bool sample(Vec3f from, Vec2f u, ShapeSample& sample) const override;
    float pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const override;
    Vec2f uv(std::int32_t face, Vec2f barycentrics, Vec3f position) const override;
    RTCGeometryTy* makeGeometry(RTCDeviceTy* device) const override;
    emca::Mesh displayMesh() const override;
    ShapePlace placeAt(Vec3f position) const override;
    std::uint64_t triangleCount() const override { return tessellation_.triangles.size(); }

    /// Distance along the ray in (nearest, farthest), or nothing.
    std::optional<double> intersect(Vec3d origin, Vec3d direction, double nearest, double farthest) const;
    Vec3f lowerCorner() const;
    Vec3f upperCorner() const;

  private:
    /// Coordinates in the disk's plane, the unit circle being its edge.
    Vec2d planeCoordinates(Vec3d point) const;

    Vec3d center_, axisX_, axisY_, normal_;  ///< the axes as long as the disk's half axes; the normal is unit
    Vec3d dualX_, dualY_;                    ///< dot products with these give planeCoordinates
    float normalSign_;
    float area_;
    float positionError_;
    TriangleMesh tessellation_;
};

}  // namespace emca::render
