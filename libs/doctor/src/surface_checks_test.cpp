#include <cmath>
#include <random>

#include "emca/doctor/path_checks.h"
#include "recorded_for_tests.h"
#include "triangle_distance.h"

namespace emca::doctor {
namespace {

TEST(TriangleDistance, AsBruteForce) {
    std::mt19937 random(7);
    const auto point = [&] {
        std::uniform_real_distribution<double> uniform(-1, 1);
        return Vec3d{uniform(random), uniform(random), uniform(random)};
    };
    for (int i = 0; i < 50; ++i) {
        const Vec3d a = point(), b = point(), c = point(), p = point() * 1.5;
        const double found = length(p - nearestPoint(p, a, b, c).point);
        double least = 1e9;
        constexpr int kSteps = 300;
        for (int u = 0; u <= kSteps; ++u)
            for (int v = 0; u + v <= kSteps; ++v) least = std::min(least, length(p - (a + (b - a) * (double(u) / kSteps) + (c - a) * (double(v) / kSteps))));
        EXPECT_LE(found, least + 1e-12);
        EXPECT_GE(found, least - 0.02);
    }
    EXPECT_EQ(nearestPoint({0.2, 0.2, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).edge, -1);
    EXPECT_EQ(nearestPoint({0.5, -1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}).edge, 0);
    EXPECT_EQ(length(nearestPoint({3, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}).point - Vec3d{1, 0, 0}), 0) << "without area";
}

/// A wall of two triangles, a cube's corner of two that meet at a right angle, and a ball of radius 2 at x = 10.
std::vector<Mesh> scene(int segments = 24) {
    std::vector<Mesh> meshes(3);
    meshes[0].name = "wall";
    meshes[0].positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    meshes[0].triangles = {{0, 1, 2}, {0, 2, 3}};
    meshes[1].name = "corner";
    meshes[1].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    meshes[1].triangles = {{0, 1, 2}, {0, 3, 1}};
    meshes[2].name = "ball";
    for (int r = 0; r <= segments / 2; ++r)
        for (int s = 0; s <= segments; ++s) {
            const double theta = 2 * M_PI * r / segments, phi = 2 * M_PI * s / segments;
            meshes[2].positions.push_back({static_cast<float>(10 + 2 * std::sin(theta) * std::cos(phi)), static_cast<float>(2 * std::cos(theta)), static_cast<float>(2 * std::sin(theta) * std::sin(phi))});
        }
    for (int r = 0; r < segments / 2; ++r)
        for (int s = 0; s < segments; ++s) {
            const auto a = static_cast<std::uint32_t>(r * (segments + 1) + s), c = a + static_cast<std::uint32_t>(segments) + 1;
            meshes[2].triangles.push_back({a, a + 1, c});
            meshes[2].triangles.push_back({a + 1, c + 1, c});
        }
    return meshes;
}

Finding findingOf(const std::vector<Mesh>& meshes, int mesh, int face, Vec3f position) {
    SurfaceCheck check(meshes);
    check.add(recorded({3, 4}, [&](PathRecorder& emca) {
        emca.setPathIndex(6);
        emca.setDepthIndex(1);
        emca.setIntersectionPos(position);
        emca.setIntersectionSurface(mesh, face);
    }));
    return check.finding();
}

TEST(SurfaceChecks, OnAndBesideAFlatTriangle) {
    const auto meshes = scene();
    EXPECT_EQ(findingOf(meshes, 0, 0, {3, 1, 0}).outcome, Outcome::ok);
    EXPECT_EQ(findingOf(meshes, 0, 0, {3, 1, 0.0004f}).outcome, Outcome::ok) << "within the tolerance";
    EXPECT_EQ(findingOf(meshes, 0, 0, {3, 1, 0.003f}).outcome, Outcome::warning) << "moved off for the next ray";
    EXPECT_EQ(findingOf(meshes, 0, 0, {3, 1, 0.1f}).outcome, Outcome::failed);
    EXPECT_EQ(findingOf(meshes, 0, 1, {3, 1, 0}).outcome, Outcome::failed) << "the other triangle of the wall";
    EXPECT_EQ(findingOf(meshes, 1, 0, {0.3f, 0.3f, 0.05f}).outcome, Outcome::failed) << "a right angle is no curve";
    const Finding off = findingOf(meshes, 0, 0, {3, 1, 0.1f});
    EXPECT_NE(off.sentence.find("pixel (3, 4), path 6, depth 1, on wall, face 0"), std::string::npos) << off.sentence;
}

TEST(SurfaceChecks, NamesThatThereAreNot) {
    const auto meshes = scene();
    for (const auto& [mesh, face] : {std::pair{3, 0}, {-1, 0}, {0, 2}, {0, -1}, {1, 7}}) EXPECT_EQ(findingOf(meshes, mesh, face, {1, 1, 0}).outcome, Outcome::failed) << mesh << " " << face;
    EXPECT_EQ(findingOf({}, 0, 0, {1, 1, 0}).outcome, Outcome::failed);
    EXPECT_EQ(SurfaceCheck(meshes).finding().outcome, Outcome::skipped);
}

/// Hits of the sphere itself, on triangles that stand for it: the outside of each one is at most as far as the sagitta.
TEST(SurfaceChecks, ACurvedShapeBulgesOutOfItsTriangles) {
    for (const int segments : {12, 24, 96}) {
        const auto meshes = scene(segments);
        SurfaceCheck check(meshes);
        check.add(recorded({3, 4}, [&](PathRecorder& emca) {
            for (std::size_t face = 0; face < meshes[2].triangles.size(); ++face) {
                const Triangle& t = meshes[2].triangles[face];
                const Vec3f middle = (meshes[2].positions[t[0]] + meshes[2].positions[t[1]] + meshes[2].positions[t[2]]) / 3.f, centre{10, 0, 0};
                emca.setPathIndex(static_cast<std::int64_t>(face));
                emca.setDepthIndex(1);
                emca.setIntersectionPos(centre + normalize(middle - centre) * 2.f);
                emca.setIntersectionSurface(2, static_cast<std::int64_t>(face));
            }
        }));
        const Finding finding = check.finding();
        EXPECT_EQ(finding.outcome, Outcome::ok) << segments << ": " << finding.sentence;
        EXPECT_GT(std::get<std::int64_t>(*finding.find("onCurvedShapes")), segments * segments / 2);
        EXPECT_LT(std::get<double>(*finding.find("largestDistance")), 4 * M_PI * M_PI / (segments * segments)) << "twice the sagitta of a cell's diagonal";
    }
    EXPECT_NE(findingOf(scene(24), 2, 301, {10, 0, 0}).outcome, Outcome::ok) << "its centre is not on it";
}

TEST(SurfaceChecks, LargeCoordinatesAreRounded) {
    auto meshes = scene();
    for (Vec3f& p : meshes[0].positions) p.z += 1e6f;
    EXPECT_EQ(findingOf(meshes, 0, 0, {3, 1, std::nextafter(1e6f, 2e6f)}).outcome, Outcome::ok);
}

}  // namespace
}  // namespace emca::doctor
