#include "view_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace emca::explorer {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

void expectNear(Vec3d a, Vec3d b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

ViewPose randomPose(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1, 1);
    ViewPose pose;
    pose.position = Vec3d{u(random), u(random), u(random)} * 5.0;
    pose.focus = Vec3d{u(random), u(random), u(random)} * 5.0;
    const Vec3d d = pose.direction();
    pose.up = normalize(cross(cross(d, Vec3d{u(random), u(random), u(random)}), d));
    pose.verticalFieldOfView = 20 + 60 * std::abs(u(random));
    return pose;
}

TEST(Projection, focusIsTheCentreAndTheFieldOfViewEndsAtTheBorder) {
    const ViewPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, false};
    const Projection p(pose, {800, 600});
    const auto centre = p.project(Vec3d{0, 0, 0});
    ASSERT_TRUE(centre);
    EXPECT_DOUBLE_EQ(centre->x, 400);
    EXPECT_DOUBLE_EQ(centre->y, 300);
    EXPECT_DOUBLE_EQ(centre->depth, 5);
    const auto top = p.project(Vec3d{0, 5 * std::tan(20 * kRadian), 0});
    EXPECT_NEAR(top->y, 0, 1e-9);
    const auto right = p.project(Vec3d{5 * std::tan(20 * kRadian) * 800 / 600, 0, 0});
    EXPECT_NEAR(right->x, 800, 1e-9);
    EXPECT_FALSE(p.project(Vec3d{0, 0, 6}));
    EXPECT_FALSE(p.project(Vec3d{std::nan(""), 0, 0}));
}

TEST(Projection, orthographicViewHasTheSameHeightAtTheFocus) {
    ViewPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, false};
    const Vec3d atFocus{0.7, 0.3, 0};
    const auto perspective = Projection(pose, {800, 600}).project(atFocus);
    pose.orthographic = true;
    const auto parallel = Projection(pose, {800, 600}).project(atFocus);
    EXPECT_NEAR(perspective->x, parallel->x, 1e-9);
    EXPECT_NEAR(perspective->y, parallel->y, 1e-9);
    EXPECT_NEAR(Projection(pose, {800, 600}).project(Vec3d{0.7, 0.3, -3})->x, parallel->x, 1e-9);
}

TEST(PoseOfCamera, wholeImageIsVisibleWhateverTheShapeOfTheView) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.direction = {0, 0, -1};
    camera.verticalFieldOfView = 50;
    BoundingBox box;
    box.extend({0, 1, -2});
    box.extend({2, 3, -6});
    const double imageAspect = 16.0 / 9;
    for (const Viewport view : {Viewport{1600, 900}, Viewport{2400, 900}, Viewport{600, 900}}) {
        const ViewPose pose = poseOfCamera(camera, imageAspect, view.aspect(), box);
        const double h = std::tan(25 * kRadian), w = h * imageAspect;
        const Projection p(pose, view);
        const auto corner = p.project(Vec3d{1 + w, 2 + h, 2});   // the image's corner at distance 1
        ASSERT_TRUE(corner);
        EXPECT_LE(corner->x, view.width + 1e-6);
        EXPECT_GE(corner->y, -1e-6);
        // It touches the border on the side where the image is the wider one, and fills the height otherwise.
        if (view.aspect() >= imageAspect) {
            EXPECT_NEAR(corner->y, 0, 1e-6);
        } else {
            EXPECT_NEAR(corner->x, view.width, 1e-6);
        }
    }
    expectNear(poseOfCamera(camera, imageAspect, 1, box).focus, {1, 2, -4}, 1e-6);
}

TEST(PoseOfCamera, survivesUpParallelToTheDirection) {
    Camera camera;
    camera.direction = camera.up = {0, 1, 0};
    const ViewPose pose = poseOfCamera(camera, 1, 1, {});
    EXPECT_NEAR(length(pose.up), 1, 1e-9);
    EXPECT_NEAR(dot(pose.up, pose.direction()), 0, 1e-9);
}

TEST(Between, endsAreExactAndThePathStaysRigid) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const ViewPose a = randomPose(random), b = randomPose(random);
        EXPECT_EQ(between(a, b, 0), a);
        EXPECT_EQ(between(a, b, 1), b);
        for (const double t : {1e-9, 0.3, 0.7, 1 - 1e-9}) {
            const ViewPose m = between(a, b, t);
            EXPECT_NEAR(length(m.up), 1, 1e-6);
            EXPECT_NEAR(dot(m.up, m.direction()), 0, 1e-6);
            EXPECT_GE(m.distance(), std::min(a.distance(), b.distance()) * (1 - 1e-6));
            EXPECT_LE(m.distance(), std::max(a.distance(), b.distance()) * (1 + 1e-6));
        }
        expectNear(between(a, b, 1e-9).position, a.position, 1e-6);
        expectNear(between(a, b, 1 - 1e-9).position, b.position, 1e-6);
    }
}

TEST(Eased, beginsAndEndsAtRest) {
    EXPECT_EQ(eased(0), 0);
    EXPECT_EQ(eased(1), 1);
    EXPECT_DOUBLE_EQ(eased(0.5), 0.5);
    EXPECT_LT(eased(1e-3), 1e-5);
    EXPECT_GT(eased(1 - 1e-3), 1 - 1e-5);
}

