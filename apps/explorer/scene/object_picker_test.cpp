#include "object_picker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "object_geometry.h"

namespace emca::explorer {
namespace {

const ViewPose kPose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 45, false};
const Viewport kView{800, 600};

SceneObject made(decltype(SceneObject::shape) shape) {
    SceneObject object;
    object.name = "thing";
    object.shape = std::move(shape);
    if (const auto* grid = std::get_if<VoxelGrid>(&object.shape))
        object.colors.values.assign(std::size_t(grid->size[0]) * grid->size[1] * grid->size[2], 1);
    return object;
}

std::optional<ObjectHit> pickAt(ObjectPicker& picker, const SceneObjects& objects, Vec3d place, double dx = 0) {
    const Projection projection(kPose, kView);
    const auto at = projection.project(place);
    return picker.pick(objects.entries(), projection, rayThrough(kPose, kView, at->x + dx, at->y), at->x + dx, at->y);
}

TEST(ObjectGeometry, ABoxHasTwelveEdgesOfItsLengths) {
    const auto edges = edgesOf(ObjectBox::between({0, 0, 0}, {1, 2, 3}));
    ASSERT_EQ(edges.size(), 12u);
    double sum = 0;
    for (const Edge& e : edges) sum += double(length(e.to - e.from));
    EXPECT_NEAR(sum, 4 * (1 + 2 + 3), 1e-5);
    const ObjectGeometry g = geometryOf(made(BoxSet{{ObjectBox::between({0, 0, 0}, {1, 2, 3})}}));
    EXPECT_EQ(g.triangles.colors.size(), 12u);
    EXPECT_TRUE(g.triangles.translucent);
    // Sides look outwards: the volume by the divergence theorem is that of the box.
    double volume = 0;
    for (std::size_t i = 0; i < g.triangles.positions.size(); i += 3)
        volume += double(dot(g.triangles.positions[i], cross(g.triangles.positions[i + 1], g.triangles.positions[i + 2]))) / 6;
    EXPECT_NEAR(volume, 6, 1e-4);
}

TEST(ObjectGeometry, OfCellsOnlyTheSurfaceIsDrawn) {
    SceneObject grid = made(VoxelGrid{{0, 0, 0}, {1, 1, 1}, {4, 3, 2}});
    EXPECT_EQ(geometryOf(grid).triangles.colors.size(), 2u * 2 * (4 * 3 + 3 * 2 + 4 * 2));
    EXPECT_FALSE(geometryOf(grid).triangles.translucent);
    grid.colors.values[0] = NAN;   // a corner: three sides go, three come
    EXPECT_EQ(geometryOf(grid).triangles.colors.size(), 2u * 2 * (4 * 3 + 3 * 2 + 4 * 2));
    std::get<VoxelGrid>(grid.shape).shownFrom = 2;
    EXPECT_TRUE(geometryOf(grid).triangles.colors.empty());
}

TEST(ObjectGeometry, TooManyPointsAreThinnedAndCounted) {
    PointSet set;
    set.points.assign(kMaximumStrokes * 2 + 1, Vec3f{});
    const ObjectGeometry g = geometryOf(made(std::move(set)));
    EXPECT_LE(g.strokes.size(), kMaximumStrokes);
    EXPECT_EQ(g.strokes.size() + g.leftOut, kMaximumStrokes * 2 + 1);
}

TEST(ObjectPicker, PointsAndLinesComeBeforeSides) {
    SceneObjects objects;
    ObjectPicker picker;
    ASSERT_TRUE(objects.set({"p", "box"}, made(BoxSet{{ObjectBox::between({-1, -1, -1}, {1, 1, 1})}})));
    ASSERT_TRUE(objects.set({"p", "points"}, made(PointSet{{{0, 0, 0}, {0.5f, 0, 0}}})));
    auto hit = pickAt(picker, objects, {0.5, 0, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id.id, "points");
    EXPECT_EQ(hit->element, 1u);
    hit = pickAt(picker, objects, {0.25, 0.3, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id.id, "box");
    objects.setVisible({"p", "box"}, false);
    EXPECT_FALSE(pickAt(picker, objects, {0.25, 0.3, 0}));
    EXPECT_FALSE(pickAt(picker, objects, {3, 0, 0}));
}

TEST(ObjectPicker, TrianglesAreFoundAndForgotten) {
    SceneObjects objects;
    ObjectPicker picker;
    const TriangleSet set{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {{0, 1, 2}, {3, 4, 5}}};
    ASSERT_TRUE(objects.set({"p", "t"}, made(set)));
    const auto hit = pickAt(picker, objects, {0, 0, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->element, 1u) << "the nearer one";
    objects.removeAll("p");
    picker.tidy(objects.entries());
    EXPECT_FALSE(pickAt(picker, objects, {0, 0, 0}));
}

/// The walk through the grid against all cells, each as a box.
TEST(ObjectPicker, TheFirstCellIsThatOfBruteForce) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const VoxelGrid grid{{-1, -0.8f, -0.6f}, {0.25f, 0.2f, 0.3f}, {8, 8, 4}, 0.5, 2};
    std::vector<float> values(8 * 8 * 4);
    for (float& v : values) v = uniform(random) > 0.6 ? 1.f : 0.f;
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{Vec3d{uniform(random), uniform(random), uniform(random)} * 3.0,
                      normalize(Vec3d{uniform(random), uniform(random), uniform(random)})};
        std::optional<double> nearest;
        for (std::uint32_t z = 0; z < 4; ++z)
            for (std::uint32_t y = 0; y < 8; ++y)
                for (std::uint32_t x = 0; x < 8; ++x) {
                    if (!isShown(grid, values[(z * 8 + y) * 8 + x])) continue;
                    const Vec3f low = grid.origin + Vec3f{grid.cell.x * float(x), grid.cell.y * float(y), grid.cell.z * float(z)};
                    if (distanceTo(ObjectBox::between(low, low + grid.cell), Ray{ray.origin + ray.direction * 1e-9, ray.direction})) {
                        // Inside of a cell, the walk begins with it at distance 0.
                        const Vec3d lo{low.x, low.y, low.z}, hi = lo + Vec3d{grid.cell.x, grid.cell.y, grid.cell.z};
                        const bool inside = ray.origin.x > lo.x && ray.origin.y > lo.y && ray.origin.z > lo.z && ray.origin.x < hi.x &&
                                            ray.origin.y < hi.y && ray.origin.z < hi.z;
                        const double distance = inside ? 0 : *distanceTo(ObjectBox::between(low, low + grid.cell), ray);
                        if (!nearest || distance < *nearest) nearest = distance;
                    }
                }
        const auto found = firstCell(grid, values, ray);
        ASSERT_EQ(found.has_value(), nearest.has_value()) << i;
        if (!found) continue;
        ++hits;
        EXPECT_NEAR(found->second, *nearest, 1e-5) << i;
        EXPECT_TRUE(isShown(grid, values[found->first]));
    }
    EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace emca::explorer
