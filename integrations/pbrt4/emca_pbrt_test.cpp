#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "emca/core/replay.h"
#include "emca/recorder/recorder.h"
#include "pbrt_renderer.h"

namespace emca::pbrt4 {
namespace {

class Unwatched final : public RequestMonitor {
  public:
    bool cancelled() const override { return false; }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
};

/// pbrt can be started once in a process: all tests share the room.
PbrtRenderer& room() {
    static const std::unique_ptr<PbrtRenderer> renderer = [] {
        auto scene = LoadedScene::load({.files = {EMCA_SOURCE_DIR "/integrations/pbrt4/scenes/room.pbrt"},
                                        .threads = 2,
                                        .integrator = "emcapath"});
        if (!scene) throw std::runtime_error(scene.error().message);
        auto made = PbrtRenderer::make(std::move(*scene), {.sceneName = "room", .samplesPerPixel = 2, .threads = 2});
        if (!made) throw std::runtime_error(made.error().message);
        return std::move(*made);
    }();
    return *renderer;
}

RenderSettings with(std::string integrator, std::string sampler = "") {
    return {.samplesPerPixel = 2, .integrator = std::move(integrator), .sampler = std::move(sampler)};
}

Image rendered(const RenderSettings& settings) {
    Unwatched monitor;
    auto image = room().renderImage(settings, monitor);
    EXPECT_TRUE(image.ok()) << image.error().message;
    return image->color;
}

std::size_t differentValues(const Image& a, const Image& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        different += std::bit_cast<std::uint32_t>(a.data()[i]) != std::bit_cast<std::uint32_t>(b.data()[i]);
    return different;
}

PathSet traced(Pixel pixel, const RenderSettings& settings, Color& value) {
    Recording recording({.pixels = {pixel}});
    {
        const RecordScope scope(recording, pixel);
        Unwatched monitor;
        const auto color = room().renderPixel(pixel, settings, recording, monitor);
        EXPECT_TRUE(color.ok()) << color.error().message;
        value = *color;
    }
    return *recording.finish();
}

TEST(EmcaPath, IsPbrtsPathIntegratorInEveryBit) {
    for (const char* sampler : {"halton", "independent", "zsobol"}) {
        EXPECT_EQ(differentValues(rendered(with("path", sampler)), rendered(with("emcapath", sampler))), 0u) << sampler;
    }
}

TEST(Replay, IsExactForEveryIntegratorWhileEverythingIsRecorded) {
    std::mt19937 random(1);
    for (const char* integrator : {"emcapath", "path", "simplepath", "volpath", "randomwalk", "ambientocclusion"}) {
        const Image image = rendered(with(integrator));
        for (int i = 0; i < 20; ++i) {
            const Pixel pixel{static_cast<std::uint32_t>(random() % image.width()),
                              static_cast<std::uint32_t>(random() % image.height())};
            Color value;
            const PathSet paths = traced(pixel, with(integrator), value);
            EXPECT_EQ(compare(image.color(pixel), value), Verdict::exact) << integrator;
            EXPECT_EQ(paths.pathCount(), 2u) << integrator;
        }
    }
}

TEST(Layers, ChangeNoBitOfTheImage) {
    const auto meshes = room().meshes();
    SurfaceRecorder surface(meshes);
    for (const LayerDescription& layer : room().surfaceLayers()) ASSERT_TRUE(surface.addLayer(layer).ok());
    Unwatched monitor;
    const auto image = room().renderImageWithLayers(with("emcapath"), surface, monitor);
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(differentValues(image->color, rendered(with("emcapath"))), 0u);
    const SurfaceField field = surface.finish();
    EXPECT_GT(field.counts.points, 60'000u);  // at least one for most of the camera's rays
    EXPECT_EQ(field.counts.invalid, 0u);
}

/// Distance of a point from the plane of a triangle, and from its bounding box.
float apart(const Mesh& mesh, std::int32_t face, Vec3f p) {
    const Triangle& t = mesh.triangles.at(std::size_t(face));
    BoundingBox box;
    for (const std::uint32_t corner : t) box.extend(mesh.positions.at(corner));
    float distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        distance = std::max({distance, box.min[axis] - p[axis], p[axis] - box.max[axis]});
    }
    return distance;
}

TEST(Surfaces, EveryVertexLiesOnTheTriangleThatItNames) {
    const auto meshes = room().meshes();
    for (const char* integrator : {"emcapath", "path"}) {
        std::vector<bool> seen(meshes.size());
        for (std::uint32_t y = 3; y < 150; y += 8) {
            for (std::uint32_t x = 3; x < 200; x += 8) {
                Color value;
                const PathSet paths = traced({x, y}, with(integrator), value);
                const PathColumns& columns = paths.columns();
                for (std::size_t v = 0; v < columns.vertexFlags.size(); ++v) {
                    if (!(columns.vertexFlags[v] & VertexFlag::hasSurface)) continue;
                    const auto mesh = std::size_t(columns.meshes[v]);
                    ASSERT_LT(mesh, meshes.size());
                    // Curved shapes bulge over their triangles by less than that.
                    ASSERT_LT(apart(meshes[mesh], columns.faces[v], columns.positions[v]), 0.006f) << meshes[mesh].name;
                    seen[mesh] = true;
                }
            }
        }
        // Floor, two walls, lamp, ball, bent patch, and block, cylinder and disk of two instances.
        EXPECT_THAT(seen, testing::Each(true)) << integrator;
        EXPECT_EQ(seen.size(), 12u);
    }
}

TEST(Patches, ParametersAreFoundAgain) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-0.3f, 0.3f), unit(0.f, 1.f);
    for (int i = 0; i < 1000; ++i) {
        const auto corner = [&](float x, float y) {
            return pbrt::Point3f(x + number(random), y + number(random), number(random));
        };
        const PatchCorners patch{corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
        const Vec2f uv{unit(random), unit(random)}, found = patch.parameterOf(patch.at(uv));
        EXPECT_NEAR(found.x, uv.x, 1e-3f);
        EXPECT_NEAR(found.y, uv.y, 1e-3f);
    }
}

TEST(Requests, ThatPbrtWouldEndTheProcessForAreRefused) {
    Unwatched monitor;
    for (const RenderSettings& settings :
         {with("bdpt"), with("no such integrator"), with("simplevolpath"), with("path", "no such sampler"),
          RenderSettings{.samplesPerPixel = 3, .sampler = "zsobol"}, RenderSettings{.samplesPerPixel = ~0u}}) {
        const auto image = room().renderImage(settings, monitor);
        ASSERT_FALSE(image.ok());
        EXPECT_FALSE(image.error().message.empty());
    }
    EXPECT_EQ(rendered(with("emcapath")).width(), 200u);
}

}  // namespace
}  // namespace emca::pbrt4
