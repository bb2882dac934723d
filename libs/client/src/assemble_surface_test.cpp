// A server may be wrong or hostile: surface layers that do not fit together are refused, and memory follows what arrived.
#include "assemble_surface.h"

#include <gtest/gtest.h>

#include <functional>

#include "emca/protocol/frame.h"

namespace emca::client {
namespace {

using protocol::SurfaceArrayPart;
using protocol::SurfaceChunk;
using protocol::SurfaceMeshPart;
using protocol::SurfaceResult;

using Counts = std::vector<std::uint32_t>;

/// One of two triangles divided once: 1 0000, then 0. Five faces.
const std::vector<std::uint8_t> kBits{0b000001};

struct Answer {
    SurfaceResult result;
    std::vector<SurfaceChunk> chunks;
};

/// Mesh 0: two triangles, five faces. Mesh 1: three triangles without values. Mesh 2: one triangle, not divided.
Answer goodAnswer() {
    Answer answer;
    answer.result.renderId = 5;
    answer.result.layers = {{{"hits", LayerKind::density, "1/m^2", ""}, 12, 12}, {{"radiance", LayerKind::meanColor, "", ""}, 3, 1}};
    answer.result.counts.points = 12;
    answer.result.meshCount = 3;
    answer.result.faceCount = 6;
    answer.result.topologyBytes = 1;
    SurfaceChunk first, second;
    first.meshes = {{0, 2, 5, 1, 0, kBits}, {1, 3, 0, 0, 0, {}}, {2, 1, 1, 0, 0, {}}};
    first.arrays = {{0, 0, std::vector<float>{1, 2, 3, 4, 5, 6}}, {1, 0, std::vector<float>{7, 8}}};
    second.arrays = {{1, 2, std::vector<float>{9, 10, 11, 12}}, {2, 0, std::vector<float>(18, 0.5f)}};
    second.last = true;
    answer.chunks = {first, second};
    return answer;
}

Result<SurfaceField> assembled(const Answer& answer, const std::optional<Counts>& known = Counts{2, 3, 1}) {
    SurfaceAssembler surface;
    if (auto begun = surface.begin(answer.result); !begun) return begun.error();
    for (const SurfaceChunk& chunk : answer.chunks) {
        if (auto added = surface.add(chunk); !added) return added.error();
    }
    return surface.take(known);
}

TEST(SurfaceAssembler, PutsPartsTogether) {
    const auto field = assembled(goodAnswer());
    ASSERT_TRUE(field.ok()) << field.error().message;
    ASSERT_EQ(field->meshes.size(), 3u);
    EXPECT_EQ(field->meshes[0], (SurfaceMesh{{kBits}, 0, 5}));
    EXPECT_EQ(field->meshes[1], (SurfaceMesh{{}, 5, 0}));
    EXPECT_EQ(field->meshes[2], (SurfaceMesh{{}, 5, 1}));
    EXPECT_EQ(field->counts.points, 12u);
    ASSERT_EQ(field->layers.size(), 2u);
    EXPECT_EQ(field->layers[0].samples, 12u);
    EXPECT_EQ(field->value(field->layers[0], 0, 4), 11.f);
    EXPECT_EQ(field->value(field->layers[0], 2, 0), 12.f);
    EXPECT_EQ(field->value(field->layers[0], 1, 0), 0.f);
    EXPECT_EQ(field->points[5], 6.f);
    EXPECT_TRUE(assembled(goodAnswer(), std::nullopt).ok()) << "also where the scene did not come";
}

TEST(SurfaceAssembler, FractionGoesByBytes) {
    SurfaceAssembler surface;
    const Answer answer = goodAnswer();
    EXPECT_EQ(surface.fraction(), 0);
    ASSERT_TRUE(surface.begin(answer.result).ok());
    EXPECT_EQ(surface.fraction(), 0);
    ASSERT_TRUE(surface.add(answer.chunks[0]).ok());
    EXPECT_DOUBLE_EQ(surface.fraction(), (1 + 8 * 4) / (1 + 30 * 4.0));
    ASSERT_TRUE(surface.add(answer.chunks[1]).ok());
    EXPECT_EQ(surface.fraction(), 1);
}

TEST(SurfaceAssembler, RefusesWhatDoesNotFit) {
    const auto refused = [](const char* what, const std::function<void(Answer&)>& spoil) {
        Answer answer = goodAnswer();
        spoil(answer);
        const auto field = assembled(answer);
        ASSERT_FALSE(field.ok()) << what;
        EXPECT_EQ(field.error().code, ErrorCode::protocolViolation) << what;
        EXPECT_GT(field.error().message.size(), 20u) << what;
    };
    ASSERT_TRUE(assembled(goodAnswer()).ok()) << "and the whole is accepted";
    refused("too many layers", [](Answer& a) { a.result.layers.resize(protocol::kMaximumSurfaceLayers + 1); });
    refused("too many faces", [](Answer& a) { a.result.faceCount = protocol::kMaximumSurfaceFaces + 1; });
    refused("more faces than come", [](Answer& a) { a.result.faceCount = 7; });
    refused("fewer faces than come", [](Answer& a) { a.result.faceCount = 5; });
    refused("a mesh too many", [](Answer& a) { a.result.meshCount = 2; });
    refused("a mesh too few", [](Answer& a) { a.result.meshCount = 4; });
    refused("meshes out of order", [](Answer& a) { std::swap(a.chunks[0].meshes[1], a.chunks[0].meshes[2]); });
    refused("a mesh is left out", [](Answer& a) { a.chunks[0].meshes.erase(a.chunks[0].meshes.begin() + 1); });
    refused("no subdivision", [](Answer& a) { a.chunks[0].meshes[0].bits = {}; });
    refused("subdivision that goes on", [](Answer& a) { a.chunks[0].meshes[0].bits = std::vector<std::uint8_t>(2); });
    refused("subdivision with a gap", [](Answer& a) { a.chunks[0].meshes[0].firstByte = 1; });
    refused("more bits than faces need", [](Answer& a) { a.chunks[0].meshes[0].byteCount = 0x7fffffff; });
    refused("bits of another subdivision", [](Answer& a) { a.chunks[0].meshes[0].bits = std::vector<std::uint8_t>{0b00011}; });
    refused("bits that end early", [](Answer& a) { a.chunks[0].meshes[0].bits = std::vector<std::uint8_t>{0xff}; });
    refused("a divided mesh without values", [](Answer& a) {
        a.chunks[0].meshes[1].byteCount = 1;
        a.chunks[0].meshes[1].bits = kBits;
    });
    refused("another scene", [](Answer& a) { a.chunks[0].meshes[1].triangleCount = 4; });
    refused("another scene, with values", [](Answer& a) { a.chunks[0].meshes[2].triangleCount = 0; });
    refused("an array is missing", [](Answer& a) { a.chunks[0].arrays.erase(a.chunks[0].arrays.begin()); });
    refused("an array comes twice", [](Answer& a) { a.chunks[0].arrays.insert(a.chunks[0].arrays.begin(), a.chunks[0].arrays[0]); });
    refused("an array has a gap", [](Answer& a) { a.chunks[1].arrays[0].first = 3; });
    refused("an array is too long", [](Answer& a) { a.chunks[1].arrays[1].values = std::vector<float>(19); });
    refused("an array is too short", [](Answer& a) { a.chunks[1].arrays[1].values = std::vector<float>(17); });
    refused("one array too many", [](Answer& a) { a.chunks[1].arrays.push_back({3, 0, std::vector<float>(6)}); });
    refused("values before meshes", [](Answer& a) {
        a.chunks[1].meshes = {a.chunks[0].meshes[2]};
        a.chunks[0].meshes.pop_back();
    });
    refused("a mesh after values", [](Answer& a) { a.chunks[1].meshes.push_back({2, 1, 1, 0, 0, {}}); });
    refused("it goes on after its end", [](Answer& a) { a.chunks.push_back({}); });
    refused("it ends early", [](Answer& a) { a.chunks[0].last = true; });
    refused("it never ends", [](Answer& a) { a.chunks[1].last = false; });
    refused("two layers of one name", [](Answer& a) { a.result.layers[1].description.name = "hits"; });
    refused("a layer without a name", [](Answer& a) { a.result.layers[0].description.name.clear(); });
}

TEST(SurfaceAssembler, OrderIsKept) {
    SurfaceAssembler surface;
    EXPECT_FALSE(surface.add(goodAnswer().chunks[0]).ok()) << "before the announcement";
    ASSERT_TRUE(surface.begin(goodAnswer().result).ok());
    EXPECT_FALSE(surface.begin(goodAnswer().result).ok()) << "twice";
}

TEST(SurfaceAssembler, ASceneWithoutAnySampleIsNoError) {
    Answer answer;
    answer.result.layers = {{{"hits", LayerKind::density, "", ""}, 0, 0}};
    answer.result.meshCount = 1;
    SurfaceChunk chunk;
    chunk.meshes = {{0, 2, 0, 0, 0, {}}};
    chunk.arrays = {{0, 0, {}}, {1, 0, {}}};
    chunk.last = true;
    answer.chunks = {chunk};
    const auto field = assembled(answer, Counts{2});
    ASSERT_TRUE(field.ok()) << field.error().message;
    EXPECT_EQ(field->faceCount(), 0u);
    EXPECT_EQ(field->layers.size(), 1u);
}

/// What is announced takes no memory: a field of 2^28 faces and 4096 layers, of which nothing comes.
TEST(SurfaceAssembler, AnnouncementsCostNothing) {
    SurfaceResult result;
    for (std::size_t i = 0; i < protocol::kMaximumSurfaceLayers; ++i) {
        result.layers.push_back({{std::to_string(i), LayerKind::meanColor, "", ""}, 0, 0});
    }
    result.meshCount = 0xffffffff;
    result.faceCount = protocol::kMaximumSurfaceFaces;
    SurfaceAssembler surface;
    ASSERT_TRUE(surface.begin(result).ok());
    SurfaceChunk chunk;
    chunk.meshes = {{0, 0xffffffff, static_cast<std::uint32_t>(protocol::kMaximumSurfaceFaces), 0, 0, {}}};
    EXPECT_TRUE(surface.add(chunk).ok());
    EXPECT_FALSE(surface.take(std::nullopt).ok());
}

}  // namespace
}  // namespace emca::client
