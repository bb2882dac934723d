#include "surface_model.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QSignalSpy>
#include <QTest>

#include <random>

#include "base/theme.h"
#include "mesh_geometry.h"
#include "scene_test_data.h"
#include "surface_test_data.h"

namespace emca::explorer::testing {
namespace {

using analysis::ColorMap;
using analysis::ColorMapId;
using analysis::ValueRange;

struct SurfaceModelTest : ::testing::Test {
    SurfaceModelTest() { fillWall(dataset); }
    void show(const std::string& layer) {
        SurfaceStyle style = model.style();
        style.layer = layer;
        model.setStyle(style);
    }
    Theme theme;
    client::Dataset dataset;
    SurfaceModel model{dataset, theme};
};

TEST_F(SurfaceModelTest, WhatCameFirstIsShownUntilSomebodySwitchesItOff) {
    ASSERT_TRUE(model.shown());
    EXPECT_EQ(model.shown()->description.name, "depth");
    EXPECT_EQ(model.title(), "depth  [vertices]");
    show("");
    EXPECT_FALSE(model.shown());
    EXPECT_TRUE(model.colors().empty());
    dataset.setSurface(wallField());
    EXPECT_FALSE(model.shown()) << "a new render does not bring the colours back";
    dataset.setSurface(nullptr);
    EXPECT_FALSE(model.surface());
}

TEST_F(SurfaceModelTest, ColoursAreThoseOfTheAnalysis) {
    show("depth");
    model.setLimits(SurfaceLimits{1, 5});
    ASSERT_EQ(model.colors().size(), 5u);
    const ColorMap& map = ColorMap::get(ColorMapId::viridis);
    EXPECT_EQ(model.colors()[0], map.entries().front());
    EXPECT_EQ(model.colors()[2], map.map(0.5));
    EXPECT_EQ(model.colors()[4], map.entries().back());
    SurfaceStyle style = model.style();
    style.map = ColorMapId::inferno;
    model.setStyle(style);
    EXPECT_EQ(model.colors()[2], ColorMap::get(ColorMapId::inferno).map(0.5));
    style.layer = "hits";
    model.setStyle(style);
    EXPECT_FALSE(model.isRangeByHand()) << "a range belongs to its layer";
    style.layer = "depth";
    model.setStyle(style);
    EXPECT_EQ(model.range(), (ValueRange{1, 5, false}));
}

TEST_F(SurfaceModelTest, DensityRangesGoByWhereSomethingHappened) {
    show("hits");
    SurfaceStyle style = model.style();
    style.lower = 0;
    style.upper = 1;
    model.setStyle(style);
    EXPECT_EQ(model.range(), (ValueRange{10, 10000, false}));
    model.setLog(true);
    EXPECT_EQ(model.range(), (ValueRange{10, 10000, true}));
    EXPECT_EQ(model.colors()[2], ColorMap::get(ColorMapId::viridis).map(1.0 / 3));
    EXPECT_EQ(model.colors()[0], ColorMap::get(ColorMapId::viridis).entries().front()) << "nothing is below everything";
    style = model.style();
    style.upper = 0.4;   // faces 1 to 3 are 6 of the 14 square units that have values
    model.setStyle(style);
    EXPECT_EQ(model.range().max, 1000);
}

TEST_F(SurfaceModelTest, ColourLayersFollowExposure) {
    show("albedo");
    ASSERT_TRUE(model.isColor());
    const auto before = model.colors();
    analysis::ToneMap tones = theme.toneMap();
    EXPECT_EQ(before[4], analysis::ToneMapper(tones).color({0.4f, 0.2f, 0.1f}));
    SurfaceStyle style = model.style();
    style.exposure = 1;
    model.setStyle(style);
    EXPECT_EQ(model.colors()[1], analysis::ToneMapper(tones).color({0.2f, 0.4f, 0.2f}));
    tones.transfer = analysis::Transfer::linear;
    theme.setToneMap(tones);
    EXPECT_EQ(model.colors()[4].r, 204) << "0.4 twice as bright, on the curve of the image";
}

TEST_F(SurfaceModelTest, TheValueAtAPlaceIsThatOfTheField) {
    show("hits");
    // Corner of the first vertex: first child; centre of the face: the middle one; second face: undivided.
    const auto at = [&](std::uint32_t face, float u, float v) { return model.valueAt({0, face, u, v, 1, false}); };
    EXPECT_EQ(at(0, 0.05f, 0.05f)->channels[0], 0.f);
    EXPECT_EQ(at(0, 0.9f, 0.05f)->channels[0], 10.f);
    EXPECT_EQ(at(0, 0.3f, 0.35f)->channels[0], 1000.f);
    EXPECT_EQ(at(0, 0.3f, 0.35f)->refinedFace, 3u);
    EXPECT_EQ(at(1, 0.3f, 0.3f)->scalar, 10000.0);
    EXPECT_EQ(at(0, 0.05f, 0.9f)->points, 0.f) << "filled in";
    EXPECT_FALSE(model.valueAt({1, 0, 0.3f, 0.3f, 1, false})) << "a mesh without data";
    EXPECT_FALSE(model.valueAt({7, 0, 0.3f, 0.3f, 1, false}));
    EXPECT_FALSE(at(9, 0.3f, 0.3f));
    show("albedo");
    EXPECT_EQ(at(1, 0.3f, 0.3f)->channels[1], 0.2f);
    EXPECT_NEAR(at(1, 0.3f, 0.3f)->scalar, double(luminance(Color{0.4f, 0.2f, 0.1f})), 1e-7);
}

TEST_F(SurfaceModelTest, LayersOfAnotherSceneAreRefused) {
    auto field = std::make_shared<SurfaceField>(*wallField());
    field->meshes.pop_back();
    dataset.setSurface(field);
    EXPECT_FALSE(model.surface());
    EXPECT_FALSE(model.error().isEmpty());
    dataset.setSurface(wallField());
    EXPECT_TRUE(model.error().isEmpty());
}

TEST(SurfaceModel, LargeFieldsArePreparedBesideTheGuiThread) {
    Theme theme;
    client::Dataset dataset;
    const Mesh mesh = waves(400000);
    const auto faces = static_cast<std::uint32_t>(mesh.triangles.size());
    auto field = std::make_shared<SurfaceField>();
    field->meshes = {{{}, 0, faces}};
    std::vector<float> values(faces);
    for (std::uint32_t i = 0; i < faces; ++i) values[i] = float(i % 1000);
    field->layers.push_back({{"waves", LayerKind::mean, "", "a test"}, SharedArray<float>(std::move(values)), faces, 0});
    field->points = SharedArray<float>(std::vector<float>(faces, 1.f));
    SurfaceModel model(dataset, theme);
    QSignalSpy changed(&model, &SurfaceModel::surfaceChanged);
    dataset.setMeshes(std::make_shared<const std::vector<Mesh>>(std::vector<Mesh>{mesh}));
    dataset.setSurface(field);
    EXPECT_TRUE(model.isPreparing());
    EXPECT_FALSE(model.shown());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !model.isPreparing(); }, 60000));
    ASSERT_TRUE(model.shown());
    EXPECT_EQ(model.colors().size(), faces);
    EXPECT_NEAR(model.range().min, 10, 3);
    EXPECT_NEAR(model.range().max, 990, 3);
    dataset.setSurface(nullptr);
    EXPECT_FALSE(model.shown());
}

