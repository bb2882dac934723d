#include "server_half.h"

#include <gtest/gtest.h>

#include <cmath>

#include "emca/probe/light_probe.h"
#include "messages.h"

namespace mixture {
namespace {

using emca::Error;
using emca::ErrorCode;

class Monitor final : public emca::RequestMonitor {
  public:
    bool cancelled() const override { return stop; }
    void progress(double) override {}
    void preview(emca::PixelRect, const std::vector<emca::Color>&) override {}
    bool stop = false;
};

/// A server whose light probe sees a mixture, scaled.
class Host final : public emca::ToolHost {
  public:
    emca::Result<std::vector<std::byte>> ask(const std::string& tool, std::span<const std::byte> bytes, emca::RequestMonitor&) override {
        EXPECT_EQ(tool, emca::probe::kLightProbeTool);
        const auto request = emca::probe::decodeRequest(bytes);
        if (!request) return request.error();
        emca::probe::LightProbe probe;
        probe.map = emca::probe::SphereMap(request->frame, request->width, request->height);
        probe.samplesPerPixel = request->samplesPerPixel;
        probe.image = emca::Image(request->width, request->height, emca::probe::probeChannels());
        for (std::uint32_t y = 0; y < request->height; ++y)
            for (std::uint32_t x = 0; x < request->width; ++x) {
                const emca::Vec3f d = probe.map.direction({x + 0.5, y + 0.5});
                probe.image.setColor({x, y}, emca::Color(static_cast<float>(brightness * density(truth, {double(d.x), double(d.y), double(d.z)}))));
            }
        return emca::probe::encode(probe);
    }
    std::vector<Lobe> truth{{normalize(Vec3d{1, 1, 1}), 30, 0.75}, {normalize(Vec3d{-1, 0.5, -1}), 4, 0.25}};
    double brightness = 7;
};

struct ServerHalf : ::testing::Test {
    ServerHalf() { tool.setHost(host); }
    Host host;
    Monitor monitor;
    MixtureTool tool;
};

TEST_F(ServerHalf, FitsTheRadianceThatTheLightProbeSees) {
    Request request;
    request.components = 2;
    emca::probe::LightProbeRequest probe;
    probe.width = 128, probe.height = 64;
    request.lightProbe = emca::probe::encode(probe);
    const auto answer = tool.answer(encode(request), monitor);
    ASSERT_TRUE(answer) << answer.error().message;
    const auto reply = decodeReply(*answer);
    ASSERT_TRUE(reply) << reply.error().message;
    ASSERT_EQ(reply->fit.lobes.size(), 2u);
    EXPECT_EQ(reply->directions, 128u * 64);
    EXPECT_TRUE(emca::probe::decodeProbe(reply->lightProbe));
    for (std::size_t k = 0; k < 2; ++k) {
        // No noise: only pixels of 2.8 degrees are between the truth and the fit.
        EXPECT_NEAR(reply->fit.lobes[k].weight, host.truth[k].weight, 2e-3);
        EXPECT_NEAR(reply->fit.lobes[k].kappa / host.truth[k].kappa, 1, 1e-2);
        EXPECT_GT(dot(reply->fit.lobes[k].mean, host.truth[k].mean), std::cos(0.01));
    }
}

TEST_F(ServerHalf, FitsGivenDirections) {
    Request request;
    request.components = 1;
    for (int i = 0; i < 200; ++i) request.directions.push_back({sample({{0, 1, 0}, 50, 1}, {(i + 0.5) / 200, i * 0.618 - std::floor(i * 0.618)}), 1});
    const auto answer = tool.answer(encode(request), monitor);
    ASSERT_TRUE(answer);
    const auto reply = decodeReply(*answer);
    ASSERT_TRUE(reply);
    ASSERT_EQ(reply->fit.lobes.size(), 1u);
    EXPECT_TRUE(reply->lightProbe.empty());
    EXPECT_GT(reply->fit.lobes[0].mean.y, 0.999);
    EXPECT_NEAR(reply->fit.lobes[0].kappa, 50, 12);   // the prior of one direction broadens it
}

TEST_F(ServerHalf, RefusesWithASentence) {
    const auto code = [&](const std::vector<std::byte>& bytes) {
        const auto answer = tool.answer(bytes, monitor);
        EXPECT_FALSE(answer);
        return answer ? ErrorCode::internal : answer.error().code;
    };
    Request good;
    good.directions = {{{0, 0, 1}, 1}};
    const auto bytes = encode(good);
    ASSERT_TRUE(tool.answer(bytes, monitor));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_EQ(code({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}), ErrorCode::protocolViolation) << size;
    }
    Request many = good;
    many.components = kMaximumComponents + 1;
    EXPECT_EQ(code(encode(many)), ErrorCode::invalidArgument);
    EXPECT_EQ(code(encode(Request())), ErrorCode::invalidArgument);
    Request dark = good;
    dark.directions[0].weight = 0;
    EXPECT_EQ(code(encode(dark)), ErrorCode::invalidArgument);
    monitor.stop = true;
    EXPECT_EQ(code(bytes), ErrorCode::cancelled);
}

TEST(Messages, EveryTruncationOfAReplyIsRefused) {
    Reply reply;
    reply.fit.lobes = {{{0, 0, 1}, 3, 0.5}, {{0, 1, 0}, 1e4, 0.5}};
    reply.fit.logLikelihood = -2.5;
    reply.fit.iterations = 17;
    reply.directions = 99;
    reply.lightProbe.resize(5);
    const auto bytes = encode(reply);
    const auto back = decodeReply(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->fit.lobes, reply.fit.lobes);
    EXPECT_EQ(back->fit.iterations, 17);
    EXPECT_EQ(back->lightProbe.size(), 5u);
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(decodeReply(std::span(bytes).first(size))) << size;
    reply.fit.lobes[0].mean.z = 2;
    EXPECT_FALSE(decodeReply(encode(reply)));
}

}  // namespace
}  // namespace mixture
