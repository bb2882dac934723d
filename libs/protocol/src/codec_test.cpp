#include "emca/protocol/codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sample_messages.h"

namespace emca::protocol {
namespace {

template <typename T>
testing::AssertionResult sameBits(const SharedArray<T>& a, const SharedArray<T>& b) {
    if (a.size() != b.size()) return testing::AssertionFailure() << a.size() << " against " << b.size() << " entries";
    if (a.size() > 0 && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) != 0) return testing::AssertionFailure() << "other bits";
    return testing::AssertionSuccess();
}

void expectSameBits(const PathColumns& a, const PathColumns& b) {
    EXPECT_TRUE(sameBits(a.pixels, b.pixels));
    EXPECT_TRUE(sameBits(a.samples, b.samples));
    EXPECT_TRUE(sameBits(a.parts, b.parts));
    EXPECT_TRUE(sameBits(a.pathFlags, b.pathFlags));
    EXPECT_TRUE(sameBits(a.origins, b.origins));
    EXPECT_TRUE(sameBits(a.estimates, b.estimates));
    EXPECT_TRUE(sameBits(a.firstVertex, b.firstVertex));
    EXPECT_TRUE(sameBits(a.depths, b.depths));
    EXPECT_TRUE(sameBits(a.vertexFlags, b.vertexFlags));
    EXPECT_TRUE(sameBits(a.positions, b.positions));
    EXPECT_TRUE(sameBits(a.vertexEstimates, b.vertexEstimates));
    EXPECT_TRUE(sameBits(a.emissions, b.emissions));
    EXPECT_TRUE(sameBits(a.meshes, b.meshes));
    EXPECT_TRUE(sameBits(a.faces, b.faces));
    EXPECT_TRUE(sameBits(a.events, b.events));
    EXPECT_TRUE(sameBits(a.lobes, b.lobes));
    EXPECT_TRUE(sameBits(a.labels, b.labels));
    EXPECT_TRUE(sameBits(a.nextEventOwners, b.nextEventOwners));
    EXPECT_TRUE(sameBits(a.nextEvents, b.nextEvents));
    EXPECT_TRUE(sameBits(a.contributionOwners, b.contributionOwners));
    EXPECT_TRUE(sameBits(a.contributions, b.contributions));
    EXPECT_TRUE(sameBits(a.splatOwners, b.splatOwners));
    EXPECT_TRUE(sameBits(a.splats, b.splats));
    EXPECT_EQ(a.strings, b.strings);
    ASSERT_EQ(a.columns.size(), b.columns.size());
    for (std::size_t i = 0; i < a.columns.size(); ++i) {
        SCOPED_TRACE(a.columns[i].name);
        EXPECT_EQ(a.columns[i].name, b.columns[i].name);
        EXPECT_EQ(a.columns[i].scope, b.columns[i].scope);
        EXPECT_EQ(a.columns[i].type, b.columns[i].type);
        EXPECT_EQ(a.columns[i].count, b.columns[i].count);
        EXPECT_TRUE(sameBits(a.columns[i].owners, b.columns[i].owners));
        EXPECT_TRUE(sameBits(a.columns[i].bytes, b.columns[i].bytes));
        EXPECT_TRUE(sameBits(a.columns[i].spectrumOffsets, b.columns[i].spectrumOffsets));
        EXPECT_TRUE(sameBits(a.columns[i].locations, b.columns[i].locations));
    }
}

/// As it arrives: in memory that is ours.
Frame received(const Frame& sent) {
    auto memory = allocatePayload(sent.size());
    std::memcpy(memory->get(), sent.data(), sent.size());
    const std::byte* data = memory->get();
    return Frame(std::move(memory).value(), data, sent.size());
}

Message throughTheWire(const Message& message) {
    const auto frame = encode(message);
    EXPECT_TRUE(frame.ok());
    auto decoded = decode(received(*frame));
    EXPECT_TRUE(decoded.ok()) << decoded.error().message;
    return decoded ? std::move(decoded).value() : Message();
}

TEST(Codec, PathSetsOfEveryColumnTypeArriveBitByBit) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        const auto sent = test::traceResult(seed, static_cast<Index>(seed % 40));
        ASSERT_EQ(sent.paths.pathCount(), seed % 40) << "the random paths are valid";
        const Message back = throughTheWire({seed, sent});
        ASSERT_TRUE(std::holds_alternative<TraceResult>(back.body));
        expectSameBits(sent.paths.columns(), std::get<TraceResult>(back.body).paths.columns());
    }
}

