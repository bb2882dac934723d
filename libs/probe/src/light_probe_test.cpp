#include "emca/probe/light_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace emca::probe {
namespace {

LightProbeRequest anyRequest() {
    LightProbeRequest request;
    request.position = {1.5f, -2, 1e-3f};
    request.normal = normalize(Vec3f{1, 1, 0.5f});
    request.frame = SphereFrame::around({0, 1, 0}, {1, 0, 1});
    request.width = 12;
    request.height = 7;
    request.samplesPerPixel = 33;
    request.maximumDepth = -1;
    request.seed = 0x123456789abcdef0ull;
    request.integrator = "direct";
    return request;
}

LightProbe anyProbe() {
    LightProbe probe;
    probe.map = SphereMap(SphereFrame::around({0, 1, 0}, {1, 0, 1}), 5, 3);
    probe.samplesPerPixel = 9;
    probe.seconds = 0.25f;
    probe.image = Image(5, 3, probeChannels());
    for (std::size_t i = 0; i < probe.image.size(); ++i) probe.image.data()[i] = static_cast<float>(i) * 0.37f - 3;
    return probe;
}

TEST(LightProbeRequest, ComesBackAsItWas) {
    const auto decoded = decodeRequest(encode(anyRequest()));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(*decoded, anyRequest());
}

TEST(LightProbeRequest, HasTheBytesOfItsTable) {
    // docs/explorer/light-probe.md
    const auto bytes = encode(anyRequest());
    ASSERT_EQ(bytes.size(), 84u + 6u);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "EMLP");
    EXPECT_EQ(bytes[4], std::byte{1});
    const auto at = [&](std::size_t offset) { return static_cast<unsigned>(bytes[offset]); };
    EXPECT_EQ(at(56), 12u);   // width
    EXPECT_EQ(at(60), 7u);    // height
    EXPECT_EQ(at(64), 33u);   // samples
    EXPECT_EQ(at(68), 0xffu); // depth -1
    EXPECT_EQ(at(72), 0xf0u); // seed, lowest byte first
    EXPECT_EQ(at(80), 6u);    // length of "direct"
}

TEST(LightProbeRequest, EveryTruncationIsRefused) {
    const auto bytes = encode(anyRequest());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto decoded = decodeRequest(std::span(bytes).first(size));
        ASSERT_FALSE(decoded) << size;
        EXPECT_EQ(decoded.error().code, ErrorCode::protocolViolation) << size;
    }
    auto longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(decodeRequest(longer));
    auto newer = bytes;
    newer[4] = std::byte{2};
    ASSERT_FALSE(decodeRequest(newer));
    EXPECT_EQ(decodeRequest(newer).error().code, ErrorCode::versionMismatch);
    EXPECT_TRUE(decodeRequest(bytes));
}

TEST(LightProbeRequest, EveryRuleIsCheckedWithASentence) {
    const auto refused = [](auto change, ErrorCode code) {
        LightProbeRequest request = anyRequest();
        change(request);
        const auto decoded = decodeRequest(encode(request));
        ASSERT_FALSE(decoded);
        EXPECT_EQ(decoded.error().code, code) << decoded.error().message;
        EXPECT_TRUE(decoded.error().message.ends_with(".")) << decoded.error().message;
    };
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    refused([](auto& r) { r.position.y = kNaN; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.normal = {1, 1, 0}; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.normal.x = kNaN; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.frame.forward = r.frame.pole; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.frame.pole = {}; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.width = 0; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.height = 0; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.width = kMaximumProbeWidth + 1; }, ErrorCode::tooLarge);
    refused([](auto& r) { r.height = kMaximumProbeHeight + 1; }, ErrorCode::tooLarge);
    refused([](auto& r) { r.samplesPerPixel = 0; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.samplesPerPixel = kMaximumProbeSamples + 1; }, ErrorCode::tooLarge);
    refused([](auto& r) { r.width = 4096, r.height = 2048, r.samplesPerPixel = 1024; }, ErrorCode::tooLarge);
    refused([](auto& r) { r.maximumDepth = -2; }, ErrorCode::invalidArgument);
    refused([](auto& r) { r.integrator.assign(65, 'x'); }, ErrorCode::tooLarge);

    LightProbeRequest largest = anyRequest();
    largest.normal = {};
    largest.width = 4096, largest.height = 2048, largest.samplesPerPixel = 256;
    EXPECT_TRUE(validate(largest));
}

TEST(LightProbe, ComesBackAsItWas) {
    const LightProbe probe = anyProbe();
    const auto decoded = decodeProbe(encode(probe));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->samplesPerPixel, 9u);
    EXPECT_EQ(decoded->seconds, 0.25f);
    EXPECT_EQ(decoded->map.frame(), probe.map.frame());
    ASSERT_EQ(decoded->image.size(), probe.image.size());
    EXPECT_EQ(decoded->image.channels(), probeChannels());
    for (std::size_t i = 0; i < probe.image.size(); ++i) EXPECT_EQ(decoded->image.data()[i], probe.image.data()[i]);
}

TEST(LightProbe, EveryTruncationAndWrongSizeIsRefused) {
    const auto bytes = encode(anyProbe());
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(decodeProbe(std::span(bytes).first(size))) << size;
    for (const std::size_t offset : {0u, 4u, 8u, 12u}) {  // mark, version, width, height
        auto wrong = bytes;
        wrong[offset] = std::byte{0x7f};
        EXPECT_FALSE(decodeProbe(wrong)) << offset;
    }
    auto huge = bytes;
    huge[11] = std::byte{0x7f};
    ASSERT_FALSE(decodeProbe(huge));
    EXPECT_EQ(decodeProbe(huge).error().code, ErrorCode::tooLarge);
    EXPECT_FALSE(decodeProbe(encode(anyRequest())));
    EXPECT_TRUE(decodeProbe(bytes));
}

}  // namespace
}  // namespace emca::probe
