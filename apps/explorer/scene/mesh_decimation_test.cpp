#include "mesh_decimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <unordered_map>

#include "place_table.h"
#include "scene_test_data.h"

namespace emca::explorer {
namespace {

ShadedTriangles shaded(const Mesh& mesh) {
    const std::array<std::uint8_t, 3> grey{128, 128, 128};
    return makeMeshGeometry(std::span(&mesh, 1), grey).surfaces;
}

double area(const ShadedTriangles& t) {
    double sum = 0;
    for (const Triangle& f : t.triangles)
        sum += double(length(cross(t.positions[f[1]] - t.positions[f[0]], t.positions[f[2]] - t.positions[f[0]]))) / 2;
    return sum;
}

TEST(PlaceTable, NumbersAsAMapDoes) {
    PlaceTable table(4);   // grows many times
    std::unordered_map<std::uint64_t, std::uint32_t> expected;
    std::mt19937 random(3);
    for (int i = 0; i < 200000; ++i) {
        const auto draw = [&] { return std::int64_t(random() % 61); };
        const std::uint64_t key = PlaceTable::key(draw(), draw(), draw() * 30000);
        const auto [place, isNew] = expected.try_emplace(key, std::uint32_t(expected.size()));
        const auto [number, wasNew] = table.number(key);
        ASSERT_EQ(number, place->second);
        ASSERT_EQ(wasNew, isNew);
    }
    EXPECT_EQ(table.count(), expected.size());
    EXPECT_NE(PlaceTable::key(PlaceTable::kLargest, 0, 0), PlaceTable::key(0, PlaceTable::kLargest, PlaceTable::kLargest));
}

TEST(Decimation, KeepsShapeAreaAndSides) {
    const ShadedTriangles full = shaded(testing::waves(80000));
    const ShadedTriangles few = standIn(full, 8000);
    EXPECT_GE(few.triangles.size(), 3200u);
    EXPECT_LE(few.triangles.size(), 16000u);
    EXPECT_NEAR(area(few) / area(full), 1, 0.05);
    for (const Triangle& t : few.triangles)
        for (const std::uint32_t v : t) ASSERT_LT(v, few.positions.size());
    // The waves are a height field: triangles still look to the same side of the floor, mostly straight.
    double up = 0, all = 0;
    const Vec3f first = cross(full.positions[full.triangles[0][1]] - full.positions[full.triangles[0][0]],
                              full.positions[full.triangles[0][2]] - full.positions[full.triangles[0][0]]);
    for (const Triangle& t : few.triangles) {
        const Vec3f n = cross(few.positions[t[1]] - few.positions[t[0]], few.positions[t[2]] - few.positions[t[0]]);
        up += n.y * first.y > 0 ? double(length(n)) : 0;
        all += double(length(n));
    }
    EXPECT_GT(up, 0.99 * all);
    // Every vertex is near the surface that it stands for: y = -0.8 + 0.1 sin(30 u) cos(23 v).
    double worst = 0;
    for (const Vec3f& p : few.positions) {
        const double u = (double(p.x) + 1) / 2, v = (double(p.z) + 1) / 2;
        worst = std::max(worst, std::abs(double(p.y) + 0.8 - 0.1 * std::sin(30 * u) * std::cos(23 * v)));
    }
    EXPECT_LT(worst, 0.02);
    for (const Vec3f& n : few.normals) EXPECT_NEAR(double(length(n)), 1, 1e-4);
}

TEST(Decimation, NothingOccursTwiceAndLargeTrianglesStay) {
    ShadedTriangles two;
    two.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    two.normals.assign(6, {0, 0, 1});
    two.colors.assign(6, {10, 20, 30});
    two.triangles = {{0, 1, 2}, {4, 5, 3}, {0, 2, 1}};   // the same twice, and its back
    const ShadedTriangles one = clustered(two, 8);
    EXPECT_EQ(one.triangles.size(), 2u);
    EXPECT_EQ(one.positions.size(), 3u);
    EXPECT_EQ(one.colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
    EXPECT_TRUE(clustered({}, 8).triangles.empty());
    // All in one cell: nothing is left, and nothing breaks.
    EXPECT_TRUE(clustered(two, 1).triangles.size() <= 2u);
}

TEST(Welding, ManyCopiesOfEachVertexBecomeOneSurface) {
    // A triangle soup: each triangle with vertices of its own.
    const Mesh waves = testing::waves(5000);
    Mesh soup;
    for (const Triangle& t : waves.triangles) {
        const auto base = static_cast<std::uint32_t>(soup.positions.size());
        for (const std::uint32_t v : t) soup.positions.push_back(waves.positions[v]);
        soup.triangles.push_back({base, base + 1, base + 2});
    }
    const ShadedTriangles welded = shaded(soup), shared = shaded(waves);
    EXPECT_EQ(welded.triangles.size(), shared.triangles.size());
    EXPECT_EQ(welded.positions.size(), shared.positions.size());
}

}  // namespace
}  // namespace emca::explorer
