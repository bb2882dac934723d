#include "emca/render/scene_loader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "testing/chi_square.h"
#include "testing/test_scenes.h"

namespace emca::render {
namespace {

bool says(const Scene& scene, const std::string& words) {
    return std::any_of(scene.diagnostics().begin(), scene.diagnostics().end(), [&](const Diagnostic& diagnostic) {
        EXPECT_GT(diagnostic.where.line, 0) << diagnostic.message;
        return diagnostic.message.find(words) != std::string::npos;
    });
}

const std::string kLitPlane = R"(<shape type="rectangle"><emitter type="area"/></shape>)";
const std::string kCamera = testing::spotCamera("0,0,3", "0,0,0");

TEST(SceneLoader, UnknownThingsAreNamedAndTheRestRenders) {
    const auto scene = testing::sceneFromText(
        kLitPlane + kCamera +
        "\n<emitter type=\"sunsky\"/>\n<shape type=\"hair\"/><shape type=\"obj\"><string name=\"filename\" value=\"gone.obj\"/></shape>"
        "<integrator type=\"bdpt\"/>");
    ASSERT_TRUE(scene);
    EXPECT_TRUE(says(*scene, "sunsky"));
    EXPECT_TRUE(says(*scene, "hair"));
    EXPECT_TRUE(says(*scene, "gone.obj"));
    EXPECT_TRUE(says(*scene, "bdpt"));
    EXPECT_EQ(scene->shapes().size(), 1u);
    EXPECT_EQ(testing::estimatePixel(*scene, testing::optionsWith(*scene, 4)).mean, Color(1.f));
}

TEST(SceneLoader, OtherSamplersAndFiltersAreReplacedAndThatIsSaid) {
    const auto scene = testing::sceneFromText(kLitPlane + R"(<sensor type="perspective"><sampler type="ldsampler">
        <integer name="sample_count" value="9"/></sampler><film type="hdrfilm"><rfilter type="mitchell"/></film></sensor>)");
    ASSERT_TRUE(scene);
    EXPECT_TRUE(says(*scene, "ldsampler"));
    EXPECT_TRUE(says(*scene, "mitchell"));
    EXPECT_EQ(scene->sampler(), SamplerKind::sobol);
    EXPECT_EQ(scene->filter().kind(), FilterKind::gaussian);
    EXPECT_EQ(scene->samplesPerPixel(), 9u);
    EXPECT_EQ(scene->width(), 768u);
    EXPECT_EQ(scene->height(), 576u);
}

TEST(SceneLoader, EmptySceneIsBlackAndSaysWhy) {
    const auto scene = testing::sceneFromText(kCamera);
    ASSERT_TRUE(scene);
    EXPECT_TRUE(says(*scene, "no light"));
    EXPECT_EQ(testing::estimatePixel(*scene, testing::optionsWith(*scene, 4)).mean, Color(0.f));
}

TEST(SceneLoader, ASceneWithoutSensorIsSeenWhole) {
    const auto document = readSceneText("<scene version=\"3.0.0\">" + kLitPlane + "</scene>", "test.xml");
    SceneOptions options;
    options.width = 16;
    options.height = 16;
    const auto scene = buildScene(*document, "plane", options);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(says(**scene, "no sensor"));
    const auto image = ImageRenderer(*scene, 1).renderImage(testing::optionsWith(**scene, 16));
    EXPECT_GT(image->color.color({8, 8}).r, 0.9f);
    EXPECT_EQ(image->color.color({0, 0}).r, 0.f);
}

TEST(SceneLoader, ImageSizesHaveLimits) {
    const auto document = readSceneText("<scene version=\"3.0.0\">" + kLitPlane + kCamera + "</scene>", "test.xml");
    SceneOptions options;
    options.width = 65537;
    EXPECT_EQ(buildScene(*document, "test", options).error().code, ErrorCode::tooLarge);
    options.width = options.height = 65536;
    EXPECT_EQ(buildScene(*document, "test", options).error().code, ErrorCode::tooLarge);
    options.width = options.height = 2;
    EXPECT_EQ((*buildScene(*document, "test", options))->width(), 2u);
}

TEST(SceneLoader, MeshesForTheExplorerMatchTheHits) {
    const auto scene = testing::sceneFromText(kCamera +
        R"(<shape type="sphere" id="ball"><point name="center" x="0.2" y="0.1" z="-0.4"/></shape>
        <shape type="cube" id="box"><transform name="to_world"><translate x="3"/></transform></shape>
        <shape type="disk" id="plate"><transform name="to_world"><translate x="-3"/></transform>
        <emitter type="area"><rgb name="radiance" value="4,5,6"/></emitter></shape>)");
    ASSERT_TRUE(scene);
    const auto meshes = scene->meshes();
    ASSERT_EQ(meshes.size(), 3u);
    EXPECT_EQ(meshes[0].name, "ball");
    EXPECT_EQ(meshes[2].emission, (Color{4, 5, 6}));
    for (const auto& mesh : meshes) EXPECT_TRUE(validate(mesh).ok());
    testing::TestRandom random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3f origin{8 * random.next() - 4, 3 * random.next() - 1.5f, 4};
        const Ray ray{origin, normalize(Vec3f{random.next() - 0.5f, random.next() - 0.5f, -3})};
        SurfaceInteraction at;
        if (!scene->intersect(ray, at)) continue;
        ++hits;
        const emca::Mesh& mesh = meshes.at(static_cast<std::size_t>(at.mesh));
        const Triangle& t = mesh.triangles.at(static_cast<std::size_t>(at.face));
        const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        // On the triangle, or as close as a tessellation is to its sphere or disk.
        EXPECT_NEAR(dot(normalize(cross(b - a, c - a)), at.position - a), 0, 0.02) << mesh.name;
        EXPECT_LT(length(at.position - (a + b + c) / 3.f), 2.4f) << mesh.name;
        EXPECT_GT(dot(cross(b - a, c - a), at.geometricNormal), 0) << mesh.name;
        EXPECT_LT(dot(at.geometricNormal, ray.direction), 0) << mesh.name << ": seen from outside";
        EXPECT_NEAR(length(at.position - ray.at(at.distance)), 0, 1e-5) << mesh.name;
    }
    EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace emca::render