TEST(SurfaceData, TheStandInCoversTheWholeInRuns) {
    // One triangle divided ten times everywhere: 4^10 faces. Depth-first, so 1s down to the leaves at level 10.
    std::vector<std::uint8_t> bits;
    std::uint64_t next = 0;
    const auto put = [&](bool bit) {
        if (next % 8 == 0) bits.push_back(0);
        bits.back() = static_cast<std::uint8_t>(bits.back() | (bit ? 1u << (next % 8) : 0u));
        ++next;
    };
    const auto divide = [&](auto&& self, int level) -> void {
        put(level < 10);
        if (level < 10) for (int i = 0; i < 4; ++i) self(self, level + 1);
    };
    divide(divide, 0);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const std::uint32_t faces = 1u << 20;
    auto field = std::make_shared<SurfaceField>();
    field->meshes = {{{bits}, 0, faces}};
    field->layers.push_back({{"one", LayerKind::mean, "", ""}, SharedArray<float>(std::vector<float>(faces, 1.f)), faces, 0});
    field->points = SharedArray<float>(std::vector<float>(faces, 1.f));
    const auto prepared = prepareSurface(std::make_shared<const std::vector<Mesh>>(std::vector<Mesh>{mesh}), field, 0.01, 0.99);
    ASSERT_TRUE(prepared) << prepared.error().message;
    const PreparedSurface& s = **prepared;
    ASSERT_EQ(s.triangles.size(), faces);
    ASSERT_EQ(s.coarseTriangles.size(), 1u << 14) << "the finest that is coarse enough";
    EXPECT_EQ(s.coarseFirst.back(), faces);
    std::vector<analysis::Color8> colors(faces, {10, 20, 30});
    for (std::uint32_t f = 0; f < 32; ++f) colors[f] = {0, 20, 30};   // half of the first run of 64
    const auto coarse = coarseColors(s, colors);
    ASSERT_EQ(coarse.size(), s.coarseTriangles.size());
    EXPECT_EQ(coarse[0], (analysis::Color8{5, 20, 30}));
    EXPECT_EQ(coarse[1], (analysis::Color8{10, 20, 30}));
    // A coarse face lies where its run lies: the first refined corner is its first corner.
    for (const std::size_t i : {std::size_t(0), std::size_t(777), coarse.size() - 1}) {
        Vec3f sum;
        for (std::uint32_t f = s.coarseFirst[i]; f < s.coarseFirst[i + 1]; ++f)
            for (const std::uint32_t v : s.triangles[f]) sum += s.positions[v] / (3.f * 64);
        const Triangle& t = s.coarseTriangles[i];
        const Vec3f centre = (s.coarsePositions[t[0]] + s.coarsePositions[t[1]] + s.coarsePositions[t[2]]) / 3.f;
        EXPECT_LT(length(sum - centre), 1e-5f);
    }
}