TEST(Codec, NanPayloadsSurvive) {
    PathColumns c;
    c.pixels = std::vector<Pixel>{{0, 0}};
    c.samples = std::vector<std::int64_t>{0};
    c.parts = std::vector<std::int32_t>{0};
    c.pathFlags = std::vector<std::uint8_t>{PathFlag::hasEstimate};
    const std::uint32_t bits[3] = {0x7fc12345u, 0xffc00001u, 0x7f800000u};
    std::vector<Color> estimates(1);
    std::memcpy(estimates.data(), bits, sizeof bits);
    c.estimates = std::move(estimates);
    c.firstVertex = std::vector<Index>{0, 0};
    TraceResult result;
    result.paths = *PathSet::make(std::move(c));
    const Message back = throughTheWire({1, result});
    EXPECT_EQ(std::memcmp(std::get<TraceResult>(back.body).paths.columns().estimates.data(), bits, sizeof bits), 0);
}

TEST(Codec, ColumnsLookIntoTheFrameAndKeepItAlive) {
    const auto frame = encode({1, test::traceResult(3, 20)});
    Frame payload = received(*frame);
    const std::byte *begin = payload.data(), *end = begin + payload.size();
    auto decoded = decode(payload);
    ASSERT_TRUE(decoded.ok());
    payload = {};
    const PathSet paths = std::get<TraceResult>(decoded->body).paths;
    decoded = Error{};
    const auto inside = [&](const void* p) { return p >= begin && p < end; };
    EXPECT_TRUE(inside(paths.columns().positions.data()));
    EXPECT_TRUE(inside(paths.columns().columns[0].bytes.data()));
    EXPECT_EQ(paths.columns().samples[0], test::traceResult(3, 20).paths.columns().samples[0]) << "read under ASan after all else is gone";
}

TEST(Codec, SettingsAndCommentsOfATraceArrive) {
    const auto sent = test::traceResult(4, 3);
    const Message back = throughTheWire({42, sent});
    EXPECT_EQ(back.request, 42u);
    const auto& got = std::get<TraceResult>(back.body);
    EXPECT_EQ(got.pixels, sent.pixels);
    ASSERT_EQ(got.replays.size(), 2u);
    EXPECT_EQ(got.replays[0].verdict, Verdict::close);
    EXPECT_EQ(got.replays[0].sums, SumCheck::matches);
    EXPECT_EQ(got.replays[0].rendered, Color(1, 2, 3));
    EXPECT_EQ(got.replays[0].replayed, Color(4, 5, 6));
    EXPECT_EQ(got.settings, sent.settings);
    EXPECT_EQ(got.renderId, 9u);
    EXPECT_EQ(got.stats, sent.stats);
    EXPECT_EQ(got.renderSeconds, 0.25);
}

