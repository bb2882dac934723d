#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "mesh_geometry.h"

namespace emca::explorer {

/// Fewer triangles of the same shape, by vertex clustering: all vertices of a cell of a grid become one at their mean, and
/// triangles with two corners in one cell vanish. One pass over the vertices and one over the triangles, whatever the
/// mesh is like; large flat triangles stay as they are.
/// Source: Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993.
/// \param cells  along the longest edge of the box, at most 2^20
ShadedTriangles clustered(const ShadedTriangles& full, std::uint32_t cells);

/// A stand-in of about `wanted` triangles (between 0.4 and 2 times as many, where clustering can do that).
/// Any thread. \param cancel  then the result is of no use
ShadedTriangles standIn(const ShadedTriangles& full, std::size_t wanted, const std::atomic<bool>* cancel = nullptr);

}  // namespace emca::explorer
