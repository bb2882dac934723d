#include "emca/render/surface_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "emca/recorder/recording.h"
#include "testing/test_scenes.h"

namespace emca::render {
namespace {

/// Light by area lights of both kinds, by a point and from outside; a mask, glass, gloss, and walls that absorb.
std::shared_ptr<const Scene> busyScene() {
    return testing::sceneFromText(
        R"(<integrator type="path"><integer name="rr_depth" value="3"/></integrator>
        <sensor type="perspective"><float name="fov" value="60"/>
        <transform name="to_world"><lookat origin="0,-3,0.5" target="0,0,0" up="0,0,1"/></transform>
        <film type="hdrfilm"><integer name="width" value="19"/><integer name="height" value="13"/><rfilter type="box"/></film>
        <sampler type="independent"><integer name="sample_count" value="8"/></sampler></sensor>
        <shape type="cube"><transform name="to_world"><scale x="4" y="4" z="0.1"/><translate z="-1.3"/></transform>)" +
        testing::diffuse("0.7,0.5,0") + R"(</shape>
        <shape type="sphere"><point name="center" x="-0.8" y="0" z="0"/><float name="radius" value="0.7"/><bsdf type="dielectric"/></shape>
        <shape type="disk"><transform name="to_world"><translate z="-1"/></transform><bsdf type="roughconductor"><float name="alpha" value="0.5"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><translate x="1"/></transform>
        <bsdf type="mask"><float name="opacity" value="0.4"/>)" + testing::diffuse("0.2,0.6,0.2") + R"(</bsdf></shape>
        <shape type="sphere" id="ball"><point name="center" x="1" y="-1" z="2"/><float name="radius" value="0.3"/>
        <emitter type="area"><rgb name="radiance" value="9,8,7"/></emitter></shape>
        <shape type="rectangle" id="panel"><transform name="to_world"><rotate x="1" angle="180"/><scale value="0.5"/><translate z="3"/></transform>
        <emitter type="area"><rgb name="radiance" value="5,6,7"/></emitter></shape>
        <emitter type="constant"><rgb name="radiance" value="0.3,0.4,0.5"/></emitter>
        <emitter type="point"><point name="position" x="0" y="-2" z="3"/><rgb name="intensity" value="2"/></emitter>)");
}

SurfaceField collect(const std::shared_ptr<const Scene>& scene, const RenderOptions& options, int threads,
                     Image* color = nullptr) {
    const std::vector<Mesh> meshes = scene->meshes();
    SurfaceRecorder recorder(meshes);
    for (const LayerDescription& layer : pathLayers()) EXPECT_TRUE(recorder.addLayer(layer).ok());
    const auto image = ImageRenderer(scene, threads).renderImage(options, {}, &recorder);
    EXPECT_TRUE(image.ok());
    if (color && image) *color = image->color;
    return recorder.finish();
}

PathSet record(const std::shared_ptr<const Scene>& scene, const RenderOptions& options) {
    Recording recording;
    const ImageRenderer renderer(scene, 1);
    for (std::uint32_t y = 0; y < scene->height(); ++y) {
        for (std::uint32_t x = 0; x < scene->width(); ++x) {
            const RecordScope scope(recording, {x, y});
            EXPECT_TRUE(renderer.renderPixel({x, y}, options).ok());
        }
    }
    auto finished = recording.finish();
    EXPECT_TRUE(finished.ok());
    return finished ? *finished : PathSet();
}

const SurfaceLayerData& layer(const SurfaceField& field, const char* name) {
    const SurfaceLayerData* found = field.find(name);
    EXPECT_NE(found, nullptr) << name;
    static const SurfaceLayerData none;
    return found ? *found : none;
}

class SurfaceLayersTest : public ::testing::TestWithParam<SamplerKind> {
  protected:
    std::shared_ptr<const Scene> scene = busyScene();
    RenderOptions options = testing::optionsWith(*scene, 64, GetParam());
};

TEST_P(SurfaceLayersTest, ImagesAreBitEqualWithAndWithoutLayers) {
    const auto plain = ImageRenderer(scene, 1).renderImage(options);
    ASSERT_TRUE(plain.ok());
    for (const int threads : {1, 2}) {
        Image color;
        const SurfaceField field = collect(scene, options, threads, &color);
        EXPECT_GT(field.counts.points, 5000u);
        ASSERT_EQ(color.size(), plain->color.size());
        EXPECT_EQ(std::memcmp(color.data(), plain->color.data(), color.size() * sizeof(float)), 0);
    }
}

/// What the recorded paths of the whole image say about each layer, path by path.
struct Expected {
    std::uint64_t intersections = 0, areaLightSamples = 0, roulette = 0, absorbed = 0;
    double throughput = 0, depth = 0, contribution = 0;
};

Expected fromRecording(const PathSet& paths) {
    Expected sum;
    const auto column = [&](Scope scope, const char* name) {
        const auto found = paths.find(scope, name);
        EXPECT_EQ(found.size(), 1u) << name;
        return found.front();
    };
    const Column *throughput = column(Scope::vertex, "throughput"), *end = column(Scope::path, "end"),
                 *light = column(Scope::vertex, "light pdf");
    for (Index path = 0; path < paths.pathCount(); ++path) {
        const auto how = std::get<std::string>(*paths.last(*end, path));
        sum.roulette += how == "Russian roulette";
        sum.absorbed += how == "absorbed";
        Color after(0.f);  // light that the path found behind the vertex, camera-weighted
        const IndexRange vertices = paths.vertices(path);
        for (Index v = vertices.last; v-- > vertices.first;) {
            Color hit(0.f);
            const IndexRange contributions = paths.contributions(v);
            for (Index c = contributions.first; c < contributions.last; ++c) {
                const Contribution& contribution = paths.contribution(c);
                (contribution.end == LightEnd::hit ? hit : after) += contribution.value;
            }
            if (!paths.isEnvironment(v)) {
                ++sum.intersections;
                sum.throughput += double(luminance(std::get<Color>(*paths.last(*throughput, v))));
                sum.depth += paths.depth(path);
                sum.contribution += double(luminance(after));
                sum.areaLightSamples += !light->valuesOf(v).empty();
            }
            after += hit;
        }
    }
    return sum;
}

TEST_P(SurfaceLayersTest, LayersHoldWhatTheRecordedPathsSay) {
    const SurfaceField field = collect(scene, options, 2);
    const Expected expected = fromRecording(record(scene, options));
    EXPECT_EQ(layer(field, "intersection density").samples, expected.intersections);
    EXPECT_EQ(layer(field, "throughput").samples, expected.intersections);
    EXPECT_EQ(layer(field, "path depth").samples, expected.intersections);
    EXPECT_EQ(layer(field, "reflected radiance").samples, expected.intersections);
    EXPECT_EQ(layer(field, "image contribution").samples, expected.intersections);
    EXPECT_EQ(layer(field, "invalid directions").samples, expected.absorbed);
    EXPECT_EQ(layer(field, "Russian roulette").samples, expected.roulette);
    EXPECT_GT(expected.roulette, 100u);
    EXPECT_GT(expected.absorbed, 20u);
    EXPECT_NEAR(layer(field, "throughput").total, expected.throughput, 1e-5 * expected.throughput);
    EXPECT_NEAR(layer(field, "path depth").total, expected.depth, 1e-5 * expected.depth);
    EXPECT_NEAR(layer(field, "image contribution").total, expected.contribution, 1e-4 * expected.contribution);
    EXPECT_EQ(field.counts.invalid, 0u);
}

TEST_P(SurfaceLayersTest, NextEventsLieOnTheLights) {
    const SurfaceField field = collect(scene, options, 1);
    const SurfaceLayerData& density = layer(field, "next-event density");
    ASSERT_GT(density.samples, 1000u);
    for (std::size_t mesh = 0; mesh < field.meshes.size(); ++mesh) {
        const bool emits = scene->shapes()[mesh]->emitter != nullptr;
        double sum = 0;
        for (std::uint32_t face = 0; face < field.meshes[mesh].faceCount; ++face)
            sum += double(field.value(density, mesh, face));
        EXPECT_EQ(sum > 0, emits) << scene->shapes()[mesh]->name;
    }
}

INSTANTIATE_TEST_SUITE_P(Samplers, SurfaceLayersTest, ::testing::Values(SamplerKind::independent, SamplerKind::sobol),
                         [](const auto& sampler) { return std::string(name(sampler.param)); });

TEST(SurfaceLayersOnAnalyticShapes, PointsAreLocatedOnTheFaceBelowThem) {
    const auto scene = busyScene();
    for (const auto& shape : scene->shapes()) {
        if (shape->placeAt({0, 0, 0}).face < 0) continue;
        const Mesh mesh = shape->displayMesh();
        for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
            const Triangle t = mesh.triangles[face];
            const Vec3f middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.f / 3);
            EXPECT_EQ(shape->placeAt(middle).face, static_cast<std::int32_t>(face)) << shape->name;
        }
    }
}

