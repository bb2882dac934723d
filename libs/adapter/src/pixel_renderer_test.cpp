#include "emca/adapter/pixel_renderer.h"

#include <gtest/gtest.h>

#include <cstring>

#include "emca/core/seed_map.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"

namespace emca::adapter {
namespace {

class Quiet final : public RequestMonitor {
  public:
    bool cancelled() const override { return false; }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
};

/// Noise whose every sample is also a point on the scene's only triangle.
class NoiseWorker final : public PixelWorker {
  public:
    NoiseWorker(std::uint64_t seed, SurfaceRecorder* surface) : seeds_(seed), surface_(surface) {}
    Color sample(Pixel pixel, std::uint32_t index) override {
        const Color value(static_cast<float>(seeds_.seed(pixel, index) >> 40) * 0x1p-24f);
        recorder().setPathIndex(index);
        recorder().setFinalEstimate(value);
        if (surface_) surface_->find("density").add(surface_->cursor().locate(0, 0, Vec2f{0.25f, 0.25f}));
        return value;
    }

  private:
    SeedMap seeds_;
    SurfaceRecorder* surface_;
};

class NoiseRenderer final : public PixelRenderer {
  public:
    RendererInfo info() const override { return {.width = 23, .height = 11, .samplesPerPixel = 6, .seed = 5}; }
    Camera camera() const override { return {}; }
    std::vector<Mesh> meshes() const override { return {Mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}}}; }

  private:
    Result<PixelLoop> loopFor(const RenderSettings& settings) const override {
        if (!settings.integrator.empty()) return Error{ErrorCode::invalidArgument, "There is no " + settings.integrator + "."};
        const RendererInfo own = info();
        PixelLoop loop;
        loop.width = own.width;
        loop.height = own.height;
        loop.samplesPerPixel = settings.samplesPerPixel > 0 ? settings.samplesPerPixel : own.samplesPerPixel;
        loop.threads = 2;
        loop.makeWorker = [seed = settings.hasSeed ? settings.seed : own.seed](SurfaceRecorder* surface) -> Result<std::unique_ptr<PixelWorker>> {
            return std::make_unique<NoiseWorker>(seed, surface);
        };
        return loop;
    }
};

bool equalBits(const Image& a, const Image& b) { return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0; }

TEST(PixelRenderer, ImageLayersAndPixelsAreOfOneLoop) {
    NoiseRenderer renderer;
    Quiet monitor;
    const RenderSettings settings{.samplesPerPixel = 9, .seed = 3, .hasSeed = true};
    const auto image = renderer.renderImage(settings, monitor);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->color.width(), 23u);
    EXPECT_EQ(*image->samples.at({22, 10}), 9.f);

    const std::vector<Mesh> meshes = renderer.meshes();
    SurfaceRecorder surface(meshes);
    ASSERT_TRUE(surface.addLayer({"density", LayerKind::density, "", ""}));
    const auto withLayers = renderer.renderImageWithLayers(settings, surface, monitor);
    ASSERT_TRUE(withLayers);
    EXPECT_TRUE(equalBits(image->color, withLayers->color));
    (void)surface.finish();
    EXPECT_EQ(surface.counts().points, 23u * 11u * 9u);

    Recording recording;
    Result<Color> pixel = Color();
    {
        const RecordScope scope(recording, Pixel{22, 10});
        pixel = renderer.renderPixel({22, 10}, settings, recording, monitor);
    }
    ASSERT_TRUE(pixel);
    EXPECT_EQ(*pixel, image->color.color({22, 10}));
    const auto paths = recording.finish();
    ASSERT_TRUE(paths);
    EXPECT_EQ(paths->pathCount(), 9u);

    const auto asTheSceneSays = renderer.renderImage({}, monitor);
    ASSERT_TRUE(asTheSceneSays);
    EXPECT_EQ(*asTheSceneSays->samples.at({0, 0}), 6.f);
    EXPECT_FALSE(equalBits(image->color, asTheSceneSays->color));
}

TEST(PixelRenderer, SettingsThatMakeNoLoopEndEveryRequest) {
    NoiseRenderer renderer;
    Quiet monitor;
    const RenderSettings settings{.integrator = "radiosity"};
    const std::vector<Mesh> meshes = renderer.meshes();
    SurfaceRecorder surface(meshes);
    Recording recording;
    EXPECT_EQ(renderer.renderImage(settings, monitor).error().message, "There is no radiosity.");
    EXPECT_EQ(renderer.renderImageWithLayers(settings, surface, monitor).error().message, "There is no radiosity.");
    EXPECT_EQ(renderer.renderPixel({0, 0}, settings, recording, monitor).error().message, "There is no radiosity.");
    EXPECT_EQ(renderer.renderPixel({23, 0}, {}, recording, monitor).error().code, ErrorCode::pixelOutOfRange);
}

}  // namespace
}  // namespace emca::adapter