TEST(SurfacePicker, HitsWhatBruteForceHits) {
    const auto meshes = std::make_shared<const std::vector<Mesh>>(roomMeshes());
    const SurfacePicker picker(meshes);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-0.9f, 0.9f), way(-1, 1);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3f origin{place(random), place(random), place(random)}, direction = normalize(Vec3f{way(random), way(random), way(random)});
        const auto expected = firstHit(*meshes, origin, direction);
        const auto hit = picker.pick({{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}}, BackFaces::show);
        ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->distance, double(*expected), 1e-4);
        const Mesh& mesh = (*meshes)[hit->mesh];
        const Triangle& t = mesh.triangles[hit->face];
        const Vec3f p = mesh.positions[t[0]] * (1 - hit->u - hit->v) + mesh.positions[t[1]] * hit->u + mesh.positions[t[2]] * hit->v;
        EXPECT_LT(length(p - (origin + direction * float(hit->distance))), 1e-4f);
    }
    EXPECT_GT(hits, 1500);
}

TEST(SurfacePicker, BackFacesCountAsTheyAreDrawn) {
    // Two walls one behind the other; the nearer one turns its back.
    Mesh near, far;
    near.positions = {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}};
    near.triangles = {{0, 2, 1}};
    far.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    far.triangles = {{0, 1, 2}};
    const SurfacePicker picker(std::make_shared<const std::vector<Mesh>>(std::vector<Mesh>{near, far}));
    const Ray ray{{0, 0, 5}, {0, 0, -1}};
    EXPECT_EQ(picker.pick(ray, BackFaces::show)->mesh, 0u);
    EXPECT_TRUE(picker.pick(ray, BackFaces::show)->back);
    EXPECT_EQ(picker.pick(ray, BackFaces::fade)->mesh, 1u);
    EXPECT_EQ(picker.pick(ray, BackFaces::hide)->mesh, 1u);
    const Ray behind{{0, 0, 0.5}, {0, 0, 1}};
    EXPECT_EQ(picker.pick(behind, BackFaces::show)->mesh, 0u) << "from inside it shows its front";
    const Ray away{{0, 0, -5}, {0, 0, 1}};
    EXPECT_EQ(picker.pick(away, BackFaces::fade)->mesh, 0u);
}

TEST(SurfacePicker, RaysOfPixelsAgreeWithTheProjection) {
    ViewPose pose;
    pose.position = {1, 2, 7};
    pose.focus = {0.5, 0, 0};
    pose.up = normalize(Vec3d{0, 1, 0} - pose.direction() * dot(pose.direction(), Vec3d{0, 1, 0}));
    for (const bool orthographic : {false, true}) {
        pose.orthographic = orthographic;
        const Projection projection(pose, {800, 500});
        for (const auto& [x, y] : {std::pair(400.0, 250.0), std::pair(10.0, 490.0), std::pair(799.0, 3.0)}) {
            const Ray ray = rayThrough(pose, {800, 500}, x, y);
            const auto seen = projection.project(ray.origin + ray.direction * 6.0);
            ASSERT_TRUE(seen);
            EXPECT_NEAR(seen->x, x, 1e-6);
            EXPECT_NEAR(seen->y, y, 1e-6);
        }
    }
}

}  // namespace
}  // namespace emca::explorer::testing
