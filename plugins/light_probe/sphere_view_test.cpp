#include "sphere_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace emca::light_probe {
namespace {

const probe::SphereFrame kFrame = probe::SphereFrame::around({0.3f, 1, -0.2f}, {1, 0.1f, 0.4f});

Vec3f randomDirection(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return normalize(Vec3f{normal(random), normal(random), normal(random)});
}

TEST(SphereView, GoesThereAndBack) {
    std::mt19937 random(1);
    for (const Projection projection : {Projection::latitudeLongitude, Projection::hemispheres, Projection::upperHemisphere}) {
        const SphereView view(kFrame, projection);
        for (int i = 0; i < 5000; ++i) {
            const Vec3f direction = randomDirection(random);
            const auto plane = view.plane(direction);
            if (projection == Projection::upperHemisphere && dot(direction, kFrame.pole) < -1e-6f) {
                EXPECT_FALSE(plane);
                continue;
            }
            ASSERT_TRUE(plane);
            const auto back = view.direction(*plane);
            ASSERT_TRUE(back) << plane->x() << ", " << plane->y();
            EXPECT_NEAR(length(*back - direction), 0, 2e-6);
        }
    }
}

TEST(SphereView, DiscsKeepAreas) {
    // As many of uniform directions in every ring and sector of equal area: chi-square with 63 degrees of freedom, 99.9 %
    // quantile 103.4.
    const SphereView view(kFrame, Projection::hemispheres);
    std::mt19937 random(2);
    int counts[64] = {};
    constexpr int kCount = 64000;
    for (int i = 0; i < kCount; ++i) {
        const auto plane = view.plane(randomDirection(random));
        ASSERT_TRUE(plane);
        const int disc = plane->x() > 1 ? 1 : 0;
        const double x = 2 * (plane->x() - disc) - 1, y = 2 * plane->y() - 1;
        const int ring = std::min(3, static_cast<int>((x * x + y * y) * 4));
        const int sector = std::min(7, static_cast<int>((std::atan2(y, x) / (2 * 3.14159265358979) + 0.5) * 8));
        ++counts[(disc * 4 + ring) * 8 + sector];
    }
    double chi = 0;
    for (const int count : counts) chi += std::pow(count - kCount / 64.0, 2) / (kCount / 64.0);
    EXPECT_LT(chi, 103.4);
}

TEST(SphereView, DiscsAreNotMirrored) {
    // Who looks up with `forward` above the head sees the left hand's side on the right; who looks down, on the left.
    const SphereView view(kFrame, Projection::hemispheres);
    const Vec3f up = kFrame.pole, ahead = kFrame.forward, right = kFrame.right();
    EXPECT_LT(view.plane(normalize(up + ahead * 0.3f))->y(), 0.5);
    EXPECT_LT(view.plane(normalize(up + right * 0.3f))->x(), 0.5);
    EXPECT_LT(view.plane(normalize(ahead * 0.3f - up))->y(), 0.5);
    EXPECT_GT(view.plane(normalize(right * 0.3f - up))->x(), 1.5);
    EXPECT_FALSE(view.direction({0.01, 0.01}));
    EXPECT_FALSE(view.direction({2.5, 0.5}));
}

TEST(PlaneTransform, KeepsThePointUnderTheCursor) {
    PlaneTransform transform;
    transform.setSizes({2, 1}, {400, 300});
    EXPECT_EQ(transform.area(), QRectF(0, 50, 400, 200));
    const QPointF cursor(130, 140), there = transform.toPlane(cursor);
    transform.zoomBy(5, cursor);
    EXPECT_NEAR(transform.toWidget(there).x(), cursor.x(), 1e-9);
    EXPECT_NEAR(transform.toWidget(there).y(), cursor.y(), 1e-9);
    transform.pan({-1e6, 1e6});
    EXPECT_NEAR(transform.area().right(), 400, 1e-9);
    EXPECT_NEAR(transform.area().top(), 0, 1e-9);
    transform.zoomBy(1e-9, cursor);
    EXPECT_EQ(transform.zoom(), 1);
    EXPECT_EQ(transform.area(), QRectF(0, 50, 400, 200));
}

}  // namespace
}  // namespace emca::light_probe