TEST(Codec, SurfaceLayersArrive) {
    const Layer hits{{"hits", LayerKind::density, "1/m^2", "Adds 1 at each hit."}, (1ull << 32) + 5, 1e300};
    const Layer radiance{{"radiance", LayerKind::meanColor, "W/(sr m^2)", ""}, 3, -0.25};
    const SurfaceCounts counts{(1ull << 32) + 7, 2, 3, 4, 5, 1ull << 33};

    Info info;
    info.layers = {hits, radiance};
    info.surfaceRender = 1ull << 50;
    info.collected = {radiance};
    info.maximumSurfaceBudget = 1ull << 32;
    const auto gotInfo = std::get<Info>(throughTheWire({1, info}).body);
    EXPECT_EQ(gotInfo.layers, info.layers);
    EXPECT_EQ(gotInfo.surfaceRender, info.surfaceRender);
    EXPECT_EQ(gotInfo.collected, info.collected);
    EXPECT_EQ(gotInfo.maximumSurfaceBudget, info.maximumSurfaceBudget);

    const auto request = std::get<RenderRequest>(throughTheWire({1, RenderRequest{{}, true, 9, {"a", "b"}, 1ull << 40}}).body);
    EXPECT_EQ(request.layers, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(request.surfaceBudget, 1ull << 40);
    EXPECT_EQ(request.maximumChunkBytes, 9u);

    const auto rendered = std::get<RenderResult>(throughTheWire({1, RenderResult{8, {}, 1, 2, 1, {hits}, counts, 1ull << 27}}).body);
    EXPECT_EQ(rendered.layers, std::vector<Layer>{hits});
    EXPECT_EQ(rendered.surfaceCounts, counts);
    EXPECT_EQ(rendered.surfaceFaces, 1ull << 27);

    const auto asked = std::get<SurfaceRequest>(throughTheWire({1, SurfaceRequest{{"a"}, {}, 5, 77, 4096}}).body);
    EXPECT_EQ(asked.layers, std::vector<std::string>{"a"});
    EXPECT_EQ(asked.renderId, 77u);
    EXPECT_EQ(asked.maximumChunkBytes, 4096u);

    const auto result = std::get<SurfaceResult>(throughTheWire({1, SurfaceResult{8, {hits, radiance}, counts, 2, 1ull << 27, 9}}).body);
    EXPECT_EQ(result.renderId, 8u);
    EXPECT_EQ(result.layers, (std::vector<Layer>{hits, radiance}));
    EXPECT_EQ(result.counts, counts);
    EXPECT_EQ(result.meshCount, 2u);
    EXPECT_EQ(result.faceCount, 1ull << 27);
    EXPECT_EQ(result.topologyBytes, 9u);

    const std::vector<std::uint8_t> bits{1, 2, 255};
    const std::vector<float> values{1.5f, -0.f, 3};
    const auto chunk = std::get<SurfaceChunk>(
        throughTheWire({1, SurfaceChunk{{{1, 20, 26, 4, 1, bits}}, {{2, 1ull << 33, values}}, true}}).body);
    ASSERT_EQ(chunk.meshes.size(), 1u);
    EXPECT_EQ(chunk.meshes[0].mesh, 1u);
    EXPECT_EQ(chunk.meshes[0].triangleCount, 20u);
    EXPECT_EQ(chunk.meshes[0].faceCount, 26u);
    EXPECT_EQ(chunk.meshes[0].byteCount, 4u);
    EXPECT_EQ(chunk.meshes[0].firstByte, 1u);
    EXPECT_TRUE(sameBits(chunk.meshes[0].bits, SharedArray<std::uint8_t>(bits)));
    ASSERT_EQ(chunk.arrays.size(), 1u);
    EXPECT_EQ(chunk.arrays[0].array, 2u);
    EXPECT_EQ(chunk.arrays[0].first, 1ull << 33);
    EXPECT_TRUE(sameBits(chunk.arrays[0].values, SharedArray<float>(values)));
    EXPECT_TRUE(chunk.last);
}

TEST(Codec, LayersOfALaterKindAreLeftOutOrFailWhatCountsThem) {
    Layer later{{"later", static_cast<LayerKind>(9), "", ""}, 0, 0};
    Info info;
    info.layers = {later, {{"mean", LayerKind::mean, "", ""}, 0, 0}};
    const auto got = std::get<Info>(throughTheWire({1, info}).body);
    ASSERT_EQ(got.layers.size(), 1u);
    EXPECT_EQ(got.layers[0].description.name, "mean");
    SurfaceResult result;
    result.layers = {later};
    const auto refused = decode(*encode({1, result}));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::protocolViolation);
}

