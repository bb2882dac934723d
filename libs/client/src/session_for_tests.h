#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "convert.h"
#include "emca/client/session.h"
#include "emca/protocol/codec.h"

/// A small session in which every field of every part is used, and what it means that two are the same.
namespace emca::client::test {

constexpr std::uint64_t kSavedAt = 1'700'000'000;
constexpr const char* kSoftware = "EMCA of a test";

template <typename T>
SharedArray<std::byte> bytesOf(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Frozen: the golden file is made from it. Two paths of one pixel and one of another, with every core column and user
/// columns of several types, dense and sparse.
inline PathSet samplePaths(std::uint32_t x) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float nan = std::bit_cast<float>(0x7fc12345u);
    PathColumns c;
    c.strings = {"glass", "wall", "light sampling", "bsdf sampling", "pixel.cpp:12"};
    c.pixels = std::vector<Pixel>{{x, 2}, {x, 2}, {x + 1, 2}};
    c.samples = std::vector<std::int64_t>{-3, 1ll << 40, 0};
    c.parts = std::vector<std::int32_t>{0, 2, 0};
    c.pathFlags = std::vector<std::uint8_t>{3, 3, 1};
    c.origins = std::vector<Vec3f>{{0, 0, 5}, {0, 1, 5}, {nan, 0, 0}};
    c.estimates = std::vector<Color>{{1, 2, 3}, {nan, kInfinity, -0.f}, {}};
    c.firstVertex = std::vector<Index>{0, 2, 4, 4};
    c.depths = std::vector<std::int32_t>{1, 2, 1, 5};
    c.vertexFlags = std::vector<std::uint8_t>{1 | 4 | 8 | 16 | 32, 1 | 2, 1 | 4 | 16 | 32, 0};
    c.positions = std::vector<Vec3f>{{1, 0, 0}, {100, 0, 0}, {0, 1, 0}, {}};
    c.vertexEstimates = std::vector<Color>{{1, 1, 1}, {}, {2, 2, 2}, {}};
    c.emissions = std::vector<Color>{{7, 7, 7}, {}, {}, {}};
    c.meshes = std::vector<std::int32_t>{0, -1, 1, -1};
    c.faces = std::vector<std::int32_t>{1, -1, 0, -1};
    c.events = std::vector<std::uint8_t>{1, 0, 2, 0};
    c.lobes = std::vector<std::uint8_t>{1, 0, 3, 0};
    c.labels = std::vector<std::uint32_t>{1, kNoString, 0, kNoString};
    c.nextEventOwners = std::vector<Index>{0, 0, 2};
    c.nextEvents = std::vector<NextEvent>{{{0, 9, 0}, 1}, {{0, 9, 1}, 0}, {{0, 9, 2}, 1}};
    c.contributionOwners = std::vector<Index>{0, 2};
    c.contributions = std::vector<Contribution>{{{1, 1, 1}, 0.5f, 2, LightEnd::connected, {}}, {{2, 2, 2}, nan, 3, LightEnd::hit, {}}};
    c.splatOwners = std::vector<Index>{1};
    c.splats = std::vector<Splat>{{{x, 2}, {3, 3, 3}}};
    Column depth{"left scene", Scope::path, ValueType::boolean, 3, {}, bytesOf<std::uint8_t>({1, 0, 1}), {}, {}};
    Column spectrum{"lambda", Scope::path, ValueType::spectrum, 1, std::vector<Index>{2}, bytesOf<float>({400, 500, 600}),
                    std::vector<std::uint32_t>{0, 3}, {}};
    Column material{"material", Scope::vertex, ValueType::text, 4, {}, bytesOf<std::uint32_t>({0, 1, 0, 1}), {},
                    std::vector<std::uint32_t>{4, 4, kNoString, 4}};
    Column pdf{"pdf", Scope::vertex, ValueType::double1, 2, std::vector<Index>{0, 2}, bytesOf<double>({1e-300, 0.25}), {}, {}};
    c.columns = {spectrum, depth, material, pdf};  // by scope, name and type
    auto paths = PathSet::make(std::move(c));
    EXPECT_TRUE(paths.ok()) << (paths ? "" : paths.error().message);
    return paths ? std::move(paths).value() : PathSet();
}

inline Image filled(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels, float first) {
    Image image(width, height, std::move(channels));
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = first + static_cast<float>(i) / 8;
    return image;
}

inline Trace sampleTrace(std::uint32_t x) {
    Trace trace;
    trace.pixels = {{x, 2}, {x + 1, 2}};
    trace.replays = {{Verdict::exact, SumCheck::matches, {1, 2, 3}, {1, 2, 3}}, {Verdict::different, SumCheck::differs, {1, 0, 0}, {0, 1, 0}}};
    trace.samplesPerPixel = 16 + x;
    trace.paths = samplePaths(x);
    trace.stats = {1, 2, 3, 4, 5000};
    trace.renderSeconds = 0.125;
    trace.totalSeconds = 0.25 + x;
    trace.renderId = 7;
    trace.seed = 0xfedcba9876543210u;
    trace.integrator = "path";
    trace.sampler = "sobol";
    if (x == 4) {
        trace.matches = MatchCounts{100, 3, 2, 1, {"pdf"}, std::vector<std::uint32_t>{1, 2}, std::vector<Color>{{1, 2, 3}, {4, 5, 6}}};
    }
    return trace;
}

inline ServerInfo sampleInfo() {
    ServerInfo info;
    info.renderer = "renderer 1.0";
    info.scene = "a scene";
    info.integrator = "path";
    info.sampler = "sobol";
    info.width = 4;
    info.height = 3;
    info.samplesPerPixel = 64;
    info.seed = 5;
    info.triangles = 3;
    info.meshes = 3;
    info.maximumSamplesPerPixel = 4096;
    info.maximumPixelsPerTrace = 100;
    info.capabilities = {"surface-layers"};
    info.tools = {"probe"};
    info.latestRender = 7;
    info.layers = {{"hits", LayerKind::density, "1/m^2", "Adds 1 at each hit."}, {"radiance", LayerKind::meanColor, "", ""}};
    info.surfaceRender = 7;
    info.collected = {{info.layers[0], 9, 9}, {info.layers[1], 9, 2.5}};
    info.maximumSurfaceBudget = 1ull << 32;
    return info;
}

inline std::vector<Mesh> sampleMeshes() {
    Mesh quad;
    quad.name = "quad";
    quad.material = "wall";
    quad.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    quad.triangles = {{0, 1, 2}, {0, 2, 3}};
    quad.diffuse = {0.25f, 0.5f, 0.75f};
    Mesh lamp;
    lamp.positions = {{0, 0, 3}, {1, 0, 3}, {0, 1, 3}};
    lamp.triangles = {{0, 2, 1}};
    lamp.emission = Color(17);
    return {quad, lamp, Mesh()};
}

/// On sampleMeshes(): the first triangle is divided once, the lamp has no sample.
inline SurfaceField sampleField() {
    SurfaceField field;
    field.meshes.resize(3);
    field.meshes[0].subdivision.bits = {1};
    field.meshes[0].faceCount = 5;
    field.meshes[1].firstFace = field.meshes[2].firstFace = 5;
    field.points = std::vector<float>{0, 0, 0, 2, 1};
    const ServerInfo info = sampleInfo();
    std::vector<float> colors(15, 0.5f);
    colors[3] = std::numeric_limits<float>::quiet_NaN();
    field.layers = {{info.layers[0], std::vector<float>{0, 0, 0, 16, 2}, 3, 3}, {info.layers[1], colors, 9, 2.5}};
    field.counts = {3, 0, 1, 0, 4096, 1 << 20};
    return field;
}

inline Session sampleSession() {
    Session session;
    session.info = sampleInfo();
    Camera camera;
    camera.kind = CameraKind::orthographic;
    camera.position = {1, 2, 3};
    camera.apertureRadius = 0.125f;
    camera.rightHanded = false;
    session.camera = camera;
    session.meshes = std::make_shared<const std::vector<Mesh>>(sampleMeshes());
    session.surface = std::make_shared<const SurfaceField>(sampleField());
    RenderedImage render{filled(4, 3, {"R", "G", "B"}, 1), filled(4, 3, {"samples"}, 64), filled(4, 3, {"R", "G", "B"}, 0)};
    render.color.setColor({1, 1}, Color(std::numeric_limits<float>::quiet_NaN()));
    RenderedImage opened{filled(2, 5, {"Y", "A", "depth.Z", "id"}, -3), {}, {}};
    RenderedImage preview{filled(4, 3, {"R", "G", "B"}, 9), filled(4, 3, {"samples"}, 1), {}};
    session.images = {{"render 1, 64 spp", std::make_shared<const RenderedImage>(render), 7, 64, 5, "path", "sobol", false},
                      {"opened.exr", std::make_shared<const RenderedImage>(opened), 0, 0, 0, "", "", false},
                      {"render 2", std::make_shared<const RenderedImage>(preview), 8, 16, 6, "path", "independent", true}};
    session.currentImage = 1;
    for (const std::uint32_t x : {8u, 4u, 0u}) session.traces.push_back(std::make_shared<const Trace>(sampleTrace(x)));
    session.shown = {2, 0};
    const PathId path{{8, 2}, -3, 0}, other{{8, 2}, 1ll << 40, 2};
    session.selection = {Pixel{8, 2}, {path, other}, other, VertexId{other, 5, Subpath::light}};
    session.notes = "The caustic under the glass is too bright.\nSee pixel (8, 2).";
    session.pixelNotes = {{{8, 2}, "a firefly: pdf 1e-300"}, {{0, 0}, ""}};
    session.filter = SavedFilter{"luminance > 2 and depth < 9", {{"luminance", 0, 4, "2"}, {"v.`BSDF pdf`", 3, 15, ""}}, true, true};
    session.view = SavedView{2, {{"image/mode", "split"}, {"scene/clipAxis", "2"}, {"", ""}}, {{other, false, true}},
                             {{VertexId{path, 1, Subpath::camera}, true, false, true}}};
    return session;
}

inline bool same(const Image& a, const Image& b) {
    return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() && a.size() == b.size() &&
           (a.size() == 0 || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}
inline bool same(const ImageEntry& a, const ImageEntry& b) {
    return a.title == b.title && a.renderId == b.renderId && a.samplesPerPixel == b.samplesPerPixel && a.seed == b.seed &&
           a.integrator == b.integrator && a.sampler == b.sampler && a.preview == b.preview && same(a.image->color, b.image->color) &&
           same(a.image->samples, b.image->samples) && same(a.image->variance, b.image->variance);
}
/// The bytes of the message, which codec_test.cpp shows to keep every bit of every column.
inline std::vector<std::byte> bits(const Trace& trace) {
    const auto frame = protocol::encode({1, messageOf(trace)});
    EXPECT_TRUE(frame.ok());
    return {frame->begin(), frame->end()};
}
inline bool same(const Trace& a, const Trace& b) {
    return a.totalSeconds == b.totalSeconds && a.pixels == b.pixels && a.samplesPerPixel == b.samplesPerPixel && a.seed == b.seed &&
           a.renderSeconds == b.renderSeconds && a.renderId == b.renderId && a.integrator == b.integrator && a.sampler == b.sampler &&
           a.stats == b.stats && a.matches.has_value() == b.matches.has_value() &&
           (!a.matches || (a.matches->paths == b.matches->paths && a.matches->matched == b.matches->matched && a.matches->missing == b.matches->missing)) &&
           bits(a) == bits(b);
}
inline bool same(const Mesh& a, const Mesh& b) {
    return a.name == b.name && a.material == b.material && a.positions == b.positions && a.triangles == b.triangles &&
           a.diffuse == b.diffuse && a.emission == b.emission;
}
inline bool sameBits(const SharedArray<float>& a, const SharedArray<float>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}
inline bool same(const SurfaceField& a, const SurfaceField& b) {
    if (a.meshes != b.meshes || a.counts != b.counts || a.layers.size() != b.layers.size() || !sameBits(a.points, b.points)) return false;
    for (std::size_t i = 0; i < a.layers.size(); ++i) {
        const SurfaceLayerData &p = a.layers[i], &q = b.layers[i];
        if (p.description != q.description || p.samples != q.samples || p.total != q.total || !sameBits(p.values, q.values)) return false;
    }
    return true;
}
inline bool same(const ServerInfo& a, const ServerInfo& b) {
    const auto all = [](const ServerInfo& i) {
        return std::tie(i.renderer, i.scene, i.integrator, i.sampler, i.width, i.height, i.samplesPerPixel, i.seed, i.triangles, i.meshes,
                        i.maximumSamplesPerPixel, i.maximumPixelsPerTrace, i.capabilities, i.tools, i.latestRender, i.layers,
                        i.surfaceRender, i.collected, i.maximumSurfaceBudget);
    };
    return all(a) == all(b);
}

inline std::vector<std::byte> contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
}
inline void put(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// What differs between two sessions, or nothing.
inline std::string difference(const Session& a, const Session& b) {
    if (a.info.has_value() != b.info.has_value() || (a.info && !same(*a.info, *b.info))) return "info";
    if (a.camera != b.camera) return "camera";
    if (!a.meshes != !b.meshes) return "scene";
    if (a.meshes && a.meshes->size() != b.meshes->size()) return "number of meshes";
    for (std::size_t i = 0; a.meshes && i < a.meshes->size(); ++i) {
        if (!same((*a.meshes)[i], (*b.meshes)[i])) return "mesh " + std::to_string(i);
    }
    if (!a.surface != !b.surface || (a.surface && !same(*a.surface, *b.surface))) return "surface";
    if (a.images.size() != b.images.size() || a.currentImage != b.currentImage) return "images";
    for (std::size_t i = 0; i < a.images.size(); ++i) {
        if (!same(a.images[i], b.images[i])) return "image " + std::to_string(i);
    }
    if (a.traces.size() != b.traces.size() || a.shown != b.shown) return "traces";
    for (std::size_t i = 0; i < a.traces.size(); ++i) {
        if (!same(*a.traces[i], *b.traces[i])) return "trace " + std::to_string(i);
    }
    if (a.selection != b.selection) return "selection";
    if (a.filter != b.filter) return "filter";
    if (a.view != b.view) return "view";
    if (a.notes != b.notes || a.pixelNotes != b.pixelNotes) return "notes";
    return "";
}

/// A folder of the running test, empty at its begin and gone at its end.
class SessionTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) / ("session." + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(folder_);
        ASSERT_TRUE(std::filesystem::create_directory(folder_));
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path file(const std::string& name = "a.emca") const { return folder_ / name; }
    std::filesystem::path folder_;
};

}  // namespace emca::client::test
