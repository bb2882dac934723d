#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <mitsuba/render/imageblock.h>

#include "emca/adapter/pixel_loop.h"
#include "emca/recorder/path_layers.h"
#include "mitsuba_headers.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// What Mitsuba's film holds of a pixel: spectrum, alpha and weight.
using FilmPixel = std::array<mts::Float, SPECTRUM_SAMPLES + 2>;

/// What the workers of one request share.
struct SamplingTask {
    const mts::Scene* scene = nullptr;
    const TracedIntegrator* integrator = nullptr;
    const SceneShapes* shapes = nullptr;
    mts::ReconstructionFilter* filter = nullptr;  ///< a box
    /// Of all pixels, row by row; null where each pixel gets all its samples at once.
    std::shared_ptr<std::vector<FilmPixel>> film;
};

/// Samples pixels as Mitsuba's sampling integrators do: the same calls to sampler and sensor in the same order, and its
/// own film code for the pixel's value.
class PixelSampler final : public adapter::PixelWorker {
  public:
    /// In the thread that samples. \param sampler  of this worker alone
    PixelSampler(SamplingTask task, mts::ref<mts::Sampler> sampler, SurfaceRecorder* surface);

    void beginPixel(Pixel pixel) override;
    Color sample(Pixel pixel, std::uint32_t index) override;
    Color value(Pixel pixel, const PixelSums& sums) override;

  private:
    mts::Float* filmPixel();  ///< where the block has the pixel
    std::size_t place(Pixel pixel) const { return std::size_t(pixel.y) * width_ + pixel.x; }

    SamplingTask task_;
    mts::ref<mts::Sampler> sampler_;
    std::optional<PathLayers> layers_;  ///< while some are collected
    std::optional<PathTally> tally_;
    const mts::Sensor& sensor_;
    mts::ref<mts::ImageBlock> block_;  ///< one pixel and the film's border
    mts::Point2i at_;
    std::uint32_t width_;
    mts::Float differentialScale_;
    int queryType_;
    mts::RadianceQueryRecord query_;
};

}  // namespace emca::mitsuba06
