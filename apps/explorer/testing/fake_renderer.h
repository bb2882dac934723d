#pragma once

#include <atomic>
#include <string>

#include "emca/server/renderer.h"

namespace emca::explorer {

/// A renderer without a scene: every pixel, sample and vertex has a value that can be computed, so that tests know what
/// must be shown. Deterministic; renders row by row and honours cancel.
class FakeRenderer : public Renderer {
  public:
    std::string scene = "fake";
    std::uint32_t width = 24, height = 16, samplesPerPixel = 4, depth = 2;
    std::atomic<int> rowMilliseconds{0};      ///< how long a row of a render takes
    std::atomic<int> pixelMilliseconds{0};    ///< how long a replay takes
    std::atomic<bool> sceneFails{false};      ///< says how large its scene is, then fails to send it
    std::atomic<int> replays{0};              ///< pixels asked for so far

    RendererInfo info() const override;
    Camera camera() const override;
    std::vector<Mesh> meshes() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording, RequestMonitor& monitor) override;

    /// What a sample of a pixel carries.
    static Color sampleValue(Pixel pixel, std::uint32_t sample);
    static Color pixelValue(Pixel pixel, std::uint32_t samples);

  private:
    mutable std::atomic<int> sceneRequests_{0};
};

}  // namespace emca::explorer
