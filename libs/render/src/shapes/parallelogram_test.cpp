#include "shapes/parallelogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace emca::render {
namespace {

constexpr float kError = 1e-5f;

/// A rectangle somewhere, sheared and perhaps mirrored, with the vertices of both triangles turned.
TriangleMesh placedRectangle(std::mt19937& random, std::uint32_t turnA, std::uint32_t turnB) {
    std::uniform_real_distribution<float> any(-1.f, 1.f);
    TriangleMesh mesh = makeRectangle();
    const Vec3f x{any(random), any(random), any(random)}, y{any(random), any(random), any(random)};
    const Vec3f centre{any(random), any(random), any(random)};
    for (Vec3f& p : mesh.positions) p = centre + x * p.x + y * p.y;
    std::ranges::rotate(mesh.triangles[0], mesh.triangles[0].begin() + turnA);
    std::ranges::rotate(mesh.triangles[1], mesh.triangles[1].begin() + turnB);
    return mesh;
}

Vec3f pointOf(const TriangleMesh& mesh, std::int32_t face, Vec2f bary) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(face)];
    return mesh.positions[t[0]] * (1.f - bary.x - bary.y) + mesh.positions[t[1]] * bary.x + mesh.positions[t[2]] * bary.y;
}

/// Point, triangle and barycentric coordinates tell of the same place, whatever the order of the vertices.
TEST(ParallelogramTest, TriangleAndBarycentricsAreThoseOfThePoint) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.f, 1.f);
    for (std::uint32_t turns = 0; turns < 9; ++turns) {
        const TriangleMesh mesh = placedRectangle(random, turns % 3, turns / 3);
        const auto shape = Parallelogram::of(mesh, kError);
        ASSERT_TRUE(shape) << turns;
        int first = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec2f u{unit(random), unit(random)};
            const Vec3f point = shape->at(u);
            const std::int32_t face = shape->face(u);
            const Vec2f bary = shape->barycentrics(u);
            EXPECT_GE(bary.x, 0.f);
            EXPECT_GE(bary.y, 0.f);
            EXPECT_LE(bary.x + bary.y, 1.f + 1e-6f);
            EXPECT_LT(length(pointOf(mesh, face, bary) - point), 1e-6f);
            EXPECT_LT(length(shape->at(shape->parametersOf(point)) - point), 1e-5f);
            first += face == 0;
        }
        EXPECT_NEAR(first, 500, 80) << "both triangles have half of the area (five standard deviations)";
        const Triangle& t = mesh.triangles[0];
        const Vec3f normal = cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
        EXPECT_NEAR(dot(normalize(normal), shape->normal()), 1.f, 1e-5f) << "the same side is the front";
    }
}

/// Vertices that are there twice, as files write them whose corners have their own texture coordinates.
TEST(ParallelogramTest, VerticesMayBeThereTwice) {
    TriangleMesh mesh = makeRectangle();
    mesh.positions.push_back(mesh.positions[0]);
    mesh.positions.push_back(mesh.positions[2]);
    mesh.triangles[1] = {4, 5, 3};
    EXPECT_TRUE(Parallelogram::of(mesh, kError));
}

TEST(ParallelogramTest, OtherMeshesAreNone) {
    const auto isOne = [](const TriangleMesh& mesh) { return Parallelogram::of(mesh, kError).has_value(); };
    const TriangleMesh square = makeRectangle();
    EXPECT_TRUE(isOne(square));

    TriangleMesh one = square;
    one.triangles.pop_back();
    EXPECT_FALSE(isOne(one));
    TriangleMesh trapezoid = square;
    trapezoid.positions[2].x = 0.5f;
    EXPECT_FALSE(isOne(trapezoid));
    TriangleMesh folded = square;
    folded.positions[3].z = 1e-3f;
    EXPECT_FALSE(isOne(folded));
    TriangleMesh twice = square;
    twice.triangles[1] = twice.triangles[0];
    EXPECT_FALSE(isOne(twice));
    TriangleMesh otherFront = square;
    std::swap(otherFront.triangles[1][1], otherFront.triangles[1][2]);
    EXPECT_FALSE(isOne(otherFront)) << "its halves shine to different sides";
    TriangleMesh apart = square;
    for (std::uint32_t i : {0u, 2u, 3u}) apart.positions.push_back(square.positions[i] + Vec3f{0, 0, 1});
    apart.triangles[1] = {4, 5, 6};
    EXPECT_FALSE(isOne(apart));
    TriangleMesh line = square;
    for (Vec3f& p : line.positions) p.y = 0.f;
    EXPECT_FALSE(isOne(line));
    EXPECT_FALSE(isOne(makeCube()));
}

}  // namespace
}  // namespace emca::render
