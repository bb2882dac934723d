#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/analysis/tone_map.h"
#include "emca/core/mesh.h"
#include "emca/core/surface_field.h"

// What views and files show of surface layers. "Per face" means: per refined face of all meshes, in the order of the
// value arrays of a SurfaceField.
namespace emca::analysis {

/// Faces of a mean layer where nothing was added: neither a colour of a map nor one of the marks of color_map.h.
inline constexpr Color8 kNoDataColor{112, 112, 112};

/// World-space area per face: each division quarters that of the scene's triangle. 0 for triangles without area and
/// those whose vertices are missing or not finite.
/// \param field   valid for `meshes` (emca::validate)
std::vector<float> surfaceAreas(const SurfaceField& field, std::span<const Mesh> meshes);

/// One number per face: the value, or the luminance of a colour.
std::vector<float> surfaceScalars(const SurfaceLayerData& layer);

struct SurfaceRangeOptions {
    double lower = 0.01, upper = 0.99;  ///< share of the area with values below the range's begin and below its end
    bool log = false;                   ///< values <= 0 do not count
    bool zeros = true;                  ///< false: values of 0 do not count. For sums and densities, where most of a scene may
                                        ///< have none and the rest is what one looks at
};
/// As all views and files choose the range of a layer: zeros count for means only.
constexpr SurfaceRangeOptions surfaceRangeOptions(LayerKind kind) {
    SurfaceRangeOptions options;
    options.zeros = kind == LayerKind::mean || kind == LayerKind::meanColor;
    return options;
}
/// Range for a colour bar: quantiles of the finite values, weighted by area so that it does not depend on how finely
/// faces are divided. Always valid; [0, 1] (log: [1e-3, 1]) where there is nothing to go by.
/// \param areas  one per value, or empty: all weigh the same
ValueRange surfaceRange(std::span<const float> values, std::span<const float> areas, const SurfaceRangeOptions& options = {});

/// Moments and extremes of the finite values, weighted by area: the mean is that over the surface.
struct SurfaceStatistics {
    std::uint64_t faces = 0;         ///< all values
    std::uint64_t finite = 0;        ///< of these: finite
    double area = 0;                 ///< of the finite ones
    double min = 0, max = 0;         ///< 0 if there is no finite value
    double mean = 0;                 ///< 0 if there is no area
    double deviation = 0;            ///< square root of the mean square distance from `mean`
    double integral = 0;             ///< of the value over the surface: of a density, the number of events
};
SurfaceStatistics surfaceStatistics(std::span<const float> values, std::span<const float> areas);

/// Per face: the colour of its value; kNoDataColor for NaN.
std::vector<Color8> surfaceColors(std::span<const float> values, const ColorMap& map, const ValueRange& range);
/// Of a colour layer, per face: its colour through the tone curve; kNoDataColor where a channel is NaN.
std::vector<Color8> surfaceColors(const SurfaceLayerData& layer, const ToneMapper& tones);

}  // namespace emca::analysis
