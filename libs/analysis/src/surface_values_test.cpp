#include "emca/analysis/surface_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace emca::analysis {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A square of area 4 as two triangles, the first divided once and its second part once more; a mesh without values; and
/// a triangle without area.
struct Scene {
    Scene() : meshes(3) {
        meshes[0].positions = {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
        meshes[0].triangles = {{0, 1, 2}, {0, 2, 3}};
        meshes[1].positions = meshes[0].positions;
        meshes[1].triangles = {{0, 1, 2}};
        meshes[2].positions = {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}};
        meshes[2].triangles = {{0, 1, 2}};
        field.meshes = {{{{0b00000101, 0}}, 0, 8}, {{}, 8, 0}, {{}, 8, 1}};  // 1 0 1 0000 00 0
    }
    std::vector<Mesh> meshes;
    SurfaceField field;
};

TEST(SurfaceValues, AreasAreThoseOfTheRefinedTriangles) {
    Scene scene;
    scene.field.points = std::vector<float>(9);
    ASSERT_TRUE(validate(scene.field, scene.meshes).ok()) << validate(scene.field, scene.meshes).error().message;
    const auto areas = surfaceAreas(scene.field, scene.meshes);
    ASSERT_EQ(areas.size(), 9u);
    const auto refined = refine(scene.meshes[0], scene.field.meshes[0].subdivision);
    ASSERT_TRUE(refined.ok());
    for (std::size_t f = 0; f < refined->triangles.size(); ++f) {
        const Triangle& t = refined->triangles[f];
        const auto& p = refined->positions;
        EXPECT_FLOAT_EQ(areas[f], length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2) << f;
    }
    EXPECT_FLOAT_EQ(std::accumulate(areas.begin(), areas.end(), 0.f), 4);
    EXPECT_EQ(areas[8], 0.f);
}

TEST(SurfaceValues, AreasOfMeshesThatAreNotSane) {
    std::vector<Mesh> meshes(1);
    meshes[0].positions = {{0, 0, 0}, {kNaN, 0, 0}, {0, 1, 0}};
    meshes[0].triangles = {{0, 1, 2}, {0, 2, 7}};
    SurfaceField field;
    field.meshes = {{{}, 0, 2}};
    EXPECT_EQ(surfaceAreas(field, meshes), (std::vector<float>{0, 0}));
}

TEST(SurfaceValues, StatisticsAreOverTheSurfaceNotOverFaces) {
    // Half of the surface is 1, half is 3; the half with 3 is divided finely.
    const std::vector<float> values{1, 3, 3, 3, 3, kNaN, INFINITY}, areas{2, 0.5f, 0.5f, 0.5f, 0.5f, 100, 100};
    const SurfaceStatistics s = surfaceStatistics(values, areas);
    EXPECT_EQ(s.faces, 7u);
    EXPECT_EQ(s.finite, 5u);
    EXPECT_DOUBLE_EQ(s.area, 4);
    EXPECT_DOUBLE_EQ(s.mean, 2);
    EXPECT_DOUBLE_EQ(s.deviation, 1);
    EXPECT_DOUBLE_EQ(s.integral, 8);
    EXPECT_EQ(s.min, 1);
    EXPECT_EQ(s.max, 3);
}

TEST(SurfaceValues, StatisticsSurviveALargeMeanAndNothingAtAll) {
    std::vector<float> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1e6f + (i % 2 ? 1.f : -1.f);
    const auto s = surfaceStatistics(values, std::vector<float>(values.size(), 0.25f));
    EXPECT_NEAR(s.mean, 1e6, 1e-6);
    EXPECT_NEAR(s.deviation, 1, 1e-9);
    const auto none = surfaceStatistics({}, {});
    EXPECT_EQ(none.finite, 0u);
    EXPECT_EQ(none.mean, 0);
    const auto flat = surfaceStatistics(std::vector<float>{5}, std::vector<float>{0});
    EXPECT_EQ(flat.max, 5) << "a face without area has a value, but no weight";
    EXPECT_EQ(flat.mean, 0);
}

TEST(SurfaceValues, RangeDoesNotDependOnTheSubdivision) {
    // 0 … 99 on equal areas; then each of the upper half four times on a quarter of its area.
    std::vector<float> values, areas, dividedValues, dividedAreas;
    for (int i = 0; i < 100; ++i) {
        values.push_back(static_cast<float>(i));
        areas.push_back(1);
        for (int part = 0; part < (i < 50 ? 1 : 4); ++part) {
            dividedValues.push_back(static_cast<float>(i));
            dividedAreas.push_back(i < 50 ? 1.f : 0.25f);
        }
    }
    SurfaceRangeOptions options;
    options.lower = 0.1;
    options.upper = 0.9;
    const ValueRange range = surfaceRange(values, areas, options);
    EXPECT_EQ(range.min, 9);
    EXPECT_EQ(range.max, 89);
    EXPECT_EQ(surfaceRange(dividedValues, dividedAreas, options), range);
}

