#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "emca/core/mesh.h"
#include "scene_options.h"
#include "view_pose.h"

namespace emca::explorer {

struct Ray {
    Vec3d origin, direction;   ///< unit direction
};
/// Of a pixel of the view. Of a parallel projection it starts `behind` before the plane of the eye, which sees what is
/// behind it too.
Ray rayThrough(const ViewPose& pose, Viewport viewport, double x, double y, double behind = 0);

struct SurfaceHit {
    std::uint32_t mesh = 0, face = 0;
    float u = 0, v = 0;        ///< barycentric: weights of the second and third vertex
    double distance = 0;
    bool back = false;         ///< seen from behind
};

/// Finds the surface under the cursor on the CPU: exact, independent of the driver, no frame drawn. Triangles in their
/// order are taken together by 64, with a box around each bunch: no tree, quick to make, and as meshes keep neighbours
/// together, a ray meets few of the boxes.
class SurfacePicker {
  public:
    SurfacePicker() = default;
    explicit SurfacePicker(std::shared_ptr<const std::vector<Mesh>> meshes);

    /// The first surface along the ray that a person means: with hidden back faces only fronts; with faded ones a front
    /// before a back; else whatever comes first. Triangles that are faulty or without area are never hit.
    std::optional<SurfaceHit> pick(const Ray& ray, BackFaces backFaces) const;

  private:
    struct Bunch {
        Vec3f min, max;
        std::uint32_t mesh, first, last;
    };
    std::shared_ptr<const std::vector<Mesh>> meshes_;
    std::vector<Bunch> bunches_;
};

}  // namespace emca::explorer
