// examples/minimal_renderer.c as a person runs it: what it renders does not depend on EMCA, and what it records is true
// of its scene.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "emca/client/connection.h"
#include "emca/probe/light_probe.h"
#include "process.h"

namespace emca::test {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120;

/// The scene of the example.
struct Sphere {
    Vec3f centre;
    float radius;
    Color albedo, emission;
};
const std::array<Sphere, 4> kSpheres{{{{0, -1000, 0}, 1000, Color(0.6f), Color()},
                                      {{-1.1f, 1, 0}, 1, {0.8f, 0.3f, 0.2f}, Color()},
                                      {{1.1f, 1, 0}, 1, {0.2f, 0.5f, 0.8f}, Color()},
                                      {{0, 5, 1}, 1, Color(), {12, 11, 9}}}};
const Color kSky(0.2f, 0.25f, 0.3f);

struct Example {
    explicit Example(const char* program) : process({program, "0"}) {
        auto opened = client::Connection::open({"127.0.0.1", std::uint16_t(process.port())});
        EXPECT_TRUE(opened.ok()) << opened.error().message;
        if (opened) connection = std::move(opened).value();
    }
    ServingProcess process;
    std::unique_ptr<client::Connection> connection;
};

bool sameBits(const Image& a, const Image& b) {
    return a.size() == b.size() && a.size() > 0 && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Image rendered(client::Connection& connection, client::RenderOptions options) {
    auto render = connection.render(options);
    EXPECT_TRUE(render.ok()) << render.error().message;
    return render ? render->image.color : Image();
}

TEST(ExampleInC, RendersTheSameWithoutRecordingWhileIdleAndWhileRecording) {
    Example without(EMCA_EXAMPLE_DISABLED), with(EMCA_EXAMPLE);
    ASSERT_TRUE(without.connection && with.connection);
    const client::RenderOptions options{.samplesPerPixel = 4, .seed = 3, .hasSeed = true};
    const Image absent = rendered(*without.connection, options), idle = rendered(*with.connection, options);
    EXPECT_TRUE(sameBits(absent, idle));
    EXPECT_FALSE(sameBits(idle, rendered(*with.connection, {.samplesPerPixel = 4, .seed = 4, .hasSeed = true})))
        << "another seed";
    rendered(*with.connection, options);
    // The whole image once more, with everything recorded.
    const auto active = with.connection->traceRect({0, 0, kWidth, kHeight});
    ASSERT_TRUE(active.ok()) << active.error().message;
    EXPECT_EQ(active->samplesPerPixel, 4u);
    const ReplayCounts counts = countReplays(active->replays);
    EXPECT_EQ(counts.exact, std::size_t(kWidth) * kHeight);
    EXPECT_EQ(counts.sumsDiffer, 0u);
    EXPECT_EQ(active->paths.pathCount(), 4 * kWidth * kHeight);
    const auto nothing = without.connection->tracePixel({3, 4});
    ASSERT_TRUE(nothing.ok());
    EXPECT_EQ(nothing->paths.pathCount(), 0u) << "EMCA_DISABLED leaves no calls";
    EXPECT_EQ(nothing->replays.at(0).verdict, Verdict::exact);
}

TEST(ExampleInC, RecordsWhatIsTrueOfItsScene) {
    Example example(EMCA_EXAMPLE);
    ASSERT_TRUE(example.connection);
    const auto meshes = example.connection->meshes();
    const auto trace = example.connection->traceRect({60, 40, 100, 80}, {.samplesPerPixel = 8});
    ASSERT_TRUE(meshes.ok() && trace.ok());
    ASSERT_EQ(meshes->size(), kSpheres.size());
    const PathSet& paths = trace->paths;
    ASSERT_EQ(paths.pathCount(), 40u * 40 * 8);
    int hits = 0, escapes = 0, lamps = 0;
    for (Index path = 0; path < paths.pathCount(); ++path) {
        Color throughput(1.f), sum;
        EXPECT_EQ(paths.origin(path), (Vec3f{0, 2.2f, 7}));
        std::int32_t depth = 0;
        for (Index v = paths.vertices(path).first; v < paths.vertices(path).last; ++v) {
            ASSERT_EQ(paths.depthIndex(v), ++depth) << "no vertex is missing";
            const Vec3f position = paths.position(v).value();
            const IndexRange lights = paths.contributions(v);
            for (Index i = lights.first; i < lights.last; ++i) {
                sum += paths.contribution(i).value;
                EXPECT_EQ(paths.text(paths.contribution(i).technique), "BSDF sampling");
            }
            EXPECT_EQ(paths.vertexEstimate(v), sum) << "a running sum of what was added";
            if (paths.isEnvironment(v)) {
                EXPECT_EQ(paths.emission(v), kSky);
                EXPECT_EQ(v + 1, paths.vertices(path).last);
                EXPECT_EQ(paths.contribution(lights.first).value, throughput * kSky);
                ++escapes;
                continue;
            }
            const auto surface = paths.surface(v).value();
            const Sphere& sphere = kSpheres.at(std::size_t(surface.mesh));
            EXPECT_NEAR(length(position - sphere.centre) / sphere.radius, 1, 1e-4);
            const Mesh& mesh = meshes->at(std::size_t(surface.mesh));
            const Triangle& triangle = mesh.triangles.at(std::size_t(surface.face));
            const Vec3f middle =
                (mesh.positions[triangle[0]] + mesh.positions[triangle[1]] + mesh.positions[triangle[2]]) / 3.f;
            EXPECT_LT(length(position - middle), 0.15f * sphere.radius) << "the face is the one that was hit";
            EXPECT_EQ(paths.emission(v), sphere.emission);
            throughput = throughput * sphere.albedo;
            lamps += surface.mesh == 3;
            ++hits;
            if (surface.mesh == 3) continue;
            EXPECT_EQ(std::get<Color>(*paths.last(*paths.find(Scope::vertex, "throughput").at(0), v)), throughput);
            const float pdf = std::get<float>(*paths.last(*paths.find(Scope::vertex, "PDF").at(0), v));
            EXPECT_GE(pdf, 0);
            EXPECT_LE(pdf, 0.31831f);
        }
        EXPECT_EQ(paths.estimate(path), sum);
    }
    EXPECT_GT(hits, 10000);
    EXPECT_GT(escapes, 1000);
    EXPECT_GT(lamps, 10);
}

TEST(ExampleInC, CollectsItsLayers) {
    Example example(EMCA_EXAMPLE);
    ASSERT_TRUE(example.connection);
    const client::RenderOptions options{.samplesPerPixel = 4, .layers = {"intersection density", "throughput"}};
    const auto render = example.connection->render(options);
    ASSERT_TRUE(render.ok()) << render.error().message;
    client::RenderOptions plain = options;
    plain.layers.clear();
    EXPECT_TRUE(sameBits(render->image.color, rendered(*example.connection, plain)));
    const auto trace =
        example.connection->traceRect({0, 0, kWidth, kHeight}, {.samplesPerPixel = 4, .columns = {"surface"}});
    ASSERT_TRUE(trace.ok());
    std::uint64_t hits = 0;
    for (Index v = 0; v < trace->paths.vertexCount(); ++v) hits += trace->paths.surface(v).has_value();
    const auto field = example.connection->surface(render->id);
    ASSERT_TRUE(field.ok()) << field.error().message;
    EXPECT_EQ(field->counts.points, hits);
    EXPECT_EQ(field->counts.invalid, 0u);
    const SurfaceLayerData& density = *field->find("intersection density");
    EXPECT_EQ(density.samples, hits);
    EXPECT_EQ(density.total, double(hits));
    const SurfaceLayerData& throughput = *field->find("throughput");
    EXPECT_EQ(throughput.samples, hits);
    // Nothing reaches the lamp but light that is at most all of it.
    bool any = false;
    const SurfaceMesh& lamp = field->meshes.at(3);
    for (std::uint32_t face = 0; face < lamp.faceCount; ++face)
        if (const float value = field->value(throughput, 3, face); !std::isnan(value)) {
            any = true;
            EXPECT_GT(value, 0);
            EXPECT_LE(value, 1);
        }
    EXPECT_TRUE(any);
}

TEST(ExampleInC, SeesItsLampInALightProbe) {
    Example example(EMCA_EXAMPLE);
    ASSERT_TRUE(example.connection);
    // Above the middle of the scene, beside the lamp: nothing stands in between.
    probe::LightProbeRequest request{
        .position = {0, 5, 8}, .normal = {}, .frame = probe::SphereFrame::around({0, 1, 0}, {0, 0, -1})};
    request.samplesPerPixel = 64;
    request.maximumDepth = 1;
    const auto bytes = example.connection->askTool(probe::kLightProbeTool, probe::encode(request));
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    const auto answer = probe::decodeProbe(*bytes);
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    const Image& image = answer->image;
    EXPECT_EQ(image.color(answer->map.pixelOf({0, 1, 0})), kSky);
    EXPECT_EQ(image.color(answer->map.pixelOf({0, -1, 0})), Color()) << "the ground shines not";
    EXPECT_EQ(image.color(answer->map.pixelOf({0, 0, -1})), kSpheres[3].emission);
    // The lamp is a sphere at a distance of 7 with a radius of 1, in front of the sky.
    double excess = 0;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            if (const Color c = image.color({x, y}); c.r > kSky.r)
                excess += (double(c.r) - double(kSky.r)) * answer->map.solidAngle(y);
    const double expected = 2 * 3.14159265358979 * (1 - std::sqrt(1 - 1 / 49.)) * (12 - double(kSky.r));
    EXPECT_NEAR(excess / expected, 1, 5e-3);
    const auto again = example.connection->askTool(probe::kLightProbeTool, probe::encode(request));
    ASSERT_TRUE(again.ok());
    const Image repeated = probe::decodeProbe(*again)->image;
    EXPECT_TRUE(sameBits(image, repeated)) << "whatever its threads do";
}

#ifdef EMCA_CLI
TEST(ExampleInC, PleasesTheDoctor) {
    const ServingProcess process({EMCA_EXAMPLE, "0"});
    const Outcome outcome = run({EMCA_CLI, "doctor", process.address(), "--spp", "2", "--pixels", "10", "--only",
                                 "handshake,info,meshes,camera,image,replay,sums,paths,values,surfaces,camera-rays,"
                                 "pixel-list,samples,layers,light-probe"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("0 warnings, 0 failed"), std::string::npos) << outcome.out;
}
#endif

TEST(ExampleInC, SaysWhyItDoesNotServe) {
    const ServingProcess first({EMCA_EXAMPLE, "0"});
    const Outcome second = run({EMCA_EXAMPLE, std::to_string(first.port())});
    EXPECT_EQ(second.exitCode, 4);
    EXPECT_NE(second.err.find(std::to_string(first.port())), std::string::npos) << second.err;
}

}  // namespace
}  // namespace emca::test
