#include "picking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace emca::explorer {
namespace {

const ViewPose kPose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false};
const Viewport kView{900, 500};

TEST(PickPoint, frontMostWithinTheRadiusNotTheNearestOnTheScreen) {
    const Projection p(kPose, kView);
    const std::vector<Vec3f> points{{0, 0, -1}, {0.03f, 0, 1}};
    EXPECT_EQ(pickPoint(p, points, 450, 250, 9), 1u);
    EXPECT_EQ(pickPoint(p, points, 450, 250, 2), 0u);
    EXPECT_EQ(pickPoint(p, points, 450, 250, 9, [](std::uint32_t i) { return i == 0; }), 0u);
    EXPECT_FALSE(pickPoint(p, points, 10, 10, 9));
}

TEST(PickPoint, agreesWithBruteForce) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u(-3, 3);
    std::uniform_real_distribution<double> x(0, 900), y(0, 500);
    std::vector<Vec3f> points;
    for (int i = 0; i < 3000; ++i) points.push_back({u(random), u(random), 3 * u(random)});
    points[17].x = std::nanf("");
    points[18].y = INFINITY;
    const Projection p(kPose, kView);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const double cx = x(random), cy = y(random);
        std::optional<std::uint32_t> expected;
        double nearest = 1e300;
        for (std::uint32_t k = 0; k < points.size(); ++k) {
            const auto s = p.project(points[k]);
            if (!s || std::hypot(s->x - cx, s->y - cy) > 9 || s->depth >= nearest) continue;
            nearest = s->depth;
            expected = k;
        }
        EXPECT_EQ(pickPoint(p, points, cx, cy, 9), expected);
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 100);
}

/// Brute force: many points along each segment.
TEST(PickSegment, agreesWithDenseSampling) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> u(-3, 3);
    std::uniform_real_distribution<double> x(0, 900), y(0, 500);
    std::vector<PickSegment> segments;
    for (std::uint32_t i = 0; i < 20; ++i) segments.push_back({{u(random), u(random), 2 * u(random) - 3}, {u(random), u(random), 2 * u(random) - 3}, i});
    const Projection p(kPose, kView);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const double cx = x(random), cy = y(random);
        const auto picked = pickSegment(p, segments, cx, cy, 5);
        double best = 1e300;
        for (const PickSegment& s : segments)
            for (int k = 0; k <= 4000; ++k) {
                const auto q = p.project(s.from + (s.to - s.from) * (float(k) / 4000));
                if (q) best = std::min(best, std::hypot(q->x - cx, q->y - cy));
            }
        if (picked) {
            EXPECT_LT(best, 5.5);
        } else {
            EXPECT_GT(best, 4.5);
        }
        hits += picked.has_value();
    }
    EXPECT_GT(hits, 30);
    EXPECT_LT(hits, 290);
}

TEST(PickSegment, theNearerOfTwoThatCross) {
    const Projection p(kPose, kView);
    const std::vector<PickSegment> segments{{{-1, -1, -2}, {1, 1, -2}, 7}, {{-1, 1, 1}, {1, -1, 1}, 8}};
    EXPECT_EQ(pickSegment(p, segments, 450, 250, 5), 8u);
}

TEST(PickSegment, partBehindTheEyeIsCutOff) {
    const Projection p(kPose, kView);
    const std::vector<PickSegment> through{{{0, 0, 0}, {0.5f, 0, 20}, 1}}, behind{{{0, 0, 6}, {0, 1, 9}, 1}};
    EXPECT_EQ(pickSegment(p, through, 450, 250, 5), 1u);
    EXPECT_FALSE(pickSegment(p, behind, 450, 250, 1000));
}

TEST(PointsInside, agreesWithProjection) {
    std::mt19937 random(13);
    std::uniform_real_distribution<float> u(-3, 3);
    std::vector<Vec3f> points;
    for (int i = 0; i < 500; ++i) points.push_back({u(random), u(random), 3 * u(random)});
    const Projection p(kPose, kView);
    const auto inside = pointsInside(p, points, {600, 400, 300, 100});   // corners in the wrong order
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (const auto s = p.project(points[i]); s && s->x >= 300 && s->x <= 600 && s->y >= 100 && s->y <= 400) expected.push_back(i);
    EXPECT_EQ(inside, expected);
    EXPECT_GT(expected.size(), 10u);
}

TEST(Crosses, throughWithoutAnEndInside) {
    const Projection p(kPose, kView);
    EXPECT_TRUE(crosses(p, {-2, 0, 0}, {2, 0, 0}, {440, 240, 460, 260}));
    EXPECT_FALSE(crosses(p, {-2, 1, 0}, {2, 1, 0}, {440, 240, 460, 260}));
    EXPECT_TRUE(crosses(p, {0, 0, 0}, {0, 0.001f, 0}, {440, 240, 460, 260}));
    EXPECT_FALSE(crosses(p, {0, 0, 7}, {0, 0, 9}, {0, 0, 900, 500}));
}

}  // namespace
}  // namespace emca::explorer
