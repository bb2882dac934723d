#include "emca/adapter/pixel_renderer.h"

namespace emca::adapter {

Result<RenderedImage> PixelRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    const auto loop = loopFor(settings);
    return loop ? adapter::renderImage(*loop, monitor) : loop.error();
}

Result<RenderedImage> PixelRenderer::renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                           RequestMonitor& monitor) {
    const auto loop = loopFor(settings);
    return loop ? adapter::renderImage(*loop, monitor, &surface) : loop.error();
}

Result<Color> PixelRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor& monitor) {
    const auto loop = loopFor(settings);
    // The server opened the RecordScope of this thread, and the whole pixel is rendered in it.
    return loop ? adapter::renderPixel(*loop, pixel, monitor) : loop.error();
}

}  // namespace emca::adapter
