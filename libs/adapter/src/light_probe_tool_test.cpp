#include "emca/adapter/light_probe_tool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>

#include "emca/core/seed_map.h"

namespace emca::adapter {
namespace {

class QuietMonitor final : public RequestMonitor {
  public:
    bool cancelled() const override { return stop; }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
    std::atomic<bool> stop = false;
};

/// Red: the cosine to z where positive; green: 1; blue: random. Rays of each side start on it.
class TestWorker final : public ProbeWorker {
  public:
    explicit TestWorker(std::uint64_t seed) : seed_(seed) {}
    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override {
        EXPECT_NEAR(length(direction), 1.f, 1e-5f);
        EXPECT_EQ(origin.z, direction.z < 0 ? 0.75f : 1.25f);
        return {std::max(0.f, direction.z), 1.f, static_cast<float>(SeedMap(seed_).seed(pixel, sample) >> 40) * 0x1p-24f};
    }

  private:
    std::uint64_t seed_;
};

LightProbeTool toolWith(unsigned threads) {
    return LightProbeTool([](const probe::LightProbeRequest& request) -> Result<std::unique_ptr<ProbeWorker>> {
        if (!request.integrator.empty()) return Error{ErrorCode::invalidArgument, "There is one integrator."};
        return std::make_unique<TestWorker>(request.seed);
    }, 0.25f, threads);
}

probe::LightProbeRequest smallRequest() {
    probe::LightProbeRequest request;
    request.position = {0, 0, 1};
    request.normal = {0, 0, 1};
    request.width = 32;
    request.height = 16;
    request.samplesPerPixel = 8;
    return request;
}

TEST(AdapterLightProbe, TheCosineAddsUpToPi) {
    QuietMonitor monitor;
    LightProbeTool tool = toolWith(2);
    EXPECT_EQ(tool.name(), "light probe");
    auto request = smallRequest();
    request.samplesPerPixel = 1024;
    const auto reply = tool.answer(probe::encode(request), monitor);
    ASSERT_TRUE(reply) << reply.error().message;
    const auto probe = probe::decodeProbe(*reply);
    ASSERT_TRUE(probe);
    double irradiance = 0, sphere = 0;
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const float* at = probe->image.at({x, y});
            irradiance += double(at[0]) * probe->map.solidAngle(y);
            sphere += double(at[1]) * probe->map.solidAngle(y);
            EXPECT_GE(at[3], 0.f);
        }
    EXPECT_NEAR(irradiance, std::numbers::pi, 3e-4);
    EXPECT_NEAR(sphere, 4 * std::numbers::pi, 1e-5);
}

TEST(AdapterLightProbe, TheSameRequestGivesTheSameBitsWhateverTheThreads) {
    QuietMonitor monitor;
    const auto one = toolWith(1).answer(probe::encode(smallRequest()), monitor), four = toolWith(4).answer(probe::encode(smallRequest()), monitor);
    ASSERT_TRUE(one && four);
    const auto a = probe::decodeProbe(*one), b = probe::decodeProbe(*four);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(std::memcmp(a->image.data(), b->image.data(), a->image.size() * sizeof(float)), 0);
    auto other = smallRequest();
    other.seed = 1;
    const auto c = probe::decodeProbe(*toolWith(1).answer(probe::encode(other), monitor));
    ASSERT_TRUE(c);
    EXPECT_NE(std::memcmp(a->image.data(), c->image.data(), a->image.size() * sizeof(float)), 0);
}

TEST(AdapterLightProbe, RefusalsTravel) {
    QuietMonitor monitor;
    auto request = smallRequest();
    request.integrator = "bdpt";
    EXPECT_EQ(toolWith(2).answer(probe::encode(request), monitor).error().message, "There is one integrator.");
    EXPECT_EQ(toolWith(2).answer({}, monitor).error().code, ErrorCode::protocolViolation);
    monitor.stop = true;
    EXPECT_EQ(toolWith(2).answer(probe::encode(smallRequest()), monitor).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace emca::adapter
