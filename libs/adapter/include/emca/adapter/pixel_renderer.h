#pragma once

#include "emca/adapter/pixel_loop.h"

namespace emca::adapter {

/// A renderer all of whose images, layers and replayed pixels come from one PixelLoop. An adapter says how settings become
/// a loop, and describes the scene: info(), camera(), meshes() and, if its workers add to layers, surfaceLayers().
class PixelRenderer : public Renderer {
  public:
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                              RequestMonitor& monitor) override;

  private:
    /// How to render with these settings. Called once for each image and each pixel, in the request's thread; in several
    /// at once if info() says concurrent. The size is that of info().
    /// Errors end the request: invalidArgument (settings that it cannot do).
    virtual Result<PixelLoop> loopFor(const RenderSettings& settings) const = 0;
};

}  // namespace emca::adapter
