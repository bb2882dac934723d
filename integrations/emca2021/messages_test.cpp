// Every message, cut at every byte, and with everything in it wrong that can be.
#include "messages.h"

#include <gtest/gtest.h>

#include "published_for_tests.h"

namespace emca::bridge {
namespace {

using namespace test;

std::vector<std::byte> pixelBytes(bool swapped = false, std::uint32_t tooMany = 0) {
    const auto paths = examplePaths({3, 4}, 6);
    Writer out(swapped);
    write(out, static_cast<std::uint32_t>(paths.size()) + tooMany, paths);
    return out.bytes();
}

std::vector<std::byte> names() {
    Writer out;
    out.id(MessageId::info).text("in-test renderer").text("two triangles");
    return out.bytes();
}

void expectSame(const PublishedPath& a, const PublishedPath& b) {
    EXPECT_EQ(a.data, b.data);
    EXPECT_EQ(a.sample, b.sample);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.estimate, b.estimate);
    ASSERT_EQ(a.intersections.size(), b.intersections.size());
    for (std::size_t i = 0; i < a.intersections.size(); ++i) {
        const auto &x = a.intersections[i], &y = b.intersections[i];
        EXPECT_EQ(x.data, y.data);
        EXPECT_EQ(x.depth, y.depth);
        EXPECT_EQ(x.position, y.position);
        EXPECT_EQ(x.nextEvent.has_value(), y.nextEvent.has_value());
        if (x.nextEvent && y.nextEvent) {
            EXPECT_EQ(x.nextEvent->position, y.nextEvent->position);
            EXPECT_EQ(x.nextEvent->visible, y.nextEvent->visible);
        }
        EXPECT_EQ(x.estimate, y.estimate);
        EXPECT_EQ(x.emission, y.emission);
    }
}

TEST(PublishedMessages, PixelsArriveAsTheyWereSentInBothByteOrders) {
    for (const bool swapped : {false, true}) {
        const auto bytes = pixelBytes(swapped);
        for (const std::size_t portion : {std::size_t(1), std::size_t(7), bytes.size()}) {
            Bytes source(bytes, ErrorCode::connectionLost, portion);
            WireReader in(source);
            in.setSwapped(swapped);
            const PublishedPixel pixel = readPixel(in, {});
            ASSERT_TRUE(in.ok()) << in.error().message;
            const auto expected = examplePaths({3, 4}, 6);
            ASSERT_EQ(pixel.paths.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) expectSame(pixel.paths[i], expected[i]);
            EXPECT_EQ(pixel.remark, "");
            EXPECT_TRUE(in.drained());
        }
    }
}

TEST(PublishedMessages, EveryCutOfAPixelIsAnErrorThatCountsWhatCame) {
    const auto bytes = pixelBytes();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        Bytes source{std::span(bytes).first(size)};
        WireReader in(source);
        const PublishedPixel pixel = readPixel(in, {});
        ASSERT_FALSE(in.ok()) << size;
        EXPECT_EQ(in.error().code, ErrorCode::connectionLost);
        if (size >= 4) {
            EXPECT_NE(in.error().message.find("(after " + std::to_string(pixel.paths.size()) + " of 5 paths)"), std::string::npos) << in.error().message;
        }
    }
}

TEST(PublishedMessages, SilenceBetweenPathsKeepsWhatCameAndSaysSo) {
    const auto bytes = pixelBytes();
    std::vector<std::size_t> ends{4};  // where each path ends
    for (const PublishedPath& path : examplePaths({3, 4}, 6)) {
        Writer out;
        write(out, path);
        ends.push_back(ends.back() + out.bytes().size());
    }
    ASSERT_EQ(ends.back(), bytes.size());
    for (std::size_t size = 4; size < bytes.size(); ++size) {
        Bytes source{std::span(bytes).first(size), ErrorCode::timedOut};
        WireReader in(source);
        const PublishedPixel pixel = readPixel(in, {});
        const auto boundary = std::find(ends.begin(), ends.end(), size);
        ASSERT_EQ(in.ok(), boundary != ends.end()) << size;
        if (!in.ok()) continue;
        EXPECT_TRUE(pixel.endedBySilence);
        EXPECT_EQ(pixel.paths.size(), std::size_t(boundary - ends.begin()));
        EXPECT_NE(pixel.remark.find("announced 5 paths and sent " + std::to_string(pixel.paths.size())), std::string::npos) << pixel.remark;
    }
}

