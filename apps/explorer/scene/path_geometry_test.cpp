#include "path_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_picker.h"
#include "scene_test_data.h"

namespace emca::explorer {
namespace {

BoundingBox roomBox() { return boundingBox(testing::roomMeshes()); }

TEST(PathGeometry, environmentHitsLieOnTheDomeInTheirDirection) {
    const PathSet paths = testing::roomPaths(200, 6);
    const std::vector<Mesh> meshes = testing::roomMeshes();
    const BoundingBox box = roomBox();
    const PathGeometry g = makePathGeometry(paths, testing::roomCamera(), meshes, box);
    ASSERT_EQ(g.pathCount(), paths.pathCount());
    int hits = 0;
    for (const analysis::Segment& s : g.segments) {
        if (s.kind != analysis::SegmentKind::toEnvironment) continue;
        ++hits;
        const Vec3f recorded = *paths.position(s.to);
        EXPECT_GT(length(recorded), 500.f);
        EXPECT_NEAR(length(s.end - box.centre()), domeRadius(box), 1e-3f * domeRadius(box));
        EXPECT_GT(dot(normalize(recorded - s.start), normalize(s.end - s.start)), 0.9999f);
        EXPECT_EQ(g.points[s.to], s.end);
    }
    EXPECT_GT(hits, 20);
}

TEST(PathGeometry, segmentsOfAPathAreConnectedAndItsOwn) {
    const PathSet paths = testing::roomPaths(50, 6);
    const PathGeometry g = makePathGeometry(paths, {}, testing::roomMeshes(), roomBox());
    for (Index path = 0; path < g.pathCount(); ++path) {
        const auto segments = g.segmentsOf(path);
        ASSERT_EQ(segments.size(), paths.vertices(path).size());   // from the origin on
        EXPECT_EQ(segments.front().start, *paths.origin(path));
        for (std::size_t i = 0; i < segments.size(); ++i) {
            EXPECT_EQ(segments[i].path, path);
            if (i > 0) {
                EXPECT_EQ(segments[i].start, segments[i - 1].end);
            }
        }
        for (const auto& e : g.nextEventsOf(path)) EXPECT_EQ(e.path, path);
    }
}

TEST(PathGeometry, withoutOriginTheRayComesFromTheCamera) {
    PathColumns c = testing::pathOf({9, 9, 9}, {{0, 0, 0}, {0, 1, 0}}).columns();
    c.pathFlags = std::vector<std::uint8_t>{0};
    auto made = PathSet::make(std::move(c));
    ASSERT_TRUE(made) << made.error().message;
    const PathGeometry g = makePathGeometry(*made, testing::roomCamera(), {}, roomBox());
    ASSERT_EQ(g.segments.size(), 2u);
    EXPECT_EQ(g.segments[0].start, testing::roomCamera().position);
    EXPECT_EQ(g.segments[0].from, analysis::kNoIndex);
    EXPECT_EQ(makePathGeometry(*made, {}, {}, roomBox()).segments.size(), 1u);
}

TEST(PathGeometry, whatIsNotFiniteHasNoPlaceAndWhatIsAbsurdIsPulledIn) {
    const PathSet paths = testing::pathOf({0, 0, 4}, {{0, 0, 0}, {std::nanf(""), 0, 0}, {1e30f, 0, 0}, {0, INFINITY, 0}});
    const PathGeometry g = makePathGeometry(paths, {}, {}, roomBox());
    EXPECT_EQ(g.unplacedVertices, 2u);
    EXPECT_FALSE(isFinite(g.points[1]));
    EXPECT_TRUE(isFinite(g.points[2]));
    EXPECT_LT(length(g.points[2]), 50.f);
    for (const analysis::Segment& s : g.segments) {
        EXPECT_TRUE(isFinite(s.start));
        EXPECT_TRUE(isFinite(s.end));
        EXPECT_LT(length(s.end), 50.f);
    }
}

TEST(PathGeometry, emptySet) {
    const PathGeometry g = makePathGeometry(PathSet(), {}, {}, {});
    EXPECT_EQ(g.pathCount(), 0u);
    EXPECT_TRUE(g.segments.empty());
}

TEST(EvenlyChosen, allOrASpreadSubset) {
    EXPECT_EQ(evenlyChosen(3, 10), (std::vector<Index>{0, 1, 2}));
    EXPECT_EQ(evenlyChosen(10, 3), (std::vector<Index>{0, 3, 6}));
    EXPECT_TRUE(evenlyChosen(0, 3).empty());
    EXPECT_TRUE(evenlyChosen(3, 0).empty());
}

TEST(ScenePicker, selectedPathsComeFirstAndHiddenOnesNever) {
    // Two paths through one line of sight: the second lies behind the first.
    PathColumns c;
    c.pixels = std::vector<Pixel>{{1, 1}, {1, 1}};
    c.samples = std::vector<std::int64_t>{0, 1};
    c.parts = std::vector<std::int32_t>{0, 0};
    c.pathFlags = std::vector<std::uint8_t>{0, 0};
    c.firstVertex = std::vector<Index>{0, 2, 4};
    c.depths = std::vector<std::int32_t>{1, 2, 1, 2};
    c.vertexFlags = std::vector<std::uint8_t>(4, VertexFlag::hasPosition);
    c.positions = std::vector<Vec3f>{{0, 0, 1}, {1, 1, 1}, {0, 0, -1}, {-1, 1, -1}};
    auto made = PathSet::make(std::move(c));
    ASSERT_TRUE(made) << made.error().message;
    const PathGeometry g = makePathGeometry(*made, {}, {}, roomBox());
    const Projection p({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false}, {900, 500});
    const std::vector<Index> both{0, 1}, none, second{1};
    EXPECT_EQ(pickAt({*made, g, none, both}, p, 450, 250)->vertex, 0u);
    EXPECT_EQ(pickAt({*made, g, second, both}, p, 450, 250)->vertex, 2u);
    EXPECT_EQ(pickAt({*made, g, none, second}, p, 450, 250)->vertex, 2u);
    EXPECT_FALSE(pickAt({*made, g, none, none}, p, 450, 250));
    const PickedInside inside = pickInside({*made, g, none, both}, p, {440, 240, 460, 260});
    EXPECT_EQ(inside.paths, both);
    EXPECT_FALSE(inside.vertex);
    EXPECT_EQ(pickInside({*made, g, none, second}, p, {440, 240, 460, 260}).vertex, 2u);
}

}  // namespace
}  // namespace emca::explorer
