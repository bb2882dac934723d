#include "emca/analysis/path_quantities.h"

#include <gtest/gtest.h>

#include <limits>

#include "path_set_for_tests.h"

namespace emca::analysis {
namespace {

using testing_support::makePathSet;
using testing_support::TestVertex;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
using Values = std::vector<double>;
using Indices = std::vector<Index>;

TestVertex at(std::int32_t depth, Vec3f position, std::uint8_t flags = 0) {
    return {depth, position, flags, {}, Event::none, {}};
}

TEST(PathSeries, HasOnlyPathsWithAValue) {
    const PathSet set = makePathSet({{5, {}, Color(1, 2, 3), {at(1, {}), at(4, {1, 0, 0})}},
                                     {7, {}, {}, {}},
                                     {9, {}, Color(kNaN, 0, 0), {{2, {}, 0, {}, Event::none, {}}}}});
    EXPECT_EQ(pathSeries(set, PathQuantity::sample).values, (Values{5, 7, 9}));
    EXPECT_EQ(pathSeries(set, PathQuantity::depth).values, (Values{4, 0, 0}));
    EXPECT_EQ(pathSeries(set, PathQuantity::vertexCount).values, (Values{2, 0, 1}));
    const PathSeries green = pathSeries(set, PathQuantity::green);
    EXPECT_EQ(green.values, (Values{2, 0}));
    EXPECT_EQ(green.paths, (Indices{0, 2}));
    const PathSeries y = pathSeries(set, PathQuantity::luminance);
    ASSERT_EQ(y.size(), 2u);
    EXPECT_FLOAT_EQ(static_cast<float>(y.values[0]), luminance(Color(1, 2, 3)));
    EXPECT_NE(y.values[1], y.values[1]);
}

TEST(EmitterVertex, RecordedEmissionDecides) {
    std::vector<Mesh> meshes(1);
    meshes[0].emission = Color(5);
    TestVertex lit = at(1, {}), dark = at(2, {}), event = at(3, {}), sky = at(4, {}, VertexFlag::environment),
               plain = at(5, {});
    lit.emission = Color(1, 0, 0);
    dark.emission = Color(0.f);
    dark.event = Event::emission;
    event.event = Event::emission;
    const PathSet set = makePathSet({{0, {}, {}, {lit, dark, event, sky, plain}}});
    EXPECT_TRUE(isEmitterVertex(set, 0));
    EXPECT_FALSE(isEmitterVertex(set, 1));
    EXPECT_TRUE(isEmitterVertex(set, 2));
    EXPECT_TRUE(isEmitterVertex(set, 3));
    EXPECT_FALSE(isEmitterVertex(set, 4, meshes));
}

TEST(Segments, FollowTheWalkFromItsOrigin) {
    TestVertex lamp = at(3, {3, 0, 0});
    lamp.emission = Color(1);
    const PathSet set =
        makePathSet({{0,
                      Vec3f{0, 0, 0},
                      {},
                      {at(1, {1, 0, 0}), at(2, {2, 0, 0}), lamp, at(4, {9, 0, 0}, VertexFlag::environment)}}});
    const std::vector<Segment> s = pathSegments(set, 0);
    ASSERT_EQ(s.size(), 4u);
    EXPECT_EQ(s[0].from, kNoIndex);
    EXPECT_EQ(s[0].to, 0u);
    EXPECT_EQ(s[0].start, (Vec3f{0, 0, 0}));
    EXPECT_EQ(s[0].kind, SegmentKind::scatter);
    EXPECT_EQ(s[1].from, 0u);
    EXPECT_EQ(s[2].kind, SegmentKind::toEmitter);
    EXPECT_EQ(s[3].kind, SegmentKind::toEnvironment);
    for (const Segment& segment : s) EXPECT_FALSE(segment.gap);
    EXPECT_EQ(previousPosition(set, 0), (Vec3f{0, 0, 0}));
    EXPECT_EQ(previousPosition(set, 2), (Vec3f{2, 0, 0}));
    EXPECT_EQ(nextPosition(set, 2), (Vec3f{9, 0, 0}));
    EXPECT_FALSE(nextPosition(set, 3));
}

TEST(Segments, MissingAndBrokenPositionsAreBridged) {
    TestVertex without{2, {}, 0, {}, Event::none, {}};
    const PathSet set =
        makePathSet({{0,
                      Vec3f{0, 0, 0},
                      {},
                      {at(1, {1, 0, 0}), without, at(3, {kNaN, 0, 0}), at(4, {4, 0, 0}), at(5, {4, 0, 0})}}});
    const std::vector<Segment> s = pathSegments(set, 0);
    ASSERT_EQ(s.size(), 2u);  // the last has no length
    EXPECT_EQ(s[1].from, 0u);
    EXPECT_EQ(s[1].to, 3u);
    EXPECT_TRUE(s[1].gap);
    EXPECT_EQ(previousPosition(set, 3), (Vec3f{1, 0, 0}));
    EXPECT_EQ(nextPosition(set, 0), (Vec3f{4, 0, 0}));
}

TEST(Segments, WithoutOriginTheFirstVertexBegins) {
    const PathSet set = makePathSet({{0, {}, {}, {at(1, {1, 0, 0}), at(2, {2, 0, 0})}}, {1, {}, {}, {}}});
    EXPECT_EQ(pathSegments(set, 0).size(), 1u);
    EXPECT_TRUE(pathSegments(set, 1).empty());
    EXPECT_FALSE(previousPosition(set, 0));
}

TEST(Segments, LightSubpathStandsAlone) {
    TestVertex lamp = at(0, {5, 5, 5}, VertexFlag::light);
    lamp.emission = Color(1);
    const PathSet set = makePathSet(
        {{0,
          Vec3f{0, 0, 0},
          {},
          {at(1, {1, 0, 0}), lamp, at(1, {5, 0, 5}, VertexFlag::light), at(2, {3, 0, 5}, VertexFlag::light)}}});
    const std::vector<Segment> s = pathSegments(set, 0);
    ASSERT_EQ(s.size(), 3u);
    EXPECT_EQ(s[1].subpath, Subpath::light);
    EXPECT_EQ(s[1].start, (Vec3f{5, 5, 5}));
    EXPECT_EQ(s[1].kind, SegmentKind::toEmitter);
    EXPECT_EQ(s[2].kind, SegmentKind::scatter);
    EXPECT_FALSE(previousPosition(set, 1));
}

TEST(NextEventSegments, OnePerShadowTest) {
    TestVertex v = at(1, {1, 0, 0});
    v.nextEvents = {{{0, 1, 0}, 1}, {{0, 2, 0}, 0}, {{kNaN, 0, 0}, 1}};
    TestVertex nowhere{2, {}, 0, {}, Event::none, {{{0, 1, 0}, 1}}};
    const PathSet set = makePathSet({{0, {}, {}, {v, nowhere}}});
    const std::vector<NextEventSegment> s = nextEventSegments(set, 0);
    ASSERT_EQ(s.size(), 2u);
    EXPECT_TRUE(s[0].visible);
    EXPECT_FALSE(s[1].visible);
    EXPECT_EQ(s[1].start, (Vec3f{1, 0, 0}));
    EXPECT_EQ(s[1].end, (Vec3f{0, 2, 0}));
}

}  // namespace
}  // namespace emca::analysis