TEST(PublishedMessages, WhatFollowsAPixelEndsItBeforeTheAnnouncedNumber) {
    auto bytes = pixelBytes(false, 1);
    const auto next = names();
    bytes.insert(bytes.end(), next.begin(), next.end());
    Bytes source(bytes);
    WireReader in(source);
    const PublishedPixel pixel = readPixel(in, next);
    ASSERT_TRUE(in.ok()) << in.error().message;
    EXPECT_EQ(pixel.paths.size(), 5u);
    EXPECT_FALSE(pixel.endedBySilence);
    EXPECT_NE(pixel.remark.find("announced 6 paths and sent 5"), std::string::npos) << pixel.remark;
    EXPECT_TRUE(in.nextIs(next)) << "it was left for who waits for it";
}

TEST(PublishedMessages, PathsThatLookLikeWhatFollowsAreNotTakenForIt) {
    PublishedPath path;
    for (int i = 0; i < 33; ++i) path.data.emplace_back("", true);  // 33 is 0x21, the id of the names
    Writer out;
    write(out, 2, {path, path});
    Writer next;
    next.id(MessageId::info).text("").text("");
    Bytes source(out.bytes());
    WireReader in(source);
    EXPECT_EQ(readPixel(in, next.bytes()).paths.size(), 2u);
    EXPECT_TRUE(in.ok());
}

TEST(PublishedMessages, NamesAsLongAsAllowedAreStillRecognised) {
    const std::string longest(WireLimits().nameBytes, 'x');
    Writer next;
    next.id(MessageId::info).text(longest).text(longest);
    Writer out;
    out.u32(1);
    std::vector<std::byte> bytes = out.bytes();
    bytes.insert(bytes.end(), next.bytes().begin(), next.bytes().end());
    Bytes source(bytes, ErrorCode::connectionLost, 5000);
    WireReader in(source);
    EXPECT_EQ(readPixel(in, next.bytes()).paths.size(), 0u);
    EXPECT_TRUE(in.nextIs(next.bytes()));
    EXPECT_EQ(in.integer<std::int16_t>(), MessageId::info);
    EXPECT_EQ(in.text(WireLimits().nameBytes, "a name"), longest);
    EXPECT_EQ(in.text(WireLimits().nameBytes, "a name"), longest);
    EXPECT_TRUE(in.ok());
}

TEST(PublishedMessages, ScenesAndCamerasArriveAsTheyWereSentAndEveryCutIsAnError) {
    const Show show = exampleShow();
    for (const PublishedScene& scene : {show.scene, *show.heatMap}) {
        Writer out;
        write(out, scene);
        for (std::size_t size = 0; size <= out.bytes().size(); ++size) {
            Bytes source{std::span(out.bytes()).first(size)};
            WireReader in(source);
            const PublishedScene read = readScene(in);
            ASSERT_EQ(in.ok(), size == out.bytes().size()) << size;
            if (!in.ok()) continue;
            ASSERT_EQ(read.shapes.size(), 2u);
            EXPECT_EQ(read.shapes[0].positions, scene.shapes[0].positions);
            EXPECT_EQ(read.shapes[0].triangles, scene.shapes[0].triangles);
            EXPECT_EQ(read.shapes[0].faceColors, scene.shapes[0].faceColors);
            EXPECT_EQ(read.shapes[0].diffuse, scene.shapes[0].diffuse);
            EXPECT_EQ(read.shapes[1].specular, scene.shapes[1].specular);
            EXPECT_EQ(read.shapes[1].sphere->radius, 0.5f);
            EXPECT_EQ(read.heatMap.has_value(), scene.heatMap.has_value());
            if (read.heatMap) {
                EXPECT_EQ(read.heatMap->label, "samples");
            }
        }
    }
    Writer out;
    write(out, show.camera);
    for (std::size_t size = 0; size <= out.bytes().size(); ++size) {
        Bytes source{std::span(out.bytes()).first(size)};
        WireReader in(source);
        const PublishedCamera camera = readCamera(in);
        ASSERT_EQ(in.ok(), size == out.bytes().size());
        if (in.ok()) {
            EXPECT_EQ(camera.fieldOfView, 40.f);
        }
    }
}

