// What the bridge makes of what it hears: heat maps on meshes, cameras, images, the film's value.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "bridge_renderer.h"
#include "command_line.h"
#include "emca/imageio/imageio.h"
#include "film.h"
#include "heat_map.h"
#include "published_for_tests.h"

namespace emca::bridge {
namespace {

using namespace test;

const std::vector<LayerDescription> kBoth{heatMapColors(), heatMapNumbers()};

Mesh meshOf(const PublishedShape& shape) { return Mesh{.positions = shape.positions, .triangles = shape.triangles}; }

TEST(PublishedHeatMap, TheDivisionThatTheServerMadeIsFoundAgain) {
    const Show show = exampleShow();
    const std::vector<Mesh> meshes{meshOf(show.scene.shapes[0])};
    const HeatMap map = heatMapOn(meshes, std::span(show.heatMap->shapes).first(1), kBoth);
    ASSERT_TRUE(validate(map.field, meshes).ok()) << validate(map.field, meshes).error().message;
    EXPECT_EQ(map.faces, 8u);
    EXPECT_EQ(map.without, 0u);
    ASSERT_EQ(map.field.faceCount(), 8u);

    // Each refined face has the colour of the published triangle in the same place.
    const auto refined = refine(meshes[0], map.field.meshes[0].subdivision);
    ASSERT_TRUE(refined.ok());
    const PublishedShape& sent = show.heatMap->shapes[0];
    const auto centre = [](const auto& positions, const Triangle& t) { return (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.f; };
    for (std::uint32_t face = 0; face < 8; ++face) {
        const Vec3f here = centre(refined->positions, refined->triangles[face]);
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < 8; ++i)
            if (length(centre(sent.positions, sent.triangles[i]) - here) < length(centre(sent.positions, sent.triangles[nearest]) - here)) nearest = i;
        ASSERT_LT(length(centre(sent.positions, sent.triangles[nearest]) - here), 1e-6f);
        const Color color = sent.faceColors[nearest];
        EXPECT_EQ(map.field.value(map.field.layers[0], 0, face, 0), color.r);
        EXPECT_EQ(map.field.value(map.field.layers[0], 0, face, 1), color.g);
        EXPECT_EQ(map.field.value(map.field.layers[0], 0, face, 2), color.b);
        EXPECT_EQ(map.field.value(map.field.layers[1], 0, face), color.r == color.g ? color.r : luminance(color));
    }
    EXPECT_EQ(map.field.layers[1].samples, 8u);
    EXPECT_EQ(map.field.counts.points, 8u);
}

/// Divides random triangles as published servers do: children behind all others, midpoints computed once.
PublishedShape divided(const Mesh& mesh, int divisions, std::mt19937& random) {
    PublishedShape shape;
    shape.positions = mesh.positions;
    shape.triangles = mesh.triangles;
    for (int i = 0; i < divisions; ++i) {
        const std::size_t face = random() % shape.triangles.size();
        const Triangle t = shape.triangles[face];
        const auto p = [&](std::size_t k) { return shape.positions[t[k % 3]]; };
        const auto first = static_cast<std::uint32_t>(shape.positions.size());
        for (std::size_t k = 0; k < 3; ++k) shape.positions.push_back({(p(k + 2).x + p(k + 1).x) * 0.5f, (p(k + 2).y + p(k + 1).y) * 0.5f, (p(k + 2).z + p(k + 1).z) * 0.5f});
        shape.triangles.erase(shape.triangles.begin() + static_cast<std::ptrdiff_t>(face));
        const std::uint32_t a = first, b = first + 1, c = first + 2;
        for (const Triangle& child : {Triangle{t[0], c, b}, Triangle{t[1], a, c}, Triangle{t[2], b, a}, Triangle{a, b, c}}) shape.triangles.push_back(child);
    }
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) shape.faceColors.emplace_back(float(i));
    return shape;
}

TEST(PublishedHeatMap, RandomDivisionsOfRandomMeshesLoseNoFaceAndNoValue) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(-10, 10);
    for (int round = 0; round < 20; ++round) {
        Mesh mesh;
        for (int i = 0; i < 12; ++i) mesh.positions.push_back({anywhere(random), anywhere(random), anywhere(random)});
        for (std::uint32_t i = 0; i + 2 < 12; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.triangles.push_back({0, 1, 2});   // one that lies in another
        mesh.triangles.push_back({3, 3, 4});   // one without area
        const PublishedShape shape = divided(mesh, 200, random);
        const HeatMap map = heatMapOn(std::span(&mesh, 1), std::span(&shape, 1), kBoth);
        ASSERT_TRUE(validate(map.field, std::span(&mesh, 1)).ok());
        EXPECT_EQ(map.without, 0u);
        ASSERT_EQ(map.field.faceCount(), shape.triangles.size());
        std::vector<float> values(map.field.layers[1].values.begin(), map.field.layers[1].values.end());
        std::sort(values.begin(), values.end());
        for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], float(i)) << "each exactly once";
    }
}

