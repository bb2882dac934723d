#include "emca/adapter/pixel_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <mutex>
#include <set>
#include <stdexcept>

#include "emca/core/seed_map.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"

namespace emca::adapter {
namespace {

class TestMonitor final : public RequestMonitor {
  public:
    bool cancelled() const override { return stop; }
    void progress(double fraction) override {
        const std::lock_guard lock(mutex);
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        furthest = std::max(furthest, fraction);
    }
    void preview(PixelRect rect, const std::vector<Color>& colors) override {
        const std::lock_guard lock(mutex);
        EXPECT_EQ(colors.size(), rect.count());
        pixelsSeen += rect.count();
    }
    std::atomic<bool> stop = false;
    std::mutex mutex;
    double furthest = 0;
    std::size_t pixelsSeen = 0;
};

Color noise(Pixel pixel, std::uint32_t index) {
    const std::uint64_t bits = SeedMap(7).seed(pixel, index);
    return {static_cast<float>(bits >> 40) * 0x1p-24f, static_cast<float>(bits & 0xffff), 1.f};
}

class NoiseWorker : public PixelWorker {
  public:
    Color sample(Pixel pixel, std::uint32_t index) override {
        recorder().setPathIndex(index);
        recorder().setFinalEstimate(noise(pixel, index));
        return noise(pixel, index);
    }
};

template <typename Worker>
PixelLoop loopOf(std::uint32_t width, std::uint32_t height, std::uint32_t samples, unsigned threads) {
    return {width, height, samples, threads, 16, [](SurfaceRecorder*) -> Result<std::unique_ptr<PixelWorker>> { return std::make_unique<Worker>(); }};
}

bool equalBits(const Image& a, const Image& b) { return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0; }

TEST(PixelLoop, AnImageIsTheSameWhateverItsThreadsAndPasses) {
    TestMonitor monitor;
    const auto one = renderImage(loopOf<NoiseWorker>(37, 21, 9, 1), monitor);
    ASSERT_TRUE(one);
    EXPECT_EQ(monitor.furthest, 1.0);
    EXPECT_EQ(monitor.pixelsSeen, 37u * 21u);
    const auto three = renderImage(loopOf<NoiseWorker>(37, 21, 9, 3), monitor);
    const std::vector<Mesh> meshes(1, Mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
    SurfaceRecorder surface(meshes);
    const auto passes = renderImage(loopOf<NoiseWorker>(37, 21, 9, 2), monitor, &surface);
    for (const auto* other : {&three, &passes}) {
        ASSERT_TRUE(*other);
        EXPECT_TRUE(equalBits(one->color, (*other)->color));
        EXPECT_TRUE(equalBits(one->samples, (*other)->samples));
        EXPECT_TRUE(equalBits(one->variance, (*other)->variance));
    }
    EXPECT_EQ(*one->samples.at({36, 20}), 9.f);
    EXPECT_EQ(one->variance.color({5, 5}).b, 0.f);
}

TEST(PixelLoop, AReplayedPixelHasTheBitsOfTheImageAndRecordsEverySample) {
    TestMonitor monitor;
    const PixelLoop loop = loopOf<NoiseWorker>(20, 10, 8, 2);
    const auto image = renderImage(loop, monitor);
    ASSERT_TRUE(image);
    Recording recording;
    Result<Color> pixel = Color();
    {
        const RecordScope scope(recording, Pixel{19, 9});
        pixel = renderPixel(loop, {19, 9}, monitor);
    }
    ASSERT_TRUE(pixel);
    EXPECT_EQ(*pixel, image->color.color({19, 9}));
    const auto paths = recording.finish();
    ASSERT_TRUE(paths);
    ASSERT_EQ(paths->pathCount(), 8u);
}

/// A film of its own: the last sample wins.
class LastWorker final : public NoiseWorker {
  public:
    void beginPixel(Pixel) override { ++begun; }
    Color sample(Pixel pixel, std::uint32_t index) override { return last_ = noise(pixel, index); }
    Color value(Pixel, const PixelSums&) override { return last_; }
    static inline std::atomic<int> begun = 0;

  private:
    Color last_;
};

TEST(PixelLoop, TheFilmHasTheLastWord) {
    TestMonitor monitor;
    const auto image = renderImage(loopOf<LastWorker>(4, 4, 5, 2), monitor);
    ASSERT_TRUE(image);
    EXPECT_EQ(LastWorker::begun, 16);
    EXPECT_EQ(image->color.color({3, 1}), noise({3, 1}, 4));
}

class ThrowingWorker final : public PixelWorker {
  public:
    Color sample(Pixel pixel, std::uint32_t) override {
        if (pixel == Pixel{5, 5}) throw std::runtime_error("no light here");
        return {};
    }
};

TEST(PixelLoop, WhatAWorkerThrowsComesBackToTheCaller) {
    TestMonitor monitor;
    EXPECT_THROW((void)renderImage(loopOf<ThrowingWorker>(64, 64, 1, 3), monitor), std::runtime_error);
    EXPECT_THROW((void)renderPixel(loopOf<ThrowingWorker>(64, 64, 1, 3), {5, 5}, monitor), std::runtime_error);
}

TEST(PixelLoop, SaysWhatIsWrong) {
    TestMonitor monitor;
    EXPECT_EQ(renderImage(loopOf<NoiseWorker>(0, 4, 1, 1), monitor).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(renderImage(loopOf<NoiseWorker>(4, 4, 0, 1), monitor).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(renderPixel(loopOf<NoiseWorker>(4, 4, 1, 1), {4, 0}, monitor).error().code, ErrorCode::pixelOutOfRange);
    PixelLoop refused = loopOf<NoiseWorker>(4, 4, 1, 2);
    refused.makeWorker = [](SurfaceRecorder*) -> Result<std::unique_ptr<PixelWorker>> { return Error{ErrorCode::invalidArgument, "no such integrator"}; };
    EXPECT_EQ(renderImage(refused, monitor).error().message, "no such integrator");
    monitor.stop = true;
    EXPECT_EQ(renderImage(loopOf<NoiseWorker>(4, 4, 1, 2), monitor).error().code, ErrorCode::cancelled);
    EXPECT_EQ(renderPixel(loopOf<NoiseWorker>(4, 4, 1, 2), {0, 0}, monitor).error().code, ErrorCode::cancelled);
}

/// Adds one point of the only triangle per sample.
class SurfaceWorker final : public NoiseWorker {
  public:
    explicit SurfaceWorker(SurfaceRecorder& surface) : cursor_(surface.cursor()), density_(surface.find("density")) {}
    Color sample(Pixel pixel, std::uint32_t index) override {
        density_.add(cursor_.locate(0, 0, Vec2f{0.25f, 0.25f}));
        return NoiseWorker::sample(pixel, index);
    }

  private:
    SurfaceCursor& cursor_;
    SurfaceLayer density_;
};

TEST(PixelLoop, LayersGetEverySampleOnce) {
    TestMonitor monitor;
    const std::vector<Mesh> meshes(1, Mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
    SurfaceRecorder surface(meshes);
    ASSERT_TRUE(surface.addLayer({"density", LayerKind::density, "", ""}));
    PixelLoop loop = loopOf<NoiseWorker>(30, 20, 11, 3);
    loop.makeWorker = [](SurfaceRecorder* s) -> Result<std::unique_ptr<PixelWorker>> { return std::make_unique<SurfaceWorker>(*s); };
    ASSERT_TRUE(renderImage(loop, monitor, &surface));
    (void)surface.finish();
    EXPECT_EQ(surface.counts().points, 30u * 20u * 11u);
}

}  // namespace
}  // namespace emca::adapter