TEST(Orbited, keepsThePivotWhereItIsOnTheScreenAndTheDistance) {
    std::mt19937 random(2);
    for (int i = 0; i < 100; ++i) {
        ViewPose pose = randomPose(random);
        const Vec3d axis{0, 1, 0};
        const Vec3d pivot = pose.focus + pose.right() * 0.3;
        const ViewPose turned = orbited(pose, pivot, axis, 0.4, 0.1);
        EXPECT_NEAR(length(turned.position - pivot), length(pose.position - pivot), 1e-9);
        EXPECT_NEAR(turned.distance(), pose.distance(), 1e-9);
        EXPECT_NEAR(dot(turned.up, turned.direction()), 0, 1e-9);
    }
}

TEST(Orbited, stopsBeforeThePoles) {
    ViewPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false};
    for (int i = 0; i < 100; ++i) pose = orbited(pose, {}, {0, 1, 0}, 0.05, -0.1);
    EXPECT_LT(std::abs(dot(pose.direction(), Vec3d{0, 1, 0})), std::cos(1.9 * kRadian));
    EXPECT_GT(dot(pose.up, Vec3d{0, 1, 0}), 0);   // never upside down
}

TEST(Zoomed, whatIsUnderTheCursorStays) {
    std::mt19937 random(3);
    const Viewport view{900, 500};
    for (int i = 0; i < 50; ++i) {
        const ViewPose pose = randomPose(random);
        const double unit = pose.heightAtFocus() / view.height;
        const Vec3d under = pose.focus + pose.right() * ((700 - 450) * unit) - pose.up * ((100 - 250) * unit);
        const auto s = Projection(zoomed(pose, view, 0.7, 700, 100), view).project(under);
        ASSERT_TRUE(s);
        EXPECT_NEAR(s->x, 700, 1e-6);
        EXPECT_NEAR(s->y, 100, 1e-6);
    }
}

TEST(Panned, theFocusFollowsTheCursor) {
    std::mt19937 random(4);
    const Viewport view{900, 500};
    for (int i = 0; i < 50; ++i) {
        const ViewPose pose = randomPose(random);
        const auto s = Projection(panned(pose, view, 37, -12), view).project(pose.focus);
        EXPECT_NEAR(s->x, 450 + 37, 1e-6);
        EXPECT_NEAR(s->y, 250 - 12, 1e-6);
    }
}

/// Brute force: no pose nearer along the view direction has all points inside.
TEST(Framed, allPointsAreInsideAndOneTouchesTheMargin) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-2, 2);
    const Viewport view{900, 500};
    for (int i = 0; i < 200; ++i) {
        const ViewPose pose = randomPose(random);
        std::vector<Vec3f> points;
        for (int k = 0; k < 9; ++k) points.push_back({u(random), u(random), u(random)});
        points.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
        for (const bool wish : {false, true}) {
            const ViewPose f = framed(pose, view, points, 0.1, wish ? std::optional(points[3]) : std::nullopt);
            expectNear(f.direction(), pose.direction(), 1e-9);
            const Projection p(f, view);
            double slack = 1;
            for (int k = 0; k < 9; ++k) {
                const auto s = p.project(points[std::size_t(k)]);
                ASSERT_TRUE(s);
                for (const double edge : {s->x / 900 - 0.1, 0.9 - s->x / 900, s->y / 500 - 0.1, 0.9 - s->y / 500}) {
                    EXPECT_GE(edge, -1e-6);
                    slack = std::min(slack, edge);
                }
            }
            // No nearer pose would do, unless the view keeps its distance to the point of interest.
            if (!wish) {
                EXPECT_NEAR(slack, 0, 1e-6);
            }
        }
    }
}

TEST(Framed, orthographicToo) {
    ViewPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, true};
    const std::vector<Vec3f> points{{-3, 0, 0}, {3, 1, -2}, {0, -1, 1}};
    const Viewport view{900, 500};
    const Projection p(framed(pose, view, points, 0.1), view);
    for (const Vec3f& point : points) {
        const auto s = p.project(point);
        EXPECT_GE(s->x, 90 - 1e-6);
        EXPECT_LE(s->x, 810 + 1e-6);
        EXPECT_GE(s->y, 50 - 1e-6);
        EXPECT_LE(s->y, 450 + 1e-6);
    }
}

TEST(Framed, oneOrNoFinitePoint) {
    const ViewPose pose;
    const Vec3f nan{std::nanf(""), 0, 0};
    EXPECT_EQ(framed(pose, {900, 500}, std::vector{nan}, 0.1), pose);
    const ViewPose one = framed(pose, {900, 500}, std::vector{Vec3f{1, 1, 1}}, 0.1);
    const auto s = Projection(one, {900, 500}).project(Vec3f{1, 1, 1});
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->x, 450, 1);
    EXPECT_NEAR(s->y, 250, 1);
}

TEST(FramedIfNeeded, staysWhereEverythingIsVisibleAlready) {
    const ViewPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false};
    const Viewport view{900, 500};
    const std::vector<Vec3f> inside{{-1, -1, 0}, {1, 1, 0}}, outside{{-1, -1, 0}, {4, 1, 0}}, tiny{{0, 0, 0}, {0.05f, 0, 0}},
        behind{{0, 0, 0}, {0, 0, 9}};
    EXPECT_EQ(framedIfNeeded(pose, view, inside, 0.05, 0.3), pose);
    EXPECT_NE(framedIfNeeded(pose, view, outside, 0.05, 0.3), pose);
    EXPECT_NE(framedIfNeeded(pose, view, tiny, 0.05, 0.3), pose);
    EXPECT_NE(framedIfNeeded(pose, view, behind, 0.05, 0.3), pose);
}

}  // namespace
}  // namespace emca::explorer
