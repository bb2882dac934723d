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

bool ImageRenderer::addSamples(Pixel pixel, SampleRange pass, const RenderOptions& options, const RenderCallbacks& callbacks,
                               SurfaceTally* surface, PixelSums& sums) const {
    const PathIntegrator integrator(*scene_, options.integrator);
    Sampler sampler(options.sampler, options.seed);
    emca::PathRecorder& emca = emca::recorder();
    for (std::uint32_t index = pass.first; index < pass.last; ++index) {
        if (index % kSamplesBetweenChecks == kSamplesBetweenChecks - 1 && callbacks.cancelled &&
            callbacks.cancelled()) {
            return false;
        }
        sums.add(samplePixel(pixel, index, sampler, integrator, emca, surface));
    }
    emca.endPath();
    return true;
}

bool ImageRenderer::renderTile(PixelRect tile, SampleRange pass, const RenderOptions& options,
                               const RenderCallbacks& callbacks, SurfaceTally* surface, PixelSums* kept,
                               RenderedImage& image) const {
    std::vector<Color> colors;
    if (callbacks.tileDone) colors.reserve(tile.count());
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            if (callbacks.cancelled && callbacks.cancelled()) return false;
            PixelSums fresh;
            PixelSums& sums = kept ? kept[std::size_t(y) * image.color.width() + x] : fresh;
            if (!addSamples({x, y}, pass, options, callbacks, surface, sums)) return false;
            const Color mean = sums.mean();
            image.color.setColor({x, y}, mean);
            image.variance.setColor({x, y}, sums.variance());
            *image.samples.at({x, y}) = static_cast<float>(pass.last);
            if (callbacks.tileDone) colors.push_back(mean);
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
    std::atomic<std::uint64_t> done = 0;  // samples per pixel, summed over tiles
    std::atomic<bool> stop = false;
    const std::optional<PathLayers> layers = surface ? std::optional<PathLayers>(*surface) : std::nullopt;
    std::vector<PixelSums> kept(layers ? std::size_t(width) * height : 0);

    tbb::task_arena arena(threads_);
    for (const SampleRange pass : samplePasses(options.samplesPerPixel, layers.has_value())) {
        const auto renderTiles = [&](const tbb::blocked_range<std::uint32_t>& range) {
            for (std::uint32_t i = range.begin(); i < range.end() && !stop; ++i) {
                const std::uint32_t x = i % columns * kTileSize, y = i / columns * kTileSize;
                const PixelRect tile{x, y, std::min(x + kTileSize, width), std::min(y + kTileSize, height)};
                std::optional<SurfaceTally> tally;
                if (layers) tally.emplace(*layers);
                if (!renderTile(tile, pass, options, callbacks, tally ? &*tally : nullptr,
                                layers ? kept.data() : nullptr, image)) {
                    stop = true;
                }
                const std::uint64_t finished = done += pass.last - pass.first;
                if (callbacks.progress && !stop)
                    callbacks.progress(double(finished) / (double(tiles) * options.samplesPerPixel));
            }
        };
        arena.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tiles, 1), renderTiles, tbb::simple_partitioner());
        });
        if (stop) return cancelledError();
        if (layers && pass.last < options.samplesPerPixel)
            surface->passDone(double(pass.last) / options.samplesPerPixel);
    }
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
    PixelSums sums;
    if (!addSamples(pixel, {0, options.samplesPerPixel}, options, callbacks, nullptr, sums)) return cancelledError();
    return sums.mean();
}

}  // namespace emca::render
