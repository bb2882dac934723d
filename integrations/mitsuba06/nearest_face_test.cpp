#include "nearest_face.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace emca::mitsuba06 {
namespace {

/// Nearest of the triangle's points on a fine grid of barycentric coordinates.
double sampledDistance(const Mesh& mesh, std::size_t face, Vec3f point) {
    const Triangle& t = mesh.triangles[face];
    double nearest = 1e30;
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j + i <= kSteps; ++j) {
            const float u = float(i) / kSteps, v = float(j) / kSteps;
            const Vec3f at = mesh.positions[t[0]] * (1 - u - v) + mesh.positions[t[1]] * u + mesh.positions[t[2]] * v;
            nearest = std::min(nearest, double(length(at - point)));
        }
    }
    return nearest;
}

Mesh randomMesh(std::size_t faces, std::mt19937& random) {
    std::uniform_real_distribution<float> where(-1, 1), size(-0.1f, 0.1f);
    Mesh mesh;
    for (std::uint32_t i = 0; i < faces; ++i) {
        const Vec3f centre{where(random), where(random), where(random)};
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(centre + Vec3f{size(random), size(random), size(random)});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

TEST(NearestFace, isAsNearAsTheNearestByBruteForce) {
    std::mt19937 random(1);
    const Mesh mesh = randomMesh(200, random);
    const NearestFace nearest(mesh);
    std::uniform_real_distribution<float> where(-1.5f, 1.5f);
    for (int i = 0; i < 100; ++i) {
        const Vec3f point{where(random), where(random), where(random)};
        const std::int32_t found = nearest.find(point);
        ASSERT_GE(found, 0);
        const double distance = sampledDistance(mesh, static_cast<std::size_t>(found), point);
        for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
            EXPECT_LE(distance, sampledDistance(mesh, face, point) + 0.02)
                << "point " << i << ", face " << face << ", found " << found;
        }
    }
}

TEST(NearestFace, findsTheTriangleOfItsOwnPoints) {
    std::mt19937 random(2);
    const Mesh mesh = randomMesh(300, random);
    const NearestFace nearest(mesh);
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
        const Triangle& t = mesh.triangles[face];
        const Vec3f centre = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.f;
        EXPECT_EQ(nearest.find(centre), static_cast<std::int32_t>(face));
    }
}

TEST(NearestFace, hasNoneWithoutTrianglesOrForPointsThatAreNowhere) {
    EXPECT_EQ(NearestFace().find({0, 0, 0}), -1);
    EXPECT_EQ(NearestFace(Mesh{}).find({0, 0, 0}), -1);
    std::mt19937 random(3);
    EXPECT_EQ(NearestFace(randomMesh(10, random)).find({NAN, 0, 0}), -1);
}

TEST(NearestFace, ofEquallyNearTrianglesTheFirstIsFound) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 20; ++i) mesh.triangles.push_back({0, 1, 2});
    EXPECT_EQ(NearestFace(mesh).find({0.2f, 0.2f, 1}), 0);
}

}  // namespace
}  // namespace emca::mitsuba06
