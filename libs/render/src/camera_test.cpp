#include "emca/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "emca/render/reconstruction_filter.h"
#include "testing/chi_square.h"

namespace emca::render {
namespace {

constexpr float kPiFloat = 3.14159265f;

float angle(Vec3f a, Vec3f b) { return std::acos(dot(normalize(a), normalize(b))) * 180.f / kPiFloat; }

CameraSettings lookingDownZ(float fov, FieldOfViewAxis axis) {
    CameraSettings settings;
    settings.toWorld = Transform::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    settings.fieldOfView = fov;
    settings.axis = axis;
    return settings;
}

TEST(Camera, FieldOfViewSpansItsAxis) {
    const auto span = [](FieldOfViewAxis axis, std::uint32_t w, std::uint32_t h, Vec2f from, Vec2f to) {
        const RayCamera camera(lookingDownZ(40, axis), w, h);
        return angle(camera.ray(from, {}).direction, camera.ray(to, {}).direction);
    };
    EXPECT_NEAR(span(FieldOfViewAxis::x, 200, 100, {0, 50}, {200, 50}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::y, 200, 100, {100, 0}, {100, 100}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::diagonal, 200, 100, {0, 0}, {200, 100}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::smaller, 200, 100, {100, 0}, {100, 100}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::smaller, 100, 200, {0, 100}, {100, 100}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::larger, 200, 100, {0, 50}, {200, 50}), 40, 1e-3);
    EXPECT_NEAR(span(FieldOfViewAxis::larger, 100, 200, {50, 0}, {50, 200}), 40, 1e-3);
}

TEST(Camera, ImageIsNotMirrored) {
    // Seen from +z, world +x is on the right and +y at the top of the image.
    const RayCamera camera(lookingDownZ(60, FieldOfViewAxis::x), 100, 100);
    EXPECT_GT(camera.ray({99, 50}, {}).direction.x, 0.3f);
    EXPECT_LT(camera.ray({1, 50}, {}).direction.x, -0.3f);
    EXPECT_GT(camera.ray({50, 1}, {}).direction.y, 0.3f);
    EXPECT_LT(camera.ray({50, 50}, {}).direction.z, -0.999f);
    EXPECT_EQ(camera.ray({50, 50}, {}).origin, (Vec3f{0, 0, 5}));
}

TEST(Camera, ViewAgreesWithItsRays) {
    CameraSettings settings;
    settings.toWorld = Transform::lookAt({1, 2, 3}, {-4, 0, 1}, {0, 1, 0});
    settings.fieldOfView = 50;
    const RayCamera camera(settings, 320, 180);
    const emca::Camera view = camera.view();
    const Vec3f centre = camera.ray({160, 90}, {}).direction;
    EXPECT_NEAR(length(view.direction - centre), 0, 1e-6);
    EXPECT_NEAR(dot(view.up, view.direction), 0, 1e-6);
    EXPECT_NEAR(angle(camera.ray({160, 0}, {}).direction, camera.ray({160, 180}, {}).direction),
                view.verticalFieldOfView, 1e-3);
    EXPECT_GT(dot(view.up, camera.ray({160, 0}, {}).direction), 0.1f);
    EXPECT_TRUE(view.rightHanded);
    EXPECT_GT(dot(cross(view.direction, view.up), camera.ray({320, 90}, {}).direction), 0.1f) << "right of the image";
}

TEST(Camera, ThinLensKeepsThePlaneInFocusSharp) {
    CameraSettings settings = lookingDownZ(40, FieldOfViewAxis::x);
    settings.apertureRadius = 0.3f;
    settings.focusDistance = 2.5f;
    const RayCamera camera(settings, 64, 64);
    testing::TestRandom random(1);
    Vec3f first;
    for (int i = 0; i < 200; ++i) {
        const Ray ray = camera.ray({10, 20}, random.next2());
        EXPECT_LE(length(ray.origin - Vec3f{0, 0, 5}), 0.3f + 1e-5f);
        const Vec3f inFocus = ray.at((2.5f - ray.origin.z) / ray.direction.z);  // the plane z = 5 - 2.5
        if (i == 0) first = inFocus;
        EXPECT_NEAR(length(inFocus - first), 0, 1e-5);
    }
}

TEST(Camera, LensPointsAreUniformOnTheAperture) {
    CameraSettings settings;
    settings.apertureRadius = 0.5f;
    settings.focusDistance = 1;
    const RayCamera camera(settings, 8, 8);
    testing::ChiSquareOptions options;
    options.xBins = options.yBins = 20;
    const auto result = testing::testPoints(
        {-0.5, 0.5, -0.5, 0.5},
        [&](testing::TestRandom& random) -> std::optional<Vec2d> {
            const Vec3f p = camera.ray({4, 4}, random.next2()).origin;
            return Vec2d{double(p.x), double(p.y)};
        },
        [](Vec2d p) { return p.x * p.x + p.y * p.y <= 0.25 ? 4 / 3.14159265358979 : 0.0; }, options);
    EXPECT_TRUE(result.accepted) << result.text;
}

TEST(Camera, SphericalSeesAllDirectionsWithEvenSolidAnglePerSine) {
    CameraSettings settings;
    settings.kind = emca::CameraKind::spherical;
    const RayCamera camera(settings, 360, 180);
    EXPECT_NEAR(length(camera.ray({180, 90}, {}).direction - Vec3f{0, 0, 1}), 0, 1e-6) << "centre: +z";
    EXPECT_NEAR(length(camera.ray({77, 0}, {}).direction - Vec3f{0, 1, 0}), 0, 1e-6) << "top: +y";
    EXPECT_NEAR(length(camera.ray({90, 90}, {}).direction - Vec3f{1, 0, 0}), 0, 1e-6) << "left of +z is +x";
}

TEST(Camera, FocalLengthOfFullFrame) { EXPECT_NEAR(diagonalFieldOfView(50), 46.79, 0.01); }

TEST(ReconstructionFilter, SamplesFollowTheFilter) {
    testing::ChiSquareOptions options;
    options.xBins = options.yBins = 24;
    options.tests = 4;
    for (const auto& filter : {ReconstructionFilter::box(), ReconstructionFilter::tent(),
                               ReconstructionFilter::gaussian(), ReconstructionFilter::gaussian(0.9f)}) {
        const double r = double(filter.radius());
        const auto result = testing::testPoints(
            {-r, r, -r, r},
            [&](testing::TestRandom& random) -> std::optional<Vec2d> {
                const Vec2f p = filter.sample(random.next2());
                return Vec2d{double(p.x), double(p.y)};
            },
            [&](Vec2d p) { return double(filter.pdf({static_cast<float>(p.x), static_cast<float>(p.y)})); }, options);
        EXPECT_TRUE(result.accepted) << name(filter.kind()) << ": " << result.text;
        EXPECT_NEAR(result.integral, 1, 1e-3) << name(filter.kind());
    }
}

}  // namespace
}  // namespace emca::render
