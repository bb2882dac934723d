// What is recorded through C is what is recorded through C++, whichever way it went.
#include <algorithm>
#include <cmath>

#include "emca/core/seed_map.h"
#include "emca/recorder/recorder.h"
#include "emca/server/server.h"
#include "everything.h"
#include "path_text.h"
#include "served_in_c.h"

namespace emca::test {
namespace {

Color valueOf(Pixel pixel, std::uint64_t sample, std::uint64_t seed) {
    const std::uint64_t bits = SeedMap(seed).seed(pixel, sample);
    return {float(bits & 0xffff) / 65536.f, float(bits >> 16 & 0xffff) / 65536.f, float(bits >> 32 & 0xffff) / 65536.f};
}

/// everything.c once more, with the calls of C++.
class Twin final : public Renderer {
  public:
    RendererInfo info() const override {
        return {.renderer = "everything in C++",
                .scene = "nothing",
                .width = EVERYTHING_WIDTH,
                .height = EVERYTHING_HEIGHT,
                .samplesPerPixel = EVERYTHING_SAMPLES,
                .integrator = "hash",
                .sampler = "none",
                .seed = 11};
    }
    Camera camera() const override { return {}; }
    std::vector<Mesh> meshes() const override { return {}; }
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor&) override {
        RenderedImage image{.color = Image(EVERYTHING_WIDTH, EVERYTHING_HEIGHT)};
        for (std::uint32_t y = 0; y < EVERYTHING_HEIGHT; ++y)
            for (std::uint32_t x = 0; x < EVERYTHING_WIDTH; ++x) image.color.setColor({x, y}, value({x, y}, settings));
        return image;
    }
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor&) override {
        return value(pixel, settings);
    }

  private:
    static void vertex(std::int32_t depth, Color value) {
        static const char* const kNames[3] = {"first", "second", "third"};
        PathRecorder& emca = recorder();
        emca.setIntersectionPos(Vec3f{float(depth), value.r, value.g});
        emca.setIntersectionSurface(depth, depth + 7);
        emca.setIntersectionEvent(Event::transmit, Lobe::glossy, kNames[depth - 1]);
        emca.setIntersectionEmission(Color(1, 2, float(depth)));
        emca.setIntersectionEstimate(value);
        emca.setNextEventEstimationPos(Vec3f{0, 5, 0}, depth % 2 == 0);
        emca.setNextEventEstimationPos(Vec3f{0, 6, 0}, true);
        emca.addContribution(value, "light sampling", 0.25f, LightEnd::connected);
        emca.addContribution(value, "not said");
        emca.addIntersectionData("bool", depth == 1);
        emca.addIntersectionData("int", -(std::int64_t(1) << 40) - depth);
        emca.addIntersectionData("int2", Vec2i{depth, 2});
        emca.addIntersectionData("int3", Vec3i{depth, 2, 3});
        emca.addIntersectionData("float", value.b);
        emca.addIntersectionData("float2", Vec2f{value.b, 1});
        emca.addIntersectionData("float3", Vec3f{value.b, 1, 2});
        emca.addIntersectionData("double", double(value.b) / 3.0);
        emca.addIntersectionData("double2", Vec2d{double(value.b) / 3.0, 1});
        emca.addIntersectionData("double3", Vec3d{double(value.b) / 3.0, 1, 2});
        emca.addIntersectionData("color", value);
        emca.addIntersectionData("color with alpha", ColorA{value.r, value.g, value.b, 0.5f});
        emca.addIntersectionData("text", kNames[depth - 1]);
        const float wavelengths[4] = {value.r, value.g, value.b, INFINITY};
        emca.addIntersectionData("spectrum", std::span(wavelengths, std::size_t(depth)));
        emca.addIntersectionData("twice", 1);
        emca.addIntersectionData("twice", 2);
        emca.addIntersectionData("both types", 1.5f);
        emca.addIntersectionData("both types", 1.5);
    }
    static void path(Pixel pixel, Color value) {
        PathRecorder& emca = recorder();
        emca.setPathOrigin(Vec3f{1, 2, 3});
        emca.addSplat({pixel.x ^ 1u, pixel.y}, value);
        emca.addPathData("bool", true);
        emca.addPathData("int", 7);
        emca.addPathData("int2", Vec2i{1, 2});
        emca.addPathData("int3", Vec3i{1, 2, 3});
        emca.addPathData("float", value.r);
        emca.addPathData("float2", Vec2f{1, 2});
        emca.addPathData("float3", Vec3f{1, 2, 3});
        emca.addPathData("double", 0.1);
        emca.addPathData("double2", Vec2d{0.1, 2});
        emca.addPathData("double3", Vec3d{0.1, 2, 3});
        emca.addPathData("color", value);
        emca.addPathData("color with alpha", ColorA{1, 2, 3, 0.5f});
        emca.addPathData("text", "a text that is longer than small strings are");
        emca.addPathData("spectrum", std::span<const float>(&value.r, 1));
        emca.setFinalEstimate(value);
    }
    static Color value(Pixel pixel, const RenderSettings& settings) {
        PathRecorder& emca = recorder();
        Color sum;
        for (std::uint32_t k = 0; k < settings.samplesPerPixel; ++k) {
            const Color one = valueOf(pixel, k, settings.seed);
            emca.setPathIndex(10 + std::int64_t(k), std::int32_t(k % 2));
            for (std::int32_t depth = 1; depth <= 3; ++depth) {
                emca.setDepthIndex(depth);
                vertex(depth, one);
            }
            emca.setDepthIndex(1, Subpath::light);
            vertex(1, one);
            emca.setDepthIndex(3);
            emca.setIntersectionPosEnvmap(Vec3f{0, 0, 1000});
            path(pixel, one);
            sum += one;
        }
        return sum / float(settings.samplesPerPixel);
    }
};

