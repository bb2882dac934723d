#pragma once

#include <optional>
#include <vector>

#include "emca/render/distribution.h"
#include "emca/render/shape.h"
#include "emca/render/triangle_mesh.h"
#include "shapes/parallelogram.h"

namespace emca::render {

/// Triangles, with interpolated normals where the mesh has some.
class MeshShape final : public Shape {
  public:
    explicit MeshShape(TriangleMesh mesh);

    void interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const override;
    float area() const override { return area_; }
    bool sample(Vec3f from, Vec2f u, ShapeSample& sample) const override;
    float pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const override;
    Vec2f uv(std::int32_t face, Vec2f barycentrics, Vec3f position) const override;
    RTCGeometryTy* makeGeometry(RTCDeviceTy* device) const override;
    emca::Mesh displayMesh() const override;
    ShapePlace placeAt(Vec3f position) const override;
    std::uint64_t triangleCount() const override { return mesh_.triangles.size(); }

    /// sample() needs to know the areas; only lights pay for that. Before the shape joins a scene.
    void prepareSampling();
    /// Builds in the error of the paper's Figure 9, for those who want to find it: one random number chooses both the
    /// triangle and the point on it, so that parts of the triangles are never sampled. Before the shape joins a scene.
    void reuseTriangleSample();

  private:
    void sampleTriangle(Vec2f u, ShapeSample& sample) const;

    /// What every hit needs of a triangle, in one cache line.
    struct alignas(64) Face {
        Vec3f corner;           ///< first vertex
        Vec3f edgeU, edgeV;     ///< from there to the second and the third vertex
        Vec3f normal;           ///< unit
        float positionError;
        Vec3f at(float u, float v) const { return corner + edgeU * u + edgeV * v; }
    };
    TriangleMesh mesh_;
    std::vector<Face> faces_;   ///< one per triangle
    Distribution1D triangles_;  ///< by area; empty before prepareSampling()
    std::optional<Parallelogram> parallelogram_;  ///< how to sample the mesh if it is one; empty before prepareSampling()
    float area_ = 0;
    bool reusesTriangleSample_ = false;
};

}  // namespace emca::render