TEST(SurfaceValues, RangeLeavesOutASpikeAndWhatIsNoNumber) {
    std::vector<float> values(1000, 1.f), areas(1000, 1.f);
    for (std::size_t i = 0; i < 500; ++i) values[i] = 2;
    values[0] = 1e30f;
    values[1] = kNaN;
    values[2] = INFINITY;
    EXPECT_EQ(surfaceRange(values, areas), (ValueRange{1, 2, false}));
}

TEST(SurfaceValues, WhereNothingHappenedNeedNotCount) {
    // A density on one face of a hundred: by all of the area its range would be that of nothing.
    std::vector<float> values(1000, 0.f);
    for (int i = 0; i < 5; ++i) values[static_cast<std::size_t>(i)] = float(i + 1);
    SurfaceRangeOptions options;
    EXPECT_LT(surfaceRange(values, {}, options).max, 1.5);
    options.zeros = false;
    EXPECT_EQ(surfaceRange(values, {}, options), (ValueRange{1, 5, false}));
    EXPECT_TRUE(surfaceRange(std::vector<float>(10, 0.f), {}, options).isValid());
}

TEST(SurfaceValues, RangeIsAlwaysValid) {
    const std::vector<std::vector<float>> cases{{}, {kNaN}, {0, 0}, {-5}, {INFINITY}, {0, 1e-30f}, {-1, -2}, {3, 3, 3}};
    for (const auto& values : cases) {
        for (const bool log : {false, true}) {
            SurfaceRangeOptions options;
            options.log = log;
            EXPECT_TRUE(surfaceRange(values, {}, options).isValid());
            EXPECT_TRUE(surfaceRange(values, std::vector<float>(values.size(), 0.f), options).isValid());
            EXPECT_EQ(surfaceRange(values, {}, options).log, log);
        }
    }
    SurfaceRangeOptions log;
    log.log = true;
    EXPECT_EQ(surfaceRange(std::vector<float>{0, 0, 1, 100}, {}, log), (ValueRange{1, 100, true})) << "zeros do not count";
}

TEST(SurfaceValues, ColoursFollowTheMapAndNoDataIsNone) {
    const ColorMap& map = ColorMap::get(ColorMapId::viridis);
    const ValueRange range{0, 10, false};
    const auto colors = surfaceColors(std::vector<float>{0, 5, 10, 99, kNaN}, map, range);
    ASSERT_EQ(colors.size(), 5u);
    EXPECT_EQ(colors[0], map.map(0.0));
    EXPECT_EQ(colors[1], map.map(0.5));
    EXPECT_EQ(colors[2], map.map(1.0));
    EXPECT_EQ(colors[3], map.map(1.0));
    EXPECT_EQ(colors[4], kNoDataColor);
    for (std::size_t id = 0; id < kColorMapCount; ++id) {
        if (static_cast<ColorMapId>(id) == ColorMapId::grey) continue;
        for (const Color8& entry : ColorMap::get(static_cast<ColorMapId>(id)).entries()) EXPECT_NE(entry, kNoDataColor);
    }
}

TEST(SurfaceValues, ColourLayersAreShownAsColours) {
    SurfaceLayerData layer;
    layer.description.kind = LayerKind::meanColor;
    layer.values = std::vector<float>{1, 0.5f, 0, kNaN, kNaN, kNaN, 0, 0, 0};
    const auto scalars = surfaceScalars(layer);
    ASSERT_EQ(scalars.size(), 3u);
    EXPECT_EQ(scalars[0], luminance(Color(1, 0.5f, 0)));
    EXPECT_TRUE(std::isnan(scalars[1]));
    const ToneMapper tones;
    const auto colors = surfaceColors(layer, tones);
    EXPECT_EQ(colors[0], (Color8{255, 188, 0}));
    EXPECT_EQ(colors[1], kNoDataColor);
    EXPECT_EQ(colors[2], (Color8{0, 0, 0}));
    layer.description.kind = LayerKind::sum;
    EXPECT_EQ(surfaceScalars(layer).size(), 9u);
    EXPECT_EQ(surfaceColors(layer, tones)[0], (Color8{255, 255, 255}));
}

}  // namespace
}  // namespace emca::analysis