class Everything : public testing::TestWithParam<emca_renderer (*)()> {};

TEST_P(Everything, RecordsWhatCppRecords) {
    Twin twin;
    auto server = Server::start(twin);
    ASSERT_TRUE(server.ok());
    auto connection = client::Connection::open({"127.0.0.1", (*server)->port()});
    ASSERT_TRUE(connection.ok());
    const std::uint64_t misuses = emca_misuse(nullptr);
    ServedInC served(GetParam()());
    const auto image = served.client().render();
    ASSERT_TRUE(image.ok()) << image.error().message;
    for (const PixelRect rect : {PixelRect{0, 0, EVERYTHING_WIDTH, EVERYTHING_HEIGHT}, PixelRect{2, 3, 3, 4}}) {
        const auto expected = (*connection)->traceRect(rect), found = served.client().traceRect(rect);
        ASSERT_TRUE(expected.ok() && found.ok());
        ASSERT_EQ(expected->paths.pathCount(), rect.count() * EVERYTHING_SAMPLES);
        EXPECT_EQ(pathText(found->paths), pathText(expected->paths));
        for (const Replay& replay : found->replays) EXPECT_EQ(replay.verdict, Verdict::exact);
    }
    EXPECT_EQ(emca_misuse(nullptr), misuses);
}
INSTANTIATE_TEST_SUITE_P(EveryWay, Everything,
                         testing::Values(everything, everything_by_handles, everything_in_threads));