/// A camera that looks straight at a plane covers it evenly. So must the density be, although an image is rendered tile by
/// tile: what a face had before it was divided must not have come from one corner of it.
TEST(SurfaceLayersTruth, DensityDoesNotShowTheOrderOfTiles) {
    const auto scene = testing::sceneFromText(
        R"(<integrator type="path"><integer name="max_depth" value="1"/></integrator>
        <sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0,0,2.5" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="96"/><integer name="height" value="96"/><rfilter type="box"/></film>
        <sampler type="independent"><integer name="sample_count" value="64"/></sampler></sensor>
        <shape type="rectangle"/>)");
    const SurfaceField field = collect(scene, testing::optionsWith(*scene, 64), 2);
    const SurfaceLayerData& density = layer(field, "intersection density");
    ASSERT_GT(density.samples, 96u * 96u * 50u);
    const std::vector<Mesh> meshes = scene->meshes();
    const auto refined = refine(meshes[0], field.meshes[0].subdivision);
    ASSERT_TRUE(refined.ok());
    const float seen = 2.5f * std::tan(20.f * 3.14159265f / 180);  // half of what the camera sees of the plane
    double squares = 0, faces = 0, points = 0;
    for (std::uint32_t face = 0; face < field.meshes[0].faceCount; ++face) {
        const Triangle t = refined->triangles[face];
        bool inside = true;
        for (const std::uint32_t v : t) {
            const Vec3f p = refined->positions[v];
            inside &= std::abs(p.x) < 0.95f * seen && std::abs(p.y) < 0.95f * seen;
        }
        if (!inside) continue;
        const double expected = double(density.samples) / (4 * double(seen) * double(seen));
        const double off = double(field.value(density, 0, face)) / expected - 1;
        squares += off * off, ++faces, points += double(field.points[face]);
    }
    ASSERT_GT(faces, 500);
    // As if every face had counted its points alone: noise of one over the root of their number.
    EXPECT_LT(std::sqrt(squares / faces), 1.15 / std::sqrt(points / faces));
}