TEST(PublishedHeatMap, ATriangleThatItDoesNotHaveStaysWholeWithoutValue) {
    const Show show = exampleShow();
    std::vector<Mesh> meshes{meshOf(show.scene.shapes[0])};
    meshes[0].positions[3] = {-2, 1, 0};  // of the second triangle
    PublishedShape halfway = show.heatMap->shapes[0];
    halfway.triangles.pop_back();         // a leaf of the first one is gone
    halfway.faceColors.pop_back();
    const HeatMap map = heatMapOn(meshes, std::span(&halfway, 1), kBoth);
    ASSERT_TRUE(validate(map.field, meshes).ok()) << validate(map.field, meshes).error().message;
    EXPECT_EQ(map.without, 2u);
    ASSERT_EQ(map.field.faceCount(), 2u);
    for (const std::uint32_t face : {0u, 1u}) EXPECT_TRUE(std::isnan(map.field.value(map.field.layers[1], 0, face)));
    EXPECT_EQ(map.field.counts.points, 0u);

    const HeatMap none = heatMapOn(meshes, {}, kBoth);
    ASSERT_TRUE(validate(none.field, meshes).ok());
    EXPECT_EQ(none.field.faceCount(), 0u);
}

TEST(PublishedCameras, FieldOfViewUpAndClipPlanesBecomeThoseOfOurCamera) {
    EXPECT_FLOAT_EQ(verticalFieldOfView(90, 1), 90);
    EXPECT_FLOAT_EQ(verticalFieldOfView(90, 2), float(std::atan(0.5) * 360 / 3.14159265358979));
    const PublishedCamera leaning{{1, 2, 3}, {0, 0, -2}, {0, 3, 1}, 0.5f, 50, 60};
    const Camera camera = toCamera(leaning, false, 2);
    EXPECT_EQ(camera.direction, (Vec3f{0, 0, -1}));
    EXPECT_EQ(camera.up, (Vec3f{0, 1, 0}));
    EXPECT_EQ(camera.verticalFieldOfView, 60.f);
    EXPECT_EQ(camera.nearClip, 0.5f);
    EXPECT_NEAR(toCamera(leaning, true, 2).verticalFieldOfView, 32.2042f, 1e-3);

    // Nothing of this may reach a viewer as it is.
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const Camera mended = toCamera({{kNaN, 0, 0}, {0, 0, 0}, {0, 0, 1}, -1, kNaN, 400}, true, 1);
    EXPECT_TRUE(isFinite(mended.position));
    EXPECT_NEAR(length(mended.direction), 1, 1e-6);
    EXPECT_NEAR(dot(mended.direction, mended.up), 0, 1e-6);
    EXPECT_NEAR(length(mended.up), 1, 1e-6);
    EXPECT_EQ(mended.verticalFieldOfView, Camera().verticalFieldOfView);
    EXPECT_EQ(mended.farClip, Camera().farClip);
}

TEST(PublishedShapes, SpheresAreTrianglesOnTheSphereThatLookOutwards) {
    const Show show = exampleShow();
    const auto ball = toMesh(show.scene.shapes[1], 1);
    ASSERT_TRUE(ball.ok());
    EXPECT_EQ(ball->name, "sphere 1");
    EXPECT_EQ(ball->diffuse, Color(0.9f, 0.9f, 0.5f)) << "metals show their specular colour";
    for (const Vec3f& p : ball->positions) EXPECT_NEAR(length(p - Vec3f{0, 0, 2}), 0.5f, 1e-6);
    for (const Triangle& t : ball->triangles) {
        const Vec3f a = ball->positions[t[0]], b = ball->positions[t[1]], c = ball->positions[t[2]];
        EXPECT_GT(dot(cross(b - a, c - a), (a + b + c) / 3.f - Vec3f{0, 0, 2}), 0.f);
    }
    PublishedShape broken = show.scene.shapes[0];
    broken.triangles[1][2] = 9;
    EXPECT_EQ(toMesh(broken, 0).error().code, ErrorCode::rendererFailed);
}

TEST(PublishedImages, FoldersAreMappedAndWhatCannotBeReadSaysWhatToDo) {
    const std::vector<FolderMapping> maps{{"/data", "/mnt"}, {"/data/scenes/", "/other"}};
    EXPECT_EQ(localPath("/data/a.exr", maps), "/mnt/a.exr");
    EXPECT_EQ(localPath("/data/scenes/b/c.exr", maps), "/other/b/c.exr");
    EXPECT_EQ(localPath("/database/a.exr", maps), "/database/a.exr");
    EXPECT_EQ(localPath("/data", maps), "/mnt");
    const auto mapping = FolderMapping::parse("C:\\renders=/mnt/renders");
    ASSERT_TRUE(mapping.ok());
    EXPECT_EQ(mapping->from, "C:\\renders");
    for (const char* wrong : {"", "=", "a=", "=b", "ab"}) EXPECT_FALSE(FolderMapping::parse(wrong).ok()) << wrong;
    const auto missing = readPublishedImage("/data/not-there.exr", maps);
    ASSERT_FALSE(missing.ok());
    for (const char* word : {"/data/not-there.exr", "/mnt/not-there.exr", "--image-folder"}) EXPECT_NE(missing.error().message.find(word), std::string::npos) << missing.error().message;
}

