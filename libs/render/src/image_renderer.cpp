#include "emca/render/image_renderer.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>

namespace emca::render {

namespace {

constexpr std::uint32_t kTileSize = 16;               ///< pixels a side
constexpr std::uint32_t kSamplesBetweenChecks = 256;  ///< how often a single pixel looks whether it was cancelled

Result<void> check(const RenderOptions& options) {
    if (options.samplesPerPixel == 0) {
        return Error{ErrorCode::invalidArgument, "Asked for 0 samples per pixel: ask for at least 1."};
    }
    if (options.samplesPerPixel > kMaximumSamplesPerPixel) {
        return Error{ErrorCode::tooLarge, "Asked for " + std::to_string(options.samplesPerPixel) +
                                              " samples per pixel: at most " +
                                              std::to_string(kMaximumSamplesPerPixel) + " are possible."};
    }
    return {};
}

Error cancelledError() { return {ErrorCode::cancelled, "The render was cancelled before it was complete."}; }

/// Sums of one channel in double precision, where neither a million samples nor their squares lose digits that a
/// float could show.
struct ChannelSums {
    double sum = 0, squares = 0;
    void add(float value) {
        sum += double(value);
        squares += double(value) * double(value);
    }
    float mean(double count) const { return static_cast<float>(sum / count); }
    float variance(double count) const {
        if (count < 2) return 0.f;
        const double variance = (squares - sum * sum / count) / (count - 1);
        return static_cast<float>(variance < 0 ? 0 : variance);  // NaN stays NaN
    }
};

}  // namespace

RenderOptions sceneOptions(const Scene& scene) {
    return {scene.samplesPerPixel(), scene.sampler(), 0, scene.integrator()};
}

ImageRenderer::ImageRenderer(std::shared_ptr<const Scene> scene, int threads)
    : scene_(std::move(scene)), threads_(threads > 0 ? threads : tbb::info::default_concurrency()) {}

Color ImageRenderer::samplePixel(Pixel pixel, std::uint32_t index, Sampler& sampler, const PathIntegrator& integrator,
                                 emca::PathRecorder& emca, SurfaceTally* surface) const {
    sampler.start(pixel, index);
    const Vec2f uFilm = sampler.next2D();
    const Vec2f uLens = scene_->camera().hasLens() ? sampler.next2D() : Vec2f{0.5f, 0.5f};
    const Vec2f offset = scene_->filter().sample(uFilm);
    const Vec2f film{static_cast<float>(pixel.x) + 0.5f + offset.x, static_cast<float>(pixel.y) + 0.5f + offset.y};
    const Ray ray = scene_->camera().ray(film, uLens);

    emca.setPathIndex(index);
    emca.setPathOrigin(ray.origin);
    emca.addPathData("random numbers (pixel)", uFilm);
    if (scene_->camera().hasLens()) emca.addPathData("random numbers (lens)", uLens);
    emca.addPathData("film position", film);
    return integrator.radiance(ray, sampler, emca, surface);
}

ImageRenderer::PixelEstimate ImageRenderer::estimatePixel(Pixel pixel, const RenderOptions& options,
                                                          const RenderCallbacks& callbacks,
                                                          SurfaceTally* surface) const {
    const PathIntegrator integrator(*scene_, options.integrator);
    Sampler sampler(options.sampler, options.seed);
    emca::PathRecorder& emca = emca::recorder();

    ChannelSums red, green, blue;
    for (std::uint32_t index = 0; index < options.samplesPerPixel; ++index) {
        if (index % kSamplesBetweenChecks == kSamplesBetweenChecks - 1 && callbacks.cancelled &&
            callbacks.cancelled()) {
            PixelEstimate incomplete;
            incomplete.complete = false;
            return incomplete;
        }
        const Color radiance = samplePixel(pixel, index, sampler, integrator, emca, surface);
        red.add(radiance.r), green.add(radiance.g), blue.add(radiance.b);
    }
    emca.endPath();
    const double count = options.samplesPerPixel;
    return {{red.mean(count), green.mean(count), blue.mean(count)},
            {red.variance(count), green.variance(count), blue.variance(count)},
            true};
}

bool ImageRenderer::renderTile(PixelRect tile, const RenderOptions& options, const RenderCallbacks& callbacks,
                               SurfaceTally* surface, RenderedImage& image) const {
    std::vector<Color> colors;
    if (callbacks.tileDone) colors.reserve(tile.count());
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            if (callbacks.cancelled && callbacks.cancelled()) return false;
            const PixelEstimate estimate = estimatePixel({x, y}, options, callbacks, surface);
            if (!estimate.complete) return false;
            image.color.setColor({x, y}, estimate.mean);
            image.variance.setColor({x, y}, estimate.variance);
            *image.samples.at({x, y}) = static_cast<float>(options.samplesPerPixel);
            if (callbacks.tileDone) colors.push_back(estimate.mean);
        }
    }
    if (callbacks.tileDone) callbacks.tileDone(tile, colors);
    return true;
}

Result<RenderedImage> ImageRenderer::renderImage(const RenderOptions& options, const RenderCallbacks& callbacks,
                                                 SurfaceRecorder* surface) const {
    if (auto checked = check(options); !checked) return checked.error();
    const std::uint32_t width = scene_->width(), height = scene_->height();
    RenderedImage image{Image(width, height), Image(width, height, {"samples"}), Image(width, height)};
    const std::uint32_t columns = (width + kTileSize - 1) / kTileSize, rows = (height + kTileSize - 1) / kTileSize;
    const std::uint32_t tiles = columns * rows;
    std::atomic<std::uint32_t> done = 0;
    std::atomic<bool> stop = false;
    const std::optional<SurfaceLayers> layers = surface ? std::optional<SurfaceLayers>(*surface) : std::nullopt;

    tbb::task_arena arena(threads_);
    arena.execute([&] {
        const auto renderTiles = [&](const tbb::blocked_range<std::uint32_t>& range) {
            for (std::uint32_t i = range.begin(); i < range.end() && !stop; ++i) {
                const std::uint32_t x = i % columns * kTileSize, y = i / columns * kTileSize;
                const PixelRect tile{x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)};
                std::optional<SurfaceTally> tally;
                if (layers) tally.emplace(*layers);
                if (!renderTile(tile, options, callbacks, tally ? &*tally : nullptr, image)) stop = true;
                const std::uint32_t finished = ++done;
                if (callbacks.progress && !stop) callbacks.progress(double(finished) / tiles);
            }
        };
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tiles, 1), renderTiles, tbb::simple_partitioner());
    });
    if (stop) return cancelledError();
    return image;
}

Result<Color> ImageRenderer::renderPixel(Pixel pixel, const RenderOptions& options,
                                         const RenderCallbacks& callbacks) const {
    if (auto checked = check(options); !checked) return checked.error();
    if (pixel.x >= scene_->width() || pixel.y >= scene_->height()) {
        return Error{ErrorCode::pixelOutOfRange,
                     "Asked for pixel (" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
                         "): the image has " + std::to_string(scene_->width()) + " x " +
                         std::to_string(scene_->height()) + " pixels."};
    }
    const PixelEstimate estimate = estimatePixel(pixel, options, callbacks, nullptr);
    if (!estimate.complete) return cancelledError();
    return estimate.mean;
}

}  // namespace emca::render
