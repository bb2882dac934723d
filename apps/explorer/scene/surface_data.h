#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/analysis/surface_values.h"
#include "emca/core/surface_field.h"
#include "surface_picker.h"

namespace emca::explorer {

/// What is known of a layer before anybody looks at it, so that showing it takes no more than its colours.
struct LayerNumbers {
    std::vector<float> scalars;               ///< of colour layers: luminance; others are their own values
    analysis::SurfaceStatistics statistics;
    double lower = 0, upper = 0;              ///< shares of the area that the ranges leave out
    analysis::ValueRange linear, log;
};

/// A surface field with its scene, ready to be drawn, coloured and asked. Made by any thread, never changed afterwards.
struct PreparedSurface {
    std::shared_ptr<const std::vector<Mesh>> meshes;
    std::shared_ptr<const SurfaceField> field;

    // Triangles of all meshes as one buffer: first the refined ones in the order of the field's values, then those of
    // meshes without data. Orientation and places are those of the scene.
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
    std::size_t dataFaces = 0;                ///< triangles that have values

    /// Stand-in while the camera moves: fewer, larger faces. Of each, the run of data faces that it takes the place of;
    /// those of meshes without data follow. Empty if the whole is drawn fast enough or cannot be made coarser.
    std::vector<Vec3f> coarsePositions;
    std::vector<Triangle> coarseTriangles;
    std::vector<std::uint32_t> coarseFirst;   ///< per coarse data face + 1

    std::vector<float> areas;                 ///< per data face
    std::vector<std::optional<SurfaceLocator>> locators;   ///< per mesh; nothing for those without data
    SurfacePicker picker;
    std::vector<LayerNumbers> layers;         ///< as field->layers

    std::span<const float> scalars(std::size_t layer) const {
        const LayerNumbers& numbers = layers[layer];
        return numbers.scalars.empty() ? field->layers[layer].values.span() : std::span<const float>(numbers.scalars);
    }
};

/// \param lower, upper  shares of the area for the ranges that are found in advance
/// \param cancel        checked now and then; then the result is null or incomplete, and to be thrown away
/// Errors: as emca::validate (the field does not belong to these meshes).
Result<std::shared_ptr<const PreparedSurface>> prepareSurface(std::shared_ptr<const std::vector<Mesh>> meshes,
                                                              std::shared_ptr<const SurfaceField> field, double lower,
                                                              double upper, const std::atomic<bool>* cancel = nullptr);

/// Which values count for the range of a layer.
analysis::SurfaceRangeOptions rangeOptions(LayerKind kind, double lower, double upper, bool log);

/// Colours of the stand-in's data faces: means of those that they take the place of.
std::vector<analysis::Color8> coarseColors(const PreparedSurface& surface, std::span<const analysis::Color8> colors);

inline constexpr std::size_t kCoarseAbove = 200000;  ///< faces; fewer are drawn fast enough while the camera moves
inline constexpr std::size_t kCoarseFaces = 60000;   ///< of the stand-in, if the scene has not more by itself

}  // namespace emca::explorer
