#include "mesh_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_test_data.h"

namespace emca::explorer {
namespace {

constexpr std::array<std::uint8_t, 3> kClay{185, 180, 172};

const Mesh& named(const std::vector<Mesh>& meshes, const char* name) {
    for (const Mesh& m : meshes)
        if (m.name == name) return m;
    return meshes.front();
}

TEST(MeshGeometry, ballIsSmoothAndBlockIsNot) {
    const std::vector<Mesh> room = testing::roomMeshes();
    const MeshGeometry ball = makeMeshGeometry(std::vector{named(room, "ball")}, kClay);
    // Smooth normals of a sphere point away from its centre (0.42, -0.6, 0.25).
    for (std::size_t i = 0; i < ball.surfaces.positions.size(); ++i) {
        const Vec3f out = normalize(ball.surfaces.positions[i] - Vec3f{0.42f, -0.6f, 0.25f});
        EXPECT_GT(dot(out, ball.surfaces.normals[i]), 0.98f);
    }
    EXPECT_TRUE(ball.edges.empty()) << ball.edges.size() << " edges, the first " << length(ball.edges[0].to - ball.edges[0].from) << " long";
    const MeshGeometry block = makeMeshGeometry(std::vector{named(room, "block")}, kClay);
    EXPECT_EQ(block.surfaces.positions.size(), 24u);   // three normals at each of eight corners
    EXPECT_EQ(block.surfaces.triangles.size(), 12u);
    EXPECT_EQ(block.edges.size(), 12u);                // those of a cube, without diagonals
    for (std::size_t i = 0; i < 24; ++i) EXPECT_NEAR(length(block.surfaces.normals[i]), 1, 1e-5f);
}

TEST(MeshGeometry, bordersOfAnOpenSheetAreEdges) {
    const MeshGeometry floor = makeMeshGeometry(std::vector{named(testing::roomMeshes(), "floor")}, kClay);
    EXPECT_EQ(floor.edges.size(), 4u);
    EXPECT_EQ(floor.surfaces.positions.size(), 4u);
}

TEST(MeshGeometry, emittersAreApart) {
    const std::vector<Mesh> room = testing::roomMeshes();
    const MeshGeometry g = makeMeshGeometry(room, kClay);
    EXPECT_EQ(g.emitters.triangles.size(), 2u);
    EXPECT_EQ(g.emitterEdges.size(), 4u);
    std::size_t all = 0;
    for (const Mesh& m : room) all += m.triangles.size();
    // The ball's pole triangles have no area and are left out without being faults.
    EXPECT_EQ(g.surfaces.triangles.size() + g.emitters.triangles.size(), all - 64);
    EXPECT_EQ(g.skippedTriangles, 0u);
}

TEST(MeshGeometry, aFarSunIsNotTheCore) {
    std::vector<Mesh> room = testing::roomMeshes();
    Mesh sun = named(room, "light");
    for (Vec3f& p : sun.positions) p += {0, 60, 20};
    room.push_back(sun);
    const MeshGeometry g = makeMeshGeometry(room, kClay);
    EXPECT_GT(g.box.max.y, 50);
    EXPECT_EQ(g.core.min, (Vec3f{-1, -1, -1}));
    EXPECT_EQ(g.core.max, (Vec3f{1, 1, 1}));
    EXPECT_FALSE(makeMeshGeometry(std::vector{sun}, kClay).core.empty);
}

TEST(FirstHit, nearestSurfaceAlongTheRay) {
    const std::vector<Mesh> room = testing::roomMeshes();
    EXPECT_NEAR(firstHit(room, {0, 0.6f, 4}, {0, 0, -1}).value_or(0), 5, 1e-5f);
    EXPECT_FALSE(firstHit(room, {0, 0, 4}, {0, 0, 1}));
}

TEST(MeshGeometry, faultyTrianglesAreCountedNotDrawn) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {std::nanf(""), 0, 0}, {INFINITY, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 99}, {0, 0, 1}};
    const MeshGeometry g = makeMeshGeometry(std::vector{mesh}, kClay);
    EXPECT_EQ(g.surfaces.triangles.size(), 1u);
    EXPECT_EQ(g.skippedTriangles, 3u);
    EXPECT_EQ(g.box.max, (Vec3f{1, 1, 0}));
}

TEST(MeshGeometry, emptyAndCancelled) {
    EXPECT_TRUE(makeMeshGeometry({}, kClay).box.empty);
    const std::atomic<bool> cancel = true;
    EXPECT_TRUE(makeMeshGeometry(testing::roomMeshes(), kClay, &cancel).surfaces.triangles.empty());
}

TEST(ClayColor, keepsHueAndStaysInTheMiddle) {
    const auto red = clayColor({0.6f, 0.05f, 0.05f}, kClay), black = clayColor({0, 0, 0}, kClay), white = clayColor({1, 1, 1}, kClay);
    EXPECT_GT(red[0], red[1] + 30);
    EXPECT_GT(black[1], 60);
    EXPECT_LT(black[1], white[1]);
    EXPECT_EQ(clayColor({std::nanf(""), 0, 0}, kClay), kClay);
}

}  // namespace
}  // namespace emca::explorer
