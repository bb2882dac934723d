#include "emca/adapter/pixel_loop.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"
#include "threads.h"

namespace emca::adapter {

namespace {

constexpr std::uint32_t kSamplesBetweenChecks = 64;  ///< how often a single pixel looks whether it was cancelled

Error cancelledError() { return {ErrorCode::cancelled, "The render was cancelled before it was complete."}; }

Result<void> check(const PixelLoop& loop) {
    if (loop.width == 0 || loop.height == 0) return Error{ErrorCode::invalidArgument, "The image to render has no pixels."};
    if (loop.samplesPerPixel == 0) return Error{ErrorCode::invalidArgument, "Asked for 0 samples per pixel: ask for at least 1."};
    return {};
}

/// \return false if cancelled
bool addSamples(PixelWorker& worker, Pixel pixel, SampleRange pass, const RequestMonitor& monitor, PixelSums& sums) {
    worker.beginPixel(pixel);
    for (std::uint32_t index = pass.first; index < pass.last; ++index) {
        if (index % kSamplesBetweenChecks == 0 && monitor.cancelled()) return false;
        sums.add(worker.sample(pixel, index));
    }
    recorder().endPath();
    return true;
}

/// One render of an image: what its threads share.
class ImageRender {
  public:
    ImageRender(const PixelLoop& loop, RequestMonitor& monitor, SurfaceRecorder* surface)
        : loop_(loop), monitor_(monitor), surface_(surface), columns_((loop.width - 1) / loop.tileSize + 1),
          tiles_(columns_ * ((loop.height - 1) / loop.tileSize + 1)),
          sums_(surface ? std::size_t(loop.width) * loop.height : 0) {
        image_.color = Image(loop.width, loop.height);
        image_.samples = Image(loop.width, loop.height, {"samples"});
        image_.variance = Image(loop.width, loop.height);
    }

    Result<RenderedImage> run() {
        for (const SampleRange pass : samplePasses(loop_.samplesPerPixel, surface_ != nullptr)) {
            next_ = 0;
            const auto done = onThreads(loop_.threads, [&](const std::atomic<bool>& stop) { return takeTiles(pass, stop); });
            if (!done) return done.error();
            if (surface_ && pass.last < loop_.samplesPerPixel) surface_->passDone(double(pass.last) / loop_.samplesPerPixel);
        }
        return std::move(image_);
    }

  private:
    /// What one thread does in a pass.
    Result<void> takeTiles(SampleRange pass, const std::atomic<bool>& stop) {
        auto worker = loop_.makeWorker(surface_);
        if (!worker) return worker.error();
        while (!stop) {
            const std::uint32_t tile = next_++;
            if (tile >= tiles_) break;
            const std::uint32_t x = tile % columns_ * loop_.tileSize, y = tile / columns_ * loop_.tileSize;
            if (!renderTile({x, y, std::min(x + loop_.tileSize, loop_.width), std::min(y + loop_.tileSize, loop_.height)}, pass, **worker)) {
                return cancelledError();
            }
            const std::uint64_t samples = samplesDone_ += pass.last - pass.first;
            monitor_.progress(double(samples) / (double(tiles_) * loop_.samplesPerPixel));
        }
        return {};
    }

    /// \return false if cancelled
    bool renderTile(PixelRect tile, SampleRange pass, PixelWorker& worker) {
        std::vector<Color> colors;
        colors.reserve(tile.count());
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
            for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
                const Pixel pixel{x, y};
                PixelSums fresh;
                PixelSums& sums = surface_ ? sums_[std::size_t(y) * loop_.width + x] : fresh;
                if (monitor_.cancelled() || !addSamples(worker, pixel, pass, monitor_, sums)) return false;
                colors.push_back(worker.value(pixel, sums));
                image_.color.setColor(pixel, colors.back());
                image_.variance.setColor(pixel, sums.variance());
                *image_.samples.at(pixel) = static_cast<float>(sums.count());
            }
        }
        monitor_.preview(tile, colors);
        return true;
    }

    const PixelLoop& loop_;
    RequestMonitor& monitor_;
    SurfaceRecorder* surface_;
    std::uint32_t columns_, tiles_;
    std::vector<PixelSums> sums_;  ///< of all pixels; empty where one pass is all
    std::atomic<std::uint32_t> next_ = 0;
    std::atomic<std::uint64_t> samplesDone_ = 0;
    RenderedImage image_;
};

}  // namespace

Result<RenderedImage> renderImage(const PixelLoop& loop, RequestMonitor& monitor, SurfaceRecorder* surface) {
    if (auto checked = check(loop); !checked) return checked.error();
    return ImageRender(loop, monitor, surface).run();
}

Result<Color> renderPixel(const PixelLoop& loop, Pixel pixel, RequestMonitor& monitor) {
    if (auto checked = check(loop); !checked) return checked.error();
    if (pixel.x >= loop.width || pixel.y >= loop.height) {
        return Error{ErrorCode::pixelOutOfRange, "Asked for pixel (" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + "): the image has " +
                                                     std::to_string(loop.width) + " x " + std::to_string(loop.height) + " pixels."};
    }
    const auto worker = loop.makeWorker(nullptr);
    if (!worker) return worker.error();
    PixelSums sums;
    if (!addSamples(**worker, pixel, {0, loop.samplesPerPixel}, monitor, sums)) return cancelledError();
    return (*worker)->value(pixel, sums);
}

}  // namespace emca::adapter
