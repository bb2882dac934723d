#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/surface_field.h"
#include "messages.h"

namespace emca::bridge {

/// The two ways in which a published heat map is offered: as the colours that came, and as one number for a face.
const LayerDescription& heatMapColors();
const LayerDescription& heatMapNumbers();

/// A published heat map on the meshes of the scene.
struct HeatMap {
    SurfaceField field;
    std::uint64_t faces = 0;    ///< of the heat map
    std::uint64_t without = 0;  ///< triangles of the scene for which it has none: their values are NaN
};

/// Finds the tree of 1-to-4 divisions again from the triangles that it left, which is all that the wire has. A triangle of
/// the scene is either among them or divided at the midpoints of its edges, which published servers compute as
/// (a + b) * 0.5 in single precision: bits are compared, never distances.
///
/// \param meshes  of the scene as it came before any render; a mesh without a shape in `shapes` has no values
/// \param shapes  with face colours; those without have no values
/// \param layers  heatMapColors(), heatMapNumbers() or both, in the order wanted
HeatMap heatMapOn(std::span<const Mesh> meshes, std::span<const PublishedShape> shapes, std::span<const LayerDescription> layers);

}  // namespace emca::bridge
