#include "emca/render/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace emca::render {
namespace {

Vec3f faceNormal(const TriangleMesh& mesh, const Triangle& t) {
    return cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
}

double area(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += 0.5 * double(length(faceNormal(mesh, t)));
    return sum;
}

/// Signed volume by the divergence theorem; positive if the faces look outwards.
double volume(const TriangleMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += double(dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]]))) / 6;
    return sum;
}

/// Every edge is met once in each direction, once vertices at the same place are one.
bool isClosed(const TriangleMesh& mesh) {
    using Key = std::array<long, 3>;
    const auto key = [&](std::uint32_t i) {
        const Vec3f p = mesh.positions[i];
        return Key{std::lround(p.x * 1e5f), std::lround(p.y * 1e5f), std::lround(p.z * 1e5f)};
    };
    std::map<std::pair<Key, Key>, int> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            edges[{key(t[i]), key(t[(i + 1) % 3])}] += 1;
            edges[{key(t[(i + 1) % 3]), key(t[i])}] -= 1;
        }
    for (const auto& [edge, balance] : edges)
        if (balance != 0)
            return false;
    return true;
}

/// Smallest area of a triangle divided by that of the largest.
double worstTriangle(const TriangleMesh& mesh) {
    double least = 1e30, most = 0;
    for (const auto& t : mesh.triangles) {
        const double a = double(length(faceNormal(mesh, t)));
        least = std::min(least, a);
        most = std::max(most, a);
    }
    return least / most;
}

TEST(TriangleMesh, SphereIsClosedAndAlmostASphere) {
    const TriangleMesh sphere = makeSphere();
    EXPECT_TRUE(isClosed(sphere));
    EXPECT_NEAR(double(sphere.triangles.size()), 2000, 100);
    EXPECT_NEAR(area(sphere), 4 * std::numbers::pi, 0.08);
    EXPECT_NEAR(volume(sphere), 4 * std::numbers::pi / 3, 0.04);
    EXPECT_GT(worstTriangle(sphere), 0.02);
    ASSERT_EQ(sphere.normals.size(), sphere.positions.size());
    ASSERT_EQ(sphere.uvs.size(), sphere.positions.size());
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        EXPECT_NEAR(length(sphere.positions[i]), 1, 1e-6);
        EXPECT_NEAR(dot(sphere.positions[i], sphere.normals[i]), 1, 1e-6);
        EXPECT_NEAR(sphere.uvs[i].y * std::numbers::pi_v<float>, std::acos(sphere.positions[i].z), 2e-3);
    }
    for (const auto& t : sphere.triangles)
        for (const auto index : t)
            EXPECT_GT(dot(faceNormal(sphere, t), sphere.normals[index]), 0);
}

TEST(TriangleMesh, CubeIsClosedWithFlatFaces) {
    const TriangleMesh cube = makeCube();
    EXPECT_TRUE(isClosed(cube));
    EXPECT_EQ(cube.triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(area(cube), 24);
    EXPECT_DOUBLE_EQ(volume(cube), 8);
    EXPECT_TRUE(cube.normals.empty());
    EXPECT_EQ(cube.uvs.size(), 24u);
}

TEST(TriangleMesh, RectangleAndDiskLookAlongZ) {
    const TriangleMesh rectangle = makeRectangle(), disk = makeDisk();
    EXPECT_DOUBLE_EQ(area(rectangle), 4);
    EXPECT_NEAR(area(disk), std::numbers::pi, 0.006);
    EXPECT_GT(worstTriangle(disk), 0.99);
    for (const auto* mesh : {&rectangle, &disk})
        for (const auto& t : mesh->triangles) {
            EXPECT_GT(faceNormal(*mesh, t).z, 0);
            EXPECT_EQ(faceNormal(*mesh, t).x, 0);
        }
    for (std::size_t i = 0; i < rectangle.positions.size(); ++i)
        EXPECT_EQ(rectangle.uvs[i], (Vec2f{(rectangle.positions[i].x + 1) / 2, (rectangle.positions[i].y + 1) / 2}));
    for (std::size_t i = 0; i < disk.positions.size(); ++i)
        EXPECT_NEAR(length(disk.positions[i]), disk.uvs[i].x, 1e-6);
}

TEST(TriangleMesh, TessellatedSphereIsWhereItShouldBe) {
    const TriangleMesh sphere = tessellateSphere({1, 2, 3}, 0.5f, Transform::scale({2, 2, 2}));
    for (const auto& p : sphere.positions)
        EXPECT_NEAR(length(p - Vec3f{2, 4, 6}), 1, 1e-5);
}

TEST(TriangleMesh, MirroringKeepsTheFront) {
    for (const double z : {1.0, -1.0}) {
        TriangleMesh sphere = makeSphere();
        apply(Transform::scale({1, 2, 3 * z}), sphere);
        EXPECT_NEAR(volume(sphere), 6 * 4 * std::numbers::pi / 3, 0.25);
        for (const auto& t : sphere.triangles)
            EXPECT_GT(dot(faceNormal(sphere, t), sphere.normals[t[0]]), 0);
    }
}

TEST(TriangleMesh, FlippingTurnsItInsideOut) {
    TriangleMesh sphere = makeSphere();
    const double before = volume(sphere);
    flip(sphere);
    EXPECT_DOUBLE_EQ(volume(sphere), -before);
    EXPECT_LT(dot(sphere.normals[100], sphere.positions[100]), 0);
}

TEST(TriangleMesh, SmoothNormalsOfASphereAreRadial) {
    TriangleMesh sphere = makeSphere();
    const auto exact = sphere.normals;
    computeNormals(sphere);
    // Vertices on the seam and at the poles know only a part of their faces.
    for (const auto& t : sphere.triangles)
        for (const auto index : t) {
            EXPECT_NEAR(length(sphere.normals[index]), 1, 1e-5);
            EXPECT_GT(dot(sphere.normals[index], exact[index]), 0.98f);
        }
}

TEST(TriangleMesh, NormalsAreWeightedByAngleNotByTheNumberOfTriangles) {
    // A corner of a cube with shared vertices: one of its sides is split into two triangles, the others are not.
    TriangleMesh corner;
    corner.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    corner.triangles = {{0, 1, 4}, {0, 4, 2}, {0, 2, 3}, {0, 3, 1}};
    computeNormals(corner);
    const float k = 1 / std::sqrt(3.f);
    EXPECT_NEAR(corner.normals[0].x, k, 1e-6);
    EXPECT_NEAR(corner.normals[0].y, k, 1e-6);
    EXPECT_NEAR(corner.normals[0].z, k, 1e-6);
}

TEST(TriangleMesh, DegenerateTrianglesDoNotSpoilNormals) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 1, 1}, {2, 1, 0}, {3, 3, 3}};
    computeNormals(mesh);
    for (const auto& normal : mesh.normals)
        EXPECT_NEAR(length(normal), 1, 1e-6);
}

TEST(TriangleMesh, TrianglesTurnToTheirNormals) {
    TriangleMesh mesh = makeSphere();
    const auto right = mesh.triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    alignWithNormals(mesh);
    EXPECT_EQ(mesh.triangles, right);
}

}  // namespace
}  // namespace emca::render
