#include "emca/adapter/light_probe_tool.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>

#include "emca/core/pixel_sums.h"
#include "emca/core/seed_map.h"
#include "threads.h"

namespace emca::adapter {

namespace {

constexpr std::uint32_t kPixelsPerTask = 64;

/// Points of a pixel, evenly spread: the sequence R2, shifted by a random vector of the pixel.
/// Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
Vec2f pixelPoint(std::uint64_t pixelSeed, std::uint32_t sample) {
    constexpr double kPlastic = 1.32471795724474602596;
    const auto shifted = [&](std::uint64_t bits, double step) {
        const double x = double(bits >> 32) * 0x1p-32 + step * sample;
        return std::min(static_cast<float>(x - std::floor(x)), 0x1.fffffep-1f);
    };
    return {shifted(pixelSeed, 1 / kPlastic), shifted(pixelSeed << 32, 1 / (kPlastic * kPlastic))};
}

/// One probe: what its threads share.
class ProbeRender {
  public:
    ProbeRender(const probe::LightProbeRequest& request, float surfaceOffset, RequestMonitor& monitor)
        : request_(request), surfaceOffset_(surfaceOffset), monitor_(monitor), pixels_(request.width * request.height) {
        probe_.map = probe::SphereMap(request.frame, request.width, request.height);
        probe_.samplesPerPixel = request.samplesPerPixel;
        probe_.image = Image(request.width, request.height, probe::probeChannels());
    }

    Result<probe::LightProbe> run(const LightProbeTool::MakeWorker& makeWorker, unsigned threads) {
        const auto begin = std::chrono::steady_clock::now();
        const auto done = onThreads(threads, [&](const std::atomic<bool>& stop) -> Result<void> {
            auto worker = makeWorker(request_);
            if (!worker) return worker.error();
            while (!stop) {
                const std::uint32_t first = next_.fetch_add(kPixelsPerTask);
                if (first >= pixels_) break;
                for (std::uint32_t i = first; i < std::min(first + kPixelsPerTask, pixels_); ++i) {
                    if (monitor_.cancelled()) return Error{ErrorCode::cancelled, "The light probe was cancelled before it was complete."};
                    renderPixel({i % request_.width, i / request_.width}, **worker);
                }
                monitor_.progress(double(done_ += kPixelsPerTask) / (double(pixels_) + kPixelsPerTask));
            }
            return {};
        });
        if (!done) return done.error();
        probe_.seconds = std::chrono::duration<float>(std::chrono::steady_clock::now() - begin).count();
        return std::move(probe_);
    }

  private:
    void renderPixel(Pixel pixel, ProbeWorker& worker) {
        const std::uint64_t seed = SeedMap(request_.seed).seed(pixel);
        PixelSums sums, brightness;
        for (std::uint32_t sample = 0; sample < request_.samplesPerPixel; ++sample) {
            const Vec3f direction = normalize(probe_.map.sample(pixel, pixelPoint(seed, sample)));
            const float side = dot(request_.normal, direction) < 0 ? -1.f : 1.f;
            const Color radiance = worker.radiance(request_.position + request_.normal * (side * surfaceOffset_), direction, pixel, sample);
            sums.add(radiance);
            brightness.add(Color(luminance(radiance)));
        }
        const Color mean = sums.mean();
        float* out = probe_.image.at(pixel);
        out[0] = mean.r, out[1] = mean.g, out[2] = mean.b;
        out[3] = std::sqrt(brightness.variance().r / static_cast<float>(request_.samplesPerPixel));
    }

    const probe::LightProbeRequest& request_;
    float surfaceOffset_;
    RequestMonitor& monitor_;
    std::uint32_t pixels_;
    std::atomic<std::uint32_t> next_ = 0, done_ = 0;
    probe::LightProbe probe_;
};

}  // namespace

LightProbeTool::LightProbeTool(MakeWorker makeWorker, float surfaceOffset, unsigned threads)
    : makeWorker_(std::move(makeWorker)), surfaceOffset_(surfaceOffset), threads_(threads) {}

Result<std::vector<std::byte>> LightProbeTool::answer(std::span<const std::byte> request, RequestMonitor& monitor) {
    const auto asked = probe::decodeRequest(request);
    if (!asked) return asked.error();
    const auto probe = ProbeRender(*asked, surfaceOffset_, monitor).run(makeWorker_, threads_);
    if (!probe) return probe.error();
    return probe::encode(*probe);
}

}  // namespace emca::adapter
