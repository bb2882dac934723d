#include "emca/render/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace emca::render {
namespace {

void expectNear(Vec3f a, Vec3f b, float tolerance = 1e-6f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// An invertible map with entries of order one.
Transform randomTransform(std::mt19937& random) {
    std::uniform_real_distribution<double> number(-1, 1);
    return Transform::translate({number(random), number(random), number(random)}) *
           Transform::rotate({number(random), number(random), number(random)}, 180 * number(random)) *
           Transform::scale({1.5 + number(random), 1.5 + number(random), -1.5 - number(random)}) *
           Transform::rotate({number(random), number(random), number(random)}, 180 * number(random));
}

Vec3f randomVector(std::mt19937& random) {
    std::uniform_real_distribution<float> number(-1, 1);
    return {number(random), number(random), number(random)};
}

TEST(Transform, StepsDoWhatTheirNamesSay) {
    EXPECT_EQ(Transform().point({1, 2, 3}), (Vec3f{1, 2, 3}));
    EXPECT_EQ(Transform::translate({10, 20, 30}).point({1, 2, 3}), (Vec3f{11, 22, 33}));
    EXPECT_EQ(Transform::translate({10, 20, 30}).vector({1, 2, 3}), (Vec3f{1, 2, 3}));
    EXPECT_EQ(Transform::scale({2, 3, 4}).point({1, 2, 3}), (Vec3f{2, 6, 12}));
}

TEST(Transform, RotationFollowsTheRightHandRule) {
    EXPECT_EQ(Transform::rotate({0, 0, 1}, 90).point({1, 0, 0}), (Vec3f{0, 1, 0}));
    EXPECT_EQ(Transform::rotate({5, 0, 0}, 90).point({0, 1, 0}), (Vec3f{0, 0, 1}));
    EXPECT_EQ(Transform::rotate({0, 1, 0}, -90).point({1, 0, 0}), (Vec3f{0, 0, 1}));
    EXPECT_EQ(Transform::rotate({0, 1, 0}, 180).point({1, 2, 3}), (Vec3f{-1, 2, -3}));
    EXPECT_EQ(Transform::rotate({0, 1, 0}, 270).point({1, 0, 0}), (Vec3f{0, 0, 1}));
    expectNear(Transform::rotate({1, 1, 1}, 120).point({1, 2, 3}), {3, 1, 2});
    expectNear(Transform::rotate({0, 0, 1}, 30).point({1, 0, 0}), {std::sqrt(3.f) / 2, 0.5f, 0});
}

TEST(Transform, ProductAppliesTheRightOneFirst) {
    const Transform product = Transform::translate({1, 0, 0}) * Transform::scale({2, 2, 2});
    EXPECT_EQ(product.point({1, 1, 1}), (Vec3f{3, 2, 2}));
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const Transform a = randomTransform(random), b = randomTransform(random);
        const Vec3f p = randomVector(random);
        expectNear((a * b).point(p), a.point(b.point(p)), 2e-5f);
    }
}

TEST(Transform, InverseUndoes) {
    std::mt19937 random(2);
    for (int i = 0; i < 100; ++i) {
        const Transform map = randomTransform(random);
        const auto inverse = map.inverse();
        ASSERT_TRUE(inverse.has_value());
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                EXPECT_NEAR((*inverse * map)(row, column), row == column ? 1 : 0, 1e-12);
    }
}

TEST(Transform, SingularMapsHaveNoInverse) {
    EXPECT_FALSE(Transform::scale({1, 0, 1}).inverse().has_value());
    EXPECT_FALSE(Transform({1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0, 0, 0, 0, 1}).inverse().has_value());
    EXPECT_FALSE(Transform::scale({1, std::nan(""), 1}).inverse().has_value());
    EXPECT_EQ(Transform::scale({1, 0, 1}).normal({0, 0, 1}), (Vec3f{0, 0, 1}));
}

TEST(Transform, NormalsStayOrthogonalToTheirSurface) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const Transform map = randomTransform(random);
        const Vec3f a = randomVector(random), b = randomVector(random);
        const Vec3f normal = map.normal(normalize(cross(a, b)));
        EXPECT_NEAR(length(normal), 1, 1e-6f);
        EXPECT_NEAR(dot(normal, normalize(map.vector(a))), 0, 1e-4f);
        EXPECT_NEAR(dot(normal, normalize(map.vector(b))), 0, 1e-4f);
    }
    // Squeezing along x turns normals towards x.
    expectNear(Transform::scale({0.5, 1, 1}).normal(normalize(Vec3f{1, 1, 0})), normalize(Vec3f{2, 1, 0}));
    // A mirror mirrors them.
    EXPECT_EQ(Transform::scale({1, 1, -1}).normal({0, 0, 1}), (Vec3f{0, 0, -1}));
}

TEST(Transform, DeterminantIsTheVolumeOfTheUnitCube) {
    EXPECT_DOUBLE_EQ(Transform::scale({2, 3, -4}).determinant(), -24);
    EXPECT_NEAR((Transform::rotate({1, 2, 3}, 77) * Transform::translate({5, 5, 5})).determinant(), 1, 1e-14);
}

TEST(Transform, LookAtLooksAtItsTargetWithItsUpUpwards) {
    const Transform camera = Transform::lookAt({1, 2, 3}, {1, 2, 8}, {0, 1, 0});
    EXPECT_EQ(camera.point({0, 0, 0}), (Vec3f{1, 2, 3}));
    EXPECT_EQ(camera.vector({0, 0, 1}), (Vec3f{0, 0, 1}));
    EXPECT_EQ(camera.vector({0, 1, 0}), (Vec3f{0, 1, 0}));
    // Looking along +z with +y up, +x is to the left of who looks.
    EXPECT_EQ(camera.vector({1, 0, 0}), (Vec3f{1, 0, 0}));
    const Transform tilted = Transform::lookAt({4, 5, 6}, {1, -2, 3}, {0, 0, 1});
    expectNear(tilted.vector({0, 0, 1}), normalize(Vec3f{-3, -7, -3}));
    EXPECT_GT(tilted.vector({0, 1, 0}).z, 0);
    EXPECT_NEAR(tilted.determinant(), 1, 1e-12);
}

TEST(Transform, LookAtChoosesSomeUpIfNoneIsGivenOrItIsAlongTheView) {
    for (const Vec3d up : {Vec3d{0, 0, 0}, Vec3d{0, 0, 5}}) {
        const Transform camera = Transform::lookAt({0, 0, 0}, {0, 0, 2}, up);
        EXPECT_NEAR(camera.determinant(), 1, 1e-12);
        expectNear(camera.vector({0, 0, 1}), {0, 0, 1});
    }
}

TEST(Transform, ProjectiveMapsDivideByW) {
    const Transform map({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2});
    EXPECT_EQ(map.point({2, 4, 6}), (Vec3f{1, 2, 3}));
}

}  // namespace
}  // namespace emca::render
