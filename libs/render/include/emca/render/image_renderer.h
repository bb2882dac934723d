#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "emca/core/image.h"
#include "emca/core/pixel.h"
#include "emca/core/pixel_sums.h"
#include "emca/core/result.h"
#include "emca/render/path_integrator.h"
#include "emca/render/scene.h"

namespace emca::render {

/// What a pixel depends on besides the scene.
struct RenderOptions {
    std::uint32_t samplesPerPixel = 1;  ///< 1 to kMaximumSamplesPerPixel
    SamplerKind sampler = SamplerKind::independent;
    std::uint64_t seed = 0;
    IntegratorSettings integrator;
    friend bool operator==(const RenderOptions&, const RenderOptions&) = default;
};

inline constexpr std::uint32_t kMaximumSamplesPerPixel = 1u << 20;

/// The options that the scene file asks for.
RenderOptions sceneOptions(const Scene& scene);

/// How a running render talks to whoever asked for it. Called from the rendering threads; any may be empty.
struct RenderCallbacks {
    std::function<bool()> cancelled;
    std::function<void(double fraction)> progress;  ///< done, in [0, 1]; after every tile
    std::function<void(PixelRect tile, const std::vector<Color>& colors)> tileDone;  ///< row by row
};

/// Renders images and single pixels. The value of a pixel depends on the scene, the options and the pixel alone: never
/// on threads, tiles or other pixels. May be used from several threads at once.
class ImageRenderer {
  public:
    /// \param threads  how many render an image; 0: one per processor
    explicit ImageRenderer(std::shared_ptr<const Scene> scene, int threads = 0);

    /// Errors: invalidArgument (samples per pixel 0), tooLarge (beyond kMaximumSamplesPerPixel), cancelled.
    /// \param surface  collects 3D data on surfaces meanwhile, over the meshes of scene(); null: none. The image is the
    ///                 same, bit by bit.
    Result<RenderedImage> renderImage(const RenderOptions& options, const RenderCallbacks& callbacks = {},
                                      SurfaceRecorder* surface = nullptr) const;

    /// The same pixel again, bit by bit, in the calling thread; if that is inside a RecordScope, its paths are recorded.
    /// Errors: as renderImage, and pixelOutOfRange.
    Result<Color> renderPixel(Pixel pixel, const RenderOptions& options, const RenderCallbacks& callbacks = {}) const;

    const Scene& scene() const { return *scene_; }
    int threads() const { return threads_; }

  private:
    /// \return false if cancelled
    bool addSamples(Pixel pixel, SampleRange pass, const RenderOptions& options, const RenderCallbacks& callbacks,
                    SurfaceTally* surface, PixelSums& sums) const;
    Color samplePixel(Pixel pixel, std::uint32_t index, Sampler& sampler, const PathIntegrator& integrator,
                      emca::PathRecorder& emca, SurfaceTally* surface) const;
    /// \param kept  sums of the passes before, for all pixels of the image; null: this pass is all
    /// \return false if cancelled
    bool renderTile(PixelRect tile, SampleRange pass, const RenderOptions& options, const RenderCallbacks& callbacks,
                    SurfaceTally* surface, PixelSums* kept, RenderedImage& image) const;

    std::shared_ptr<const Scene> scene_;
    int threads_;
};

}  // namespace emca::render