/// The error of a message that goes wrong.
Error errorOf(const Writer& out, const std::function<void(WireReader&)>& read, WireLimits limits = {}) {
    Bytes source(out.bytes());
    WireReader in(source, limits);
    read(in);
    EXPECT_FALSE(in.ok());
    return in.error();
}

TEST(PublishedMessages, AbsurdCountsAreRefusedBeforeMemoryIsTaken) {
    const auto refused = [](const Writer& out, const std::function<void(WireReader&)>& read, const char* word) {
        const Error error = errorOf(out, read);
        EXPECT_EQ(error.code, ErrorCode::protocolViolation) << error.message;
        EXPECT_NE(error.message.find(word), std::string::npos) << error.message;
    };
    const auto pixel = [](WireReader& in) { (void)readPixel(in, {}); };
    const auto scene = [](WireReader& in) { (void)readScene(in); };
    refused(Writer().u32(0xfffffff0u), pixel, "4294967280 paths");
    refused(Writer().u32(1).u32(0x7fffffffu), pixel, "2147483647 values");
    refused(Writer().u32(1).u32(1).add(std::uint64_t(-1)), pixel, "18446744073709551615 bytes for a name");
    refused(Writer().u32(1).u32(1).text("key").letters("s").add(std::uint64_t(1) << 40), pixel, "for a text");
    refused(Writer().u32(1).u32(0).u32(0).u32(0).vector({}).boolean(false).u32(0xffffffffu), pixel, "4294967295 intersections");
    refused(Writer().boolean(false).u32(0xffffffffu), scene, "4294967295 meshes");
    refused(Writer().boolean(false).u32(1).id(0).u32(0xffffffffu), scene, "vertices");
    refused(Writer().add(std::uint64_t(1) << 60), [](WireReader& in) { (void)readInfo(in); }, "the renderer's name");

    // What is allowed, but does not come, takes no memory: 128 million vertices would be 1.5 GB.
    const Error cut = errorOf(Writer().boolean(false).u32(1).id(0).u32(1u << 27), scene);
    EXPECT_EQ(cut.code, ErrorCode::connectionLost);

    const auto bytes = pixelBytes();
    Bytes source(bytes);
    WireReader in(source, {.replyBytes = 500});
    (void)readPixel(in, {});
    EXPECT_EQ(in.error().code, ErrorCode::tooLarge);
}

TEST(PublishedMessages, WhatIsNotOfThisProtocolIsNamed) {
    const auto pixel = [](WireReader& in) { (void)readPixel(in, {}); };
    for (const char* type : {"q", "2s", "4i", "3d", "5f", "2?", "\x01"}) {
        const Error error = errorOf(Writer().u32(1).u32(1).text("odd value").letters(type).add(0.0).add(0.0), pixel);
        EXPECT_EQ(error.code, ErrorCode::protocolViolation);
        EXPECT_NE(error.message.find("\"odd value\" has the type"), std::string::npos) << error.message;
    }
    const auto scene = [](WireReader& in) { (void)readScene(in); };
    EXPECT_NE(errorOf(Writer().boolean(false).u32(1).id(7), scene).message.find("type 7"), std::string::npos);
    EXPECT_NE(errorOf(Writer().add(std::uint8_t(57)), scene).message.find("57 instead of 0 or 1"), std::string::npos);
    Writer colors;
    colors.boolean(false).u32(1).id(0).u32(0).u32(0).u32(5);
    EXPECT_NE(errorOf(colors, scene).message.find("5 face colours for 0 triangles"), std::string::npos);
    Writer depth;
    depth.u32(1).u32(0).u32(0).u32(0).vector({}).boolean(false).u32(1).u32(0).u32(0xfffffff0u);
    EXPECT_NE(errorOf(depth, pixel).message.find("depth 4294967280"), std::string::npos);
}

}  // namespace
}  // namespace emca::bridge
