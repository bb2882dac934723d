#pragma once

#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "emca/analysis/surface_values.h"
#include "emca/core/mesh.h"
#include "emca/core/surface_field.h"

namespace emca::cli {

/// How the values of a layer become colours: false colours over a robust range, or, for colour layers, their own colours
/// with the range's end as white.
struct LayerPicture {
    analysis::ValueRange range;           ///< of the values, or of the luminances of a colour layer
    analysis::SurfaceStatistics statistics;
    std::vector<analysis::Color8> colors; ///< per face of the value arrays
    std::string shownAs;                  ///< "viridis", or "exposure 1.5" (in stops)
};
/// \param field  valid for `meshes`; `layer` is one of its layers
LayerPicture pictureOf(const SurfaceField& field, const SurfaceLayerData& layer, std::span<const Mesh> meshes);

/// Writes the refined meshes as binary little-endian PLY: vertices x, y, z; faces with their vertices, float `quality` (the
/// value; of colours the luminance), of colours float r, g, b, and uchar red, green, blue as `picture` says. Meshes that no
/// sample reached come as the scene has them. NaN: no data.
/// \param comments  further lines of the header
/// \return          number of faces. Errors: as refine(). Whether the stream took all, it says itself.
Result<std::uint64_t> writePly(std::ostream& out, const SurfaceField& field, const SurfaceLayerData& layer,
                               std::span<const Mesh> meshes, const LayerPicture& picture, const std::vector<std::string>& comments);

}  // namespace emca::cli
