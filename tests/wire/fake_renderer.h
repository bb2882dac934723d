#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "emca/core/seed_map.h"
#include "emca/recorder/recorder.h"
#include "emca/server/renderer.h"

namespace emca::test {

/// Opens once, for everybody who waits. Tests use it where others would sleep.
class Gate {
  public:
    void open() {
        const std::lock_guard lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }
    /// False if it stayed closed for longer than any machine needs: the test then fails instead of hanging.
    bool wait() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(60), [this] { return open_; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = false;
};

/// A renderer without a scene: every sample of a pixel is a hash of its seed, summed in the same order in renderImage
/// and renderPixel, so that a replay is exact. Hooks make it slow, faulty or stubborn.
class FakeRenderer : public Renderer {
  public:
    RendererInfo description;
    std::int64_t firstSample = 0;          ///< of the recorded indices; the paper's Algorithm 1 counts from 1
    int verticesPerPath = 3;
    bool recordEstimates = true;
    std::function<Color(Pixel, Color)> disturbReplay;          ///< changes what a replay returns
    std::function<void(RequestMonitor&)> duringImage;          ///< called once per image, before its last row
    std::function<void(Pixel, RequestMonitor&)> duringPixel;   ///< called in each replay
    std::vector<Mesh> scene;
    std::atomic<int> calls{0}, mostAtOnce{0};                  ///< calls that ran at the same time

    FakeRenderer() {
        description.renderer = "fake 1.0";
        description.scene = "hash";
        description.width = 16;
        description.height = 12;
        description.samplesPerPixel = 4;
        description.integrator = "hash";
        description.sampler = "none";
        description.seed = 7;
        description.concurrent = true;
        Mesh mesh;
        mesh.name = "triangle";
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        mesh.triangles = {{0, 1, 2}};
        scene.push_back(mesh);
    }

    RendererInfo info() const override { return description; }
    Camera camera() const override {
        Camera camera;
        camera.position = {1, 2, 3};
        camera.verticalFieldOfView = 33;
        return camera;
    }
    std::vector<Mesh> meshes() const override { return scene; }

    static Color sample(Pixel pixel, std::uint32_t index, std::uint64_t seed) {
        const std::uint64_t bits = SeedMap(seed).seed(pixel, index);
        const auto channel = [&](int shift) { return static_cast<float>(bits >> shift & 0xffff) / 65536.f; };
        return {channel(0), channel(16), channel(32)};
    }

    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override {
        const Counted counted(*this);
        RenderedImage image;
        image.color = Image(description.width, description.height);
        image.variance = Image(description.width, description.height);
        for (std::uint32_t y = 0; y < description.height; ++y) {
            if (y + 1 == description.height && duringImage) duringImage(monitor);
            if (monitor.cancelled()) return Error{ErrorCode::cancelled, "The render was cancelled."};
            std::vector<Color> row;
            for (std::uint32_t x = 0; x < description.width; ++x) {
                row.push_back(pixelValue({x, y}, settings));
                image.color.setColor({x, y}, row.back());
                image.variance.setColor({x, y}, Color(static_cast<float>(x), static_cast<float>(y), 0));
            }
            monitor.preview({0, y, description.width, y + 1}, row);
            monitor.progress(static_cast<double>(y + 1) / description.height);
        }
        return image;
    }

    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor& monitor) override {
        const Counted counted(*this);
        if (duringPixel) duringPixel(pixel, monitor);
        if (monitor.cancelled()) return Error{ErrorCode::cancelled, "The replay was cancelled."};
        const Color value = pixelValue(pixel, settings);
        return disturbReplay ? disturbReplay(pixel, value) : value;
    }

  private:
    struct Counted {
        explicit Counted(FakeRenderer& renderer) : fake(renderer) {
            const int now = ++fake.calls;
            int most = fake.mostAtOnce;
            while (now > most && !fake.mostAtOnce.compare_exchange_weak(most, now)) {}
        }
        ~Counted() { --fake.calls; }
        Counted(const Counted&) = delete;
        Counted& operator=(const Counted&) = delete;
        FakeRenderer& fake;
    };

    /// The papers' Algorithm 1 in its smallest form; both renders and replays.
    Color pixelValue(Pixel pixel, const RenderSettings& settings) const {
        PathRecorder& emca = recorder();
        Color sum;
        for (std::uint32_t i = 0; i < settings.samplesPerPixel; ++i) {
            emca.setPathIndex(firstSample + i);
            emca.setPathOrigin(Vec3f{1, 2, 3});
            const Color value = sample(pixel, i, settings.seed);
            for (int depth = 1; depth <= verticesPerPath; ++depth) {
                emca.setDepthIndex(depth);
                emca.setIntersectionPos(Vec3f{static_cast<float>(depth), value.r, value.g});
                emca.setNextEventEstimationPos(Vec3f{0, 5, 0}, depth % 2 == 0);
                emca.addIntersectionData("value", value);
                emca.addIntersectionData("name", std::string("vertex ") + std::to_string(depth));
            }
            if (recordEstimates) emca.setFinalEstimate(value);
            sum += value;
        }
        return sum / static_cast<float>(settings.samplesPerPixel);
    }
};

}  // namespace emca::test