TEST(PublishedFilm, HalvesRoundAsIeeeSays) {
    // Every number of 16 bits is itself; halfway between two neighbours the even one is taken.
    const auto decode = [](std::uint32_t bits) {
        const std::uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023;
        const double value = exponent == 0 ? std::ldexp(double(fraction), -24) : std::ldexp(1024.0 + fraction, int(exponent) - 25);
        return static_cast<float>(bits >> 15 ? -value : value);
    };
    for (std::uint32_t bits = 0; bits < 0x7bff; ++bits) {
        const float here = decode(bits), next = decode(bits + 1);
        ASSERT_EQ(roundedToHalf(here), here);
        ASSERT_EQ(roundedToHalf(decode(bits | 0x8000u)), -here);
        const float middle = 0.5f * (here + next);
        ASSERT_EQ(roundedToHalf(middle), bits % 2 == 0 ? here : next) << bits;
        ASSERT_EQ(roundedToHalf(std::nextafter(middle, here)), here);
        ASSERT_EQ(roundedToHalf(std::nextafter(middle, next)), next);
    }
    EXPECT_EQ(roundedToHalf(65519.f), 65504.f);
    EXPECT_EQ(roundedToHalf(-65520.f), -std::numeric_limits<float>::infinity());
    EXPECT_TRUE(std::isnan(roundedToHalf(std::nanf(""))));

    Image image(2, 1);
    image.setColor({0, 0}, {0.5f, 1024, std::nanf("")});
    EXPECT_TRUE(isHalf(image));
    image.setColor({1, 0}, {0.1f, 0, 0});
    EXPECT_FALSE(isHalf(image));
}

TEST(PublishedFilm, APixelIsTheMeanOfItsEstimatesOverTheSamplesAskedFor) {
    PublishedPixel pixel;
    pixel.paths.resize(3);
    pixel.paths[0].estimate = ColorA{1, 2, 3, 1};
    pixel.paths[2].estimate = ColorA{2, 0, 1, 0};
    EXPECT_EQ(pixelValue(pixel, 4, false), Color(0.75f, 0.5f, 1.f));
    pixel.paths[0].estimate = ColorA{0.1f, 0, 0, 1};
    pixel.paths[2].estimate.reset();
    EXPECT_EQ(pixelValue(pixel, 1, true).r, roundedToHalf(0.1f));
    EXPECT_EQ(pixelValue({}, 4, false), Color());
}

TEST(BridgeCommandLine, ReadsWhatItIsToldAndRefusesTheRestWithTwo) {
    const auto parse = [](std::vector<const char*> words) {
        words.insert(words.begin(), "emca-bridge");
        return parseCommandLine(int(words.size()), words.data());
    };
    const auto all = parse({"render-box:50013", "--serve", "0.0.0.0:7000", "--size", "640x480", "--image-folder", "/a=/b", "--image-folder", "/c=/d",
                            "--fov-axis", "horizontal", "--timeout", "1.5", "--allow-quit", "--quit-server"});
    ASSERT_TRUE(all.commandLine.has_value());
    EXPECT_EQ(all.commandLine->server.host, "render-box");
    EXPECT_EQ(all.commandLine->server.port, 50013);
    EXPECT_EQ(all.commandLine->serve, (adapter::ServeAddress{"0.0.0.0", 7000}));
    EXPECT_EQ(all.commandLine->bridge.width, 640u);
    EXPECT_EQ(all.commandLine->bridge.height, 480u);
    EXPECT_EQ(all.commandLine->bridge.folders.size(), 2u);
    EXPECT_EQ(all.commandLine->bridge.axis, FieldOfViewAxis::horizontal);
    EXPECT_EQ(all.commandLine->server.answerLimit.count(), 1500);
    EXPECT_TRUE(all.commandLine->server.quitAtEnd && all.commandLine->allowQuit);
    const auto plain = parse({"50013", "--serve", "0"});
    ASSERT_TRUE(plain.commandLine.has_value());
    EXPECT_EQ(plain.commandLine->server.host, "127.0.0.1");
    EXPECT_FALSE(plain.commandLine->server.quitAtEnd);
    for (const std::vector<const char*>& wrong : std::vector<std::vector<const char*>>{
             {}, {"50013"}, {"--serve", "0"}, {"50013", "--serve", "x"}, {"50013", "--serve", "0", "--size", "640"}, {"50013", "--serve", "0", "--size", "0x5"},
             {"50013", "--serve", "0", "--image-folder", "/a"}, {"50013", "--serve", "0", "--fov-axis", "diagonal"}, {"50013", "--serve", "0", "--timeout", "0"}}) {
        const auto parsed = parse(wrong);
        EXPECT_FALSE(parsed.commandLine.has_value());
        EXPECT_EQ(parsed.exitCode, 2);
    }
}

}  // namespace
}  // namespace emca::bridge
