#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "emca/doctor/finding.h"

// Whether a camera and meshes are what views can draw. Pure functions: what came from a renderer may be anything.
namespace emca::doctor {

/// What there is to count about a scene.
struct MeshFacts {
    std::size_t meshes = 0, vertices = 0, triangles = 0;
    std::size_t empty = 0;                ///< meshes without triangles
    std::size_t duplicates = 0;           ///< meshes with the positions and triangles of an earlier one
    std::size_t badIndices = 0;           ///< triangles that use a vertex which their mesh does not have
    std::size_t nonFinitePositions = 0;   ///< vertices with NaN or infinity
    std::size_t degenerate = 0;           ///< triangles without area
    /// One each, "" if there is none: "mesh 3 (lamp), triangle 12".
    std::string badIndexExample, nonFiniteExample, duplicateExample, emptyExample;
    BoundingBox box;                      ///< of the finite positions
};
MeshFacts inspect(const std::vector<Mesh>& meshes);

/// \param announcedMeshes, announcedTriangles  as the renderer's info counts them
Finding checkMeshes(const std::vector<Mesh>& meshes, std::uint64_t announcedMeshes, std::uint64_t announcedTriangles);

/// Finite, unit, orthogonal, a field of view that an image can have, near before far, in or near the scene's box and
/// looking at it.
Finding checkCamera(const Camera& camera, const BoundingBox& scene);

/// Where on the image the light paths of some pixels were seen to begin, and where the camera would have them.
class CameraRays {
  public:
    /// \param width, height  of the image, pixels
    CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height);
    /// Takes each path's origin and first vertex. Camera subpaths only.
    void add(const PathSet& paths);
    /// Each first segment, projected by the camera, must fall near its pixel. If it does not, cameras with one thing
    /// changed (mirrored, upside down, field of view meant for the width) are tried, so that the sentence can say which it is.
    Finding finding() const;

  private:
    struct Ray { Pixel pixel; Vec3f origin; Vec3f target; bool hasOrigin; };
    std::vector<double> deviations(const Camera& camera) const;
    Camera camera_;
    std::uint32_t width_, height_;
    std::vector<Ray> rays_;
};

}  // namespace emca::doctor
