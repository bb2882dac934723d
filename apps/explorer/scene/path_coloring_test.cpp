#include "path_coloring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ray_switches.h"
#include "scene_test_data.h"

namespace emca::explorer::testing {
namespace {

TEST(PathColoring, SegmentsHaveTheColourOfTheirValue) {
    const PathSet paths = roomPaths(20, 6, 0.01f, true);
    PathColoring coloring;
    coloring.update(paths, {});
    EXPECT_FALSE(coloring.isOn());
    EXPECT_EQ(coloring.color(0, Qt::red), QColor(Qt::red));
    PathColorStyle style;
    style.quantity = "v.depth";
    coloring.update(paths, style);
    ASSERT_TRUE(coloring.isOn()) << coloring.error().toStdString();
    EXPECT_EQ(coloring.range().min, 1);
    EXPECT_EQ(coloring.range().max, 6);
    const analysis::ColorMap& map = analysis::ColorMap::get(style.map);
    for (const Index v : {0u, 3u, 5u}) {
        const analysis::Color8 c = map.map(double(paths.depthIndex(v)), coloring.range());
        EXPECT_EQ(coloring.color(v, Qt::red), QColor(c.r, c.g, c.b));
        EXPECT_EQ(coloring.value(v), paths.depthIndex(v));
    }
    EXPECT_TRUE(coloring.isIntegral());
    // On a dark ground the dark end is lifted, the rest stays.
    const QColor dark(24, 25, 27);
    coloring.update(paths, style, dark);
    EXPECT_GT(coloring.color(0, Qt::red).lightness(), QColor(map.map(1.0, coloring.range()).r, map.map(1.0, coloring.range()).g, map.map(1.0, coloring.range()).b).lightness());
    const analysis::Color8 middle = map.map(3.0, coloring.range());
    EXPECT_EQ(coloring.color(2, Qt::red), QColor(middle.r, middle.g, middle.b));
    style.limits = SurfaceLimits{2, 3};
    coloring.update(paths, style);
    EXPECT_EQ(coloring.range().max, 3);
    // One value per path: all its vertices have it.
    style = {};
    style.quantity = "sample";
    coloring.update(paths, style);
    for (Index v = 0; v < paths.vertexCount(); ++v) EXPECT_EQ(coloring.value(v), paths.sample(paths.pathOf(v)));
    style.quantity = "v.position.x";
    coloring.update(paths, style);
    EXPECT_FALSE(coloring.isIntegral());
}

TEST(PathColoring, TextsAreCategoriesAndNothingIsGrey) {
    const PathSet paths = roomPaths(300, 6);   // some escape, some end at the light
    PathColoring coloring;
    PathColorStyle style;
    style.quantity = "v.event";
    coloring.update(paths, style);
    ASSERT_TRUE(coloring.isOn());
    ASSERT_GE(coloring.categories().size(), 2u);
    EXPECT_TRUE(std::ranges::is_sorted(coloring.categories()));
    EXPECT_EQ(coloring.text(0), "reflect");
    EXPECT_NE(coloring.categoryColor(0), coloring.categoryColor(coloring.categories().size() - 1));
    // The estimate of a vertex was not recorded: said in words, and no colours.
    style.quantity = "v.estimate";
    coloring.update(paths, style);
    EXPECT_FALSE(coloring.isOn());
    EXPECT_FALSE(coloring.error().isEmpty());
    style.quantity = "v.depth +";
    coloring.update(paths, style);
    EXPECT_FALSE(coloring.isOn());
    EXPECT_TRUE(coloring.error().contains("character"));
    // A segment has the distance to the vertex before; the first has none.
    style.quantity = "v.segment";
    coloring.update(paths, style);
    ASSERT_TRUE(coloring.isOn());
    EXPECT_FALSE(coloring.value(0));
    EXPECT_LT(coloring.color(0, QColor(255, 255, 255)).alphaF(), 0.5);
    coloring.update(PathSet(), style);
    EXPECT_FALSE(coloring.isOn());
}

TEST(PathColoring, WhatCanBeChosenWorks) {
    const PathSet paths = roomPaths(5, 4);
    const auto names = colorableQuantities(paths);
    EXPECT_NE(std::ranges::find(names, "luminance"), names.end());
    EXPECT_NE(std::ranges::find(names, "v.depth"), names.end());
    for (const std::string& name : names) {
        PathColoring coloring;
        PathColorStyle style;
        style.quantity = name;
        coloring.update(paths, style);
        EXPECT_TRUE(coloring.isOn() || coloring.error().startsWith("No vertex")) << name << ": " << coloring.error().toStdString();
    }
}

TEST(RaySwitches, AreKeptByNameAndFoundByPosition) {
    const PathSet paths = roomPaths(6, 4);
    RaySwitches switches;
    EXPECT_TRUE(switches.empty());
    switches.set(pathId(paths, 4), PathRays{false, true});
    switches.set(pathId(paths, 1), PathRays{true, false});
    const Index vertex = paths.vertices(2).first;
    switches.set(vertexId(paths, vertex), VertexRays{true, false, true});
    switches.set(client::PathId{{99, 99}, 0, 0}, PathRays{});   // of another pixel
    const ShownRays shown(switches, paths);
    ASSERT_EQ(shown.paths.size(), 2u);
    EXPECT_EQ(shown.paths[0].first, 1u);
    EXPECT_FALSE(shown.ofPath(4)->line);
    EXPECT_EQ(shown.ofPath(0), nullptr);
    EXPECT_FALSE(shown.ofVertex(vertex)->outgoing);
    switches.remove(pathId(paths, 4));
    EXPECT_FALSE(switches.of(pathId(paths, 4)));
    EXPECT_EQ(switches.of(pathId(paths, 1)), (PathRays{true, false}));
}

}  // namespace
}  // namespace emca::explorer::testing
