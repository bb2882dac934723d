#pragma once

#include "emca/adapter/parametric_mesh.h"
#include "inside.h"

namespace emca::pbrt4 {

/// From the space in which pbrt renders to world space, for positions and directions.
class WorldSpace {
  public:
    WorldSpace() = default;
    explicit WorldSpace(const pbrt::CameraTransform& camera)
        : worldFromRender_(camera.WorldFromRender()), renderFromWorld_(camera.RenderFromWorld()) {}

    Vec3f point(pbrt::Point3f p) const { return toVec(worldFromRender_(p)); }
    Vec3f direction(pbrt::Vector3f v) const { return toVec(worldFromRender_(v)); }
    pbrt::Point3f toRender(Vec3f p) const { return renderFromWorld_(pbrt::Point3f(p.x, p.y, p.z)); }
    pbrt::Vector3f directionToRender(Vec3f v) const { return renderFromWorld_(pbrt::Vector3f(v.x, v.y, v.z)); }
    const pbrt::Transform& worldFromRender() const { return worldFromRender_; }

  private:
    template <typename T>
    static Vec3f toVec(const T& p) {
        return {float(p.x), float(p.y), float(p.z)};
    }

    pbrt::Transform worldFromRender_, renderFromWorld_;
};

/// The grid over a quadric's (u, v), which are pbrt's own of an interaction on it.
adapter::ParametricMesh gridOf(const pbrt::Sphere& sphere);
adapter::ParametricMesh gridOf(const pbrt::Disk& disk);
adapter::ParametricMesh gridOf(const pbrt::Cylinder& cylinder);
/// The point of a parameter, render space.
pbrt::Point3f pointAt(const pbrt::Sphere& sphere, Vec2f uv);
pbrt::Point3f pointAt(const pbrt::Disk& disk, Vec2f uv);
pbrt::Point3f pointAt(const pbrt::Cylinder& cylinder, Vec2f uv);

/// A bilinear patch by its corners (0, 0), (1, 0), (0, 1), (1, 1).
struct PatchCorners {
    pbrt::Point3f p00, p10, p01, p11;
    pbrt::Point3f at(Vec2f uv) const;
    /// The parameter of the point of the patch nearest to p, for points that lie on it within rounding. pbrt's own (u,
    /// v) of an interaction may be texture coordinates instead.
    Vec2f parameterOf(pbrt::Point3f p) const;
    bool isPlane() const;
};
PatchCorners cornersOf(const pbrt::BilinearPatchMesh& mesh, int patch);
/// 1 x 1 for parallelograms.
adapter::ParametricMesh gridOf(const PatchCorners& patch);

/// A curve as a tube around it: u along the curve, v around it. Flat curves turn towards each ray, so that no set of
/// triangles is what rays hit; the tube has their width.
class CurveTube {
  public:
    explicit CurveTube(const pbrt::CurveCommon& curve) : curve_(&curve) {}
    pbrt::Point3f at(Vec2f uv) const;  ///< render space
    /// Of a hit at `u` along the curve, at `p` in render space.
    Vec2f parameterOf(float u, pbrt::Point3f p) const;
    static adapter::ParametricMesh grid() { return {.columns = 8, .rows = 4}; }

  private:
    struct Place {
        pbrt::Point3f centre;
        pbrt::Vector3f side, up;
        float radius;
    };
    Place place(float u) const;  ///< in the curve's own space
    const pbrt::CurveCommon* curve_;
};

}  // namespace emca::pbrt4