TEST(EverythingInC, TheTextSeesADifference) {
    ServedInC served(everything());
    const auto one = served.client().tracePixel({1, 1}), other = served.client().tracePixel({2, 1});
    ASSERT_TRUE(one.ok() && other.ok());
    EXPECT_NE(pathText(one->paths), pathText(other->paths));
    const std::string text = pathText(one->paths);
    for (const char* part : {"environment", "light 1", "twice int 1", "twice int 2",
                             "contribution connected \"light sampling\"", "splat 0,1", "color with alpha"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(EverythingInC, LightPathsAreKeptWhereTheySplat) {
    ServedInC served(everything_by_splats());
    const auto trace = served.client().tracePixels({{3, 2}, {5, 0}});
    ASSERT_TRUE(trace.ok()) << trace.error().message;
    ASSERT_EQ(trace->paths.pathCount(), 2u);
    for (Index path = 0; path < 2; ++path) {
        const Pixel pixel = trace->paths.pixel(path);
        EXPECT_EQ(trace->paths.sample(path), pixel.y * EVERYTHING_WIDTH + pixel.x);
        EXPECT_EQ(trace->paths.columns().splats[path].value, valueOf(pixel, 0, 11));
    }
}

TEST(EverythingInC, SourceLinesAreThoseOfTheKeys) {
    ServedInC served(everything());
    const auto trace = served.client().tracePixel({1, 1}, {.locations = true});
    ASSERT_TRUE(trace.ok());
    const auto columns = trace->paths.find(Scope::vertex, "float");
    ASSERT_EQ(columns.size(), 1u);
    ASSERT_FALSE(columns[0]->locations.empty());
    EXPECT_NE(trace->paths.text(columns[0]->locations[0]).find("everything.c:"), std::string::npos);
}

TEST(EverythingInC, OnlyTheColumnsThatWereAskedForAreRecorded) {
    ServedInC served(everything());
    const auto trace = served.client().tracePixel({1, 1}, {.columns = {"position", "double2"}});
    ASSERT_TRUE(trace.ok());
    EXPECT_TRUE(trace->paths.columns().contributions.empty());
    EXPECT_FALSE(trace->paths.columns().positions.empty());
    for (const Column& column : trace->paths.userColumns()) EXPECT_EQ(column.name, "double2");
}

TEST(EverythingInC, TheRestOfTheRendererArrives) {
    ServedInC served(everything());
    const auto info = served.client().info();
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->renderer, "everything in C");
    EXPECT_EQ(info->integrator, "hash");
    EXPECT_EQ(info->seed, 11u);
    EXPECT_NE(std::find(info->capabilities.begin(), info->capabilities.end(), "deterministic"),
              info->capabilities.end())
        << "unless it says otherwise";
    EXPECT_NE(std::find(info->capabilities.begin(), info->capabilities.end(), "two"), info->capabilities.end());
    const auto camera = served.client().camera();
    ASSERT_TRUE(camera.ok());
    EXPECT_EQ(
        *camera,
        (Camera{.kind = CameraKind::orthographic, .position = {1, 2, 3}, .focusDistance = 4, .rightHanded = false}))
        << "and the rest as usual";
    const auto meshes = served.client().meshes();
    ASSERT_TRUE(meshes.ok());
    ASSERT_EQ(meshes->size(), 1u);
    const Mesh& mesh = meshes->front();
    EXPECT_EQ(mesh.name + "/" + mesh.material, "triangle/chalk");
    EXPECT_EQ(mesh.triangles, std::vector<Triangle>({{0, 1, 2}}));
    EXPECT_EQ(mesh.positions[1], (Vec3f{1, 0, 0}));
    EXPECT_EQ(mesh.diffuse, Color(0.5f, 0.25f, 1));
    EXPECT_EQ(mesh.emission, Color(3, 2, 1));
    std::atomic<int> previews = 0;
    const auto render = served.client().render({.samplesPerPixel = 5},
                                               {.preview = [&](PixelRect, std::span<const Color>) { ++previews; }});
    ASSERT_TRUE(render.ok());
    EXPECT_GT(previews, 0);
    EXPECT_EQ(*render->image.samples.at({2, 1}), 7);
    EXPECT_EQ(render->image.variance.color({2, 3}), Color(2, 3, 1));
}

}  // namespace
}  // namespace emca::test