/// Encoding is a function of the content, so equal bytes after a second round mean that nothing was lost.
TEST(Codec, EveryMessageArrivesWithAllItsFields) {
    auto messages = test::everyMessage();
    for (Message& message : messages) {
        const auto number = std::exchange(message.request, 0);
        EXPECT_TRUE(decode(*encode(message)).ok()) << "kind " << message.body.index() << " as part of a handshake";
        message.request = number;
    }
    ASSERT_EQ(messages.size(), std::variant_size_v<Body> - 1) << "one of every kind, but Unknown";
    for (std::size_t i = 0; i < messages.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_EQ(messages[i].body.index(), i);
        const auto first = encode(messages[i]);
        ASSERT_TRUE(first.ok());
        const Message back = throughTheWire(messages[i]);
        EXPECT_EQ(back.body.index(), i);
        EXPECT_EQ(back.request, messages[i].request);
        const auto second = encode(back);
        ASSERT_TRUE(second.ok());
        EXPECT_TRUE(sameBits(*first, *second));
    }
}

/// Each column alone with the few that must be there: the alignment of one may not hang on that of another.
TEST(Codec, TracesWithFewColumnsArriveToo) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        test::Source source(seed);
        const PathColumns all = test::randomColumns(source, 1 + seed % 9);
        PathColumns few;
        few.pixels = all.pixels;
        few.samples = all.samples;
        few.parts = all.parts;
        few.firstVertex = all.firstVertex;
        few.depths = all.depths;
        few.pathFlags = std::vector<std::uint8_t>(all.pixels.size());
        few.vertexFlags = std::vector<std::uint8_t>(all.depths.size());
        switch (seed % 8) {
            case 0: few.estimates = all.estimates; break;
            case 1: few.positions = all.positions; break;
            case 2: few.nextEventOwners = all.nextEventOwners, few.nextEvents = all.nextEvents; break;
            case 3: few.contributionOwners = all.contributionOwners, few.contributions = all.contributions, few.strings = all.strings; break;
            case 4: few.splatOwners = all.splatOwners, few.splats = all.splats; break;
            case 5: few.events = all.events; break;
            case 6: few.strings = all.strings, few.columns = {all.columns[seed / 8 % all.columns.size()]}; break;
            default: break;
        }
        auto paths = PathSet::make(few);
        ASSERT_TRUE(paths.ok()) << paths.error().message;
        for (const std::uint64_t request : {0, 1}) {
            TraceResult result;
            result.paths = *paths;
            result.settings.integrator = std::string(seed % 5, 'x');
            result.settings.seed = seed;
            const Message back = throughTheWire({request, result});
            ASSERT_TRUE(std::holds_alternative<TraceResult>(back.body));
            expectSameBits(few, std::get<TraceResult>(back.body).paths.columns());
        }
    }
}

