#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/mesh.h"

namespace emca::cli {

/// Meshes for looking at, with at most so many triangles.
struct ReducedMeshes {
    std::vector<Mesh> meshes;         ///< one per mesh of the scene, in its order; some may be empty
    std::uint64_t triangles = 0;      ///< of these
    std::uint64_t before = 0;         ///< of the scene
    bool reduced() const { return triangles < before; }
};

/// Vertices of a mesh that lie in the same cell of a grid become one of them, and triangles that lose their area go away;
/// the cells grow until the rest fits. Triangles with positions that are not finite go away in any case.
/// Source: Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993, with a vertex
/// of the cell in the place of the cell's mean, so that corners and flat faces stay where they are.
/// \param maximumTriangles  0: none
ReducedMeshes reduceMeshes(const std::vector<Mesh>& meshes, std::uint64_t maximumTriangles);

}  // namespace emca::cli
