#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "emca/core/image.h"
#include "emca/core/pixel.h"
#include "emca/core/pixel_sums.h"
#include "emca/core/result.h"
#include "emca/server/renderer.h"

/// What adapters share: images of renderers whose pixels do not depend on each other, light probes, analytic shapes as
/// triangles, and the end of a program that serves. An adapter may use any of it, or nothing.
namespace emca::adapter {

/// One thread's way of sampling pixels: holds what a thread of the renderer needs, such as its sampler and its memory.
/// Made, used and destroyed in one thread.
class PixelWorker {
  public:
    virtual ~PixelWorker() = default;

    /// Before the samples of a pixel; where layers are collected, once for each pass over the image.
    virtual void beginPixel(Pixel) {}
    /// Radiance of one sample, which depends on nothing but the pixel and the index. Samples of a pixel come in the order
    /// of their indices, which start at 0. If the thread is inside a RecordScope, the path is to be recorded, with
    /// setPathIndex(index) first.
    virtual Color sample(Pixel pixel, std::uint32_t index) = 0;
    /// The pixel as the renderer's film computes it, after all samples so far.
    virtual Color value(Pixel, const PixelSums& sums) { return sums.mean(); }
};

/// How to render the pixels of an image. A plain value, made for each request.
struct PixelLoop {
    std::uint32_t width = 0, height = 0;  ///< pixels
    std::uint32_t samplesPerPixel = 1;
    unsigned threads = 0;                 ///< that render an image; 0: one per processor
    std::uint32_t tileSize = 16;          ///< pixels a side; tiles are taken row by row
    /// Called in each thread that renders. `surface` is null unless layers are collected; the thread's cursor is
    /// surface->cursor(). Errors end the request.
    std::function<Result<std::unique_ptr<PixelWorker>>(SurfaceRecorder* surface)> makeWorker;
};

/// Renders all pixels, in threads of its own that end with it; tells the monitor of progress and finished tiles. With
/// `surface`, in the passes of samplePasses(): the same image, bit by bit, as long as the worker's samples are.
/// What a worker throws is thrown here. Errors: invalidArgument (no pixels or samples), cancelled, those of makeWorker.
Result<RenderedImage> renderImage(const PixelLoop& loop, RequestMonitor& monitor, SurfaceRecorder* surface = nullptr);

/// Renders one pixel in the calling thread, by the same functions. Errors besides: pixelOutOfRange.
Result<Color> renderPixel(const PixelLoop& loop, Pixel pixel, RequestMonitor& monitor);

}  // namespace emca::adapter