TEST(Codec, FieldsLandWhereTheyBelong) {
    const auto messages = test::everyMessage();
    const auto back = [&]<typename T>(T*) { 
        for (const Message& message : messages) {
            if (std::holds_alternative<T>(message.body)) return std::get<T>(throughTheWire(message).body);
        }
        return T{};
    };
    const auto hello = back(static_cast<Hello*>(nullptr));
    EXPECT_EQ(hello.software, "client 1");
    EXPECT_EQ(hello.minimumVersion, 1);
    EXPECT_EQ(hello.maximumVersion, 3);
    EXPECT_EQ(hello.token, "token");
    const auto failure = back(static_cast<Failure*>(nullptr));
    EXPECT_EQ(failure.error.code, ErrorCode::pixelOutOfRange);
    EXPECT_EQ(failure.error.message, "Pixel (9, 9) is outside.");
    const auto camera = back(static_cast<Camera*>(nullptr));
    EXPECT_EQ(camera.kind, CameraKind::spherical);
    EXPECT_EQ(camera.position, (Vec3f{1, 2, 3}));
    EXPECT_EQ(camera.apertureRadius, 0.125f);
    EXPECT_FALSE(camera.rightHanded);
    const auto info = back(static_cast<Info*>(nullptr));
    EXPECT_EQ(info.width, 640u);
    EXPECT_EQ(info.height, 480u);
    EXPECT_EQ(info.triangles, 1u << 20);
    EXPECT_EQ(info.meshes, 12u);
    EXPECT_EQ(info.tools, std::vector<std::string>{"tool"});
    const auto trace = back(static_cast<TraceRequest*>(nullptr));
    EXPECT_EQ(trace.pixels, (std::vector<Pixel>{{1, 2}, {3, 4}}));
    EXPECT_EQ(trace.rect, (PixelRect{5, 6, 7, 8}));
    EXPECT_EQ(trace.against, Against::givenColors);
    EXPECT_EQ(trace.columns, (std::vector<std::string>{"position", "pdf"}));
    EXPECT_EQ(trace.query, "depth > 2");
    EXPECT_TRUE(trace.locations);
    const auto rows = back(static_cast<ImageRows*>(nullptr));
    EXPECT_EQ(rows.samples[1], 5.f);
    EXPECT_TRUE(rows.last);
}

TEST(Codec, AFrameThatIsNotAlignedIsCopiedAndRead) {
    const auto frame = encode({1, test::traceResult(5, 10)});
    ASSERT_TRUE(frame.ok());
    for (std::size_t shift = 1; shift < 8; ++shift) {
        std::vector<std::byte> bytes(frame->size() + shift);
        std::memcpy(bytes.data() + shift, frame->data(), frame->size());
        const SharedArray<std::byte> all(std::move(bytes));
        EXPECT_TRUE(decode(Frame(all.owner(), all.data() + shift, frame->size())).ok()) << shift;
    }
}

TEST(Codec, WhatFitsIntoNoMessageIsRefused) {
    // 1 GiB of colours that are never written: the address space is enough for this test.
    constexpr std::size_t kCount = (kMaximumReplyBytes / sizeof(Color)) + 1;
    const auto memory = std::make_shared<int>(0);
    PreviewTile tile{{0, 0, 1, 1}, SharedArray<Color>(memory, reinterpret_cast<const Color*>(memory.get()), kCount)};
    const auto frame = encode({1, tile});
    ASSERT_FALSE(frame.ok());
    EXPECT_EQ(frame.error().code, ErrorCode::tooLarge);
    EXPECT_FALSE(encode({1, Unknown{200}}).ok());
}

TEST(Frames, HeadersAreLittleEndianLengths) {
    const auto size = [](std::array<std::byte, 4> bytes, std::size_t limit) { return payloadBytes(bytes, limit); };
    EXPECT_EQ(*size({std::byte{0x10}, std::byte{0x32}, std::byte{0x01}, std::byte{0}}, 1u << 20), 0x13210u);
    EXPECT_EQ(size({std::byte{0x07}}, 100).error().code, ErrorCode::protocolViolation);
    EXPECT_EQ(*size({std::byte{100}}, 100), 100u);
    EXPECT_EQ(size({std::byte{101}}, 100).error().code, ErrorCode::tooLarge);
    EXPECT_EQ(size({std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0xff}}, kMaximumReplyBytes).error().code, ErrorCode::tooLarge);
    const auto frame = encode({1, Done{}});
    const auto bytes = header(*frame);
    EXPECT_EQ(*payloadBytes(bytes, 4096), frame->size());
}

}  // namespace
}  // namespace emca::protocol