/// Mean reflected radiance on a diffuse wall is what a camera that looks at the wall sees.
TEST(SurfaceLayersTruth, ReflectedRadianceIsWhatACameraSees) {
    const auto scene = loadScene(std::string(EMCA_SOURCE_DIR) + "/scenes/cornell-box/scene.xml", {{}, 128, 128});
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    RenderOptions options = testing::optionsWith(**scene, 64);
    options.integrator.maximumDepth = -1;
    options.integrator.rouletteDepth = 5;
    const SurfaceField field = collect(*scene, options, 2);
    const SurfaceLayerData& reflected = layer(field, "reflected radiance");

    const std::vector<Mesh> meshes = (*scene)->meshes();
    std::size_t wall = meshes.size();
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (meshes[i].name == "back") wall = i;
    ASSERT_LT(wall, meshes.size());
    const auto locator = SurfaceLocator::make(meshes[wall].triangles.size(), field.meshes[wall].subdivision);
    ASSERT_TRUE(locator.ok());

    const PathIntegrator integrator(**scene, options.integrator);
    Sampler sampler(SamplerKind::independent, 77);
    PathRecorder& emca = emca::recorder();
    Color seen(0.f), collected(0.f);
    std::uint32_t places = 0;
    constexpr std::uint32_t kRays = 64;
    for (std::uint32_t face = 0; face < meshes[wall].triangles.size(); ++face) {
        const Triangle t = meshes[wall].triangles[face];
        const Vec3f a = meshes[wall].positions[t[0]], b = meshes[wall].positions[t[1]], c = meshes[wall].positions[t[2]];
        const Vec3f normal = normalize(cross(b - a, c - a));
        for (int i = 0; i < 20; ++i) {
            for (int j = 0; i + j < 20; ++j) {
                const float u = (static_cast<float>(i) + 0.3f) / 20.5f, v = (static_cast<float>(j) + 0.3f) / 20.5f;
                const Vec3f p = a + (b - a) * u + (c - a) * v;
                const auto refined = locator->refinedFace(face, u, v);
                ASSERT_TRUE(refined.has_value());
                Color mean(0.f);
                for (std::uint32_t k = 0; k < kRays; ++k) {
                    sampler.start({places, face}, k);
                    mean += integrator.radiance({p + normal * 0.01f, -normal}, sampler, emca) * (1.f / kRays);
                }
                seen += mean;
                collected += Color{field.value(reflected, wall, *refined, 0), field.value(reflected, wall, *refined, 1),
                                   field.value(reflected, wall, *refined, 2)};
                ++places;
            }
        }
    }
    ASSERT_GT(places, 300u);
    // Both means are over the same places; 1 % is three standard errors of either.
    EXPECT_NEAR(collected.r / seen.r, 1.f, 0.015f);
    EXPECT_NEAR(collected.g / seen.g, 1.f, 0.015f);
    EXPECT_NEAR(collected.b / seen.b, 1.f, 0.02f);
}

}  // namespace
}  // namespace emca::render
