#include "clip_plane.h"

#include <gtest/gtest.h>

namespace emca::explorer {
namespace {

BoundingBox room() {
    BoundingBox box;
    box.extend({-1, -2, -3});
    box.extend({1, 2, 5});
    return box;
}
const ViewPose kFrom{{0, 0, 9}, {0, 0, 0}, {0, 1, 0}, 45, false};

TEST(ClipPlane, OffAndEmptyScenesCutNothing) {
    EXPECT_FALSE(clipPlane({}, room(), kFrom).isOn());
    EXPECT_FALSE(clipPlane({ClipAxis::x}, BoundingBox(), kFrom).isOn());
    EXPECT_TRUE(ClipPlane().keeps({1e30, -1e30, 0}));
}

TEST(ClipPlane, CutsTheShareAlongAnAxis) {
    for (const float share : {0.f, 0.25f, 1.f}) {
        const ClipPlane plane = clipPlane({ClipAxis::z, share}, room(), kFrom);
        const double z = -3 + 8.0 * double(share);
        EXPECT_TRUE(plane.keeps({0, 0, z + 1e-6}));
        EXPECT_FALSE(plane.keeps({0, 0, z - 1e-6}));
        const ClipPlane other = clipPlane({ClipAxis::z, share, true}, room(), kFrom);
        EXPECT_FALSE(other.keeps({0, 0, z + 1e-6}));
        EXPECT_TRUE(other.keeps({0, 0, z - 1e-6}));
    }
}

TEST(ClipPlane, AlongTheViewItBeginsAtTheNearestCornerOrTheEye) {
    // Looking along -z from outside: the nearest corners are at z = 5, the farthest at z = -3.
    const ClipPlane plane = clipPlane({ClipAxis::view, 0.5f}, room(), kFrom);
    EXPECT_FALSE(plane.keeps({0, 0, 1.01}));
    EXPECT_TRUE(plane.keeps({0, 0, 0.99}));
    ViewPose inside = kFrom;
    inside.position = {0, 0, 1};
    const ClipPlane near = clipPlane({ClipAxis::view, 0.25f}, room(), inside);   // from z = 1 to -3
    EXPECT_FALSE(near.keeps({0, 0, 0.01}));
    EXPECT_TRUE(near.keeps({0, 0, -0.01}));
}

}  // namespace
}  // namespace emca::explorer
