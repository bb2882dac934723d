#include "emca/adapter/parametric_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace emca::adapter {
namespace {

Vec3f onUnitSphere(Vec2f uv) {
    const float phi = 2 * std::numbers::pi_v<float> * uv.x, theta = std::numbers::pi_v<float> * uv.y;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
Vec3f onPlane(Vec2f uv) { return {uv.x, uv.y, 0}; }

Vec3f normalOf(const Mesh& mesh, const Triangle& t) {
    return cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
}

/// Whether a point of the plane z = 0 lies in a triangle, or within rounding of it.
bool contains(const Mesh& mesh, const Triangle& t, Vec3f p) {
    for (int i = 0; i < 3; ++i) {
        const Vec3f from = mesh.positions[t[i]], to = mesh.positions[t[(i + 1) % 3]];
        if (cross(to - from, p - from).z < -1e-6f) return false;
    }
    return true;
}

TEST(ParametricMesh, EveryParameterLiesInItsFace) {
    for (const ParametricMesh grid : {ParametricMesh{1, 1}, ParametricMesh{5, 3}, ParametricMesh{4, 7}}) {
        const Mesh mesh = grid.mesh(onPlane);
        ASSERT_TRUE(validate(mesh));
        ASSERT_EQ(mesh.triangles.size(), grid.faceCount());
        for (float u = 0; u <= 1.f; u += 0.017f)
            for (float v = 0; v <= 1.f; v += 0.013f) {
                const std::int32_t face = grid.face({u, v});
                ASSERT_TRUE(contains(mesh, mesh.triangles.at(static_cast<std::size_t>(face)), {u, v, 0})) << u << ' ' << v << " in " << face;
            }
    }
}

TEST(ParametricMesh, PolesHaveOneTriangleACellAndNoneIsDegenerate) {
    const ParametricMesh sphere{.columns = 48, .rows = 24, .firstRowIsPoint = true, .lastRowIsPoint = true, .flipped = true};
    const Mesh mesh = sphere.mesh(onUnitSphere);
    ASSERT_TRUE(validate(mesh));
    ASSERT_EQ(mesh.triangles.size(), 48u * 46u);
    float area = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3f normal = normalOf(mesh, t);
        area += length(normal) / 2;
        EXPECT_GT(length(normal), 1e-5f);
        EXPECT_GT(dot(normal, mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]), 0.f);  // outwards
    }
    EXPECT_NEAR(area, 4 * std::numbers::pi_v<float>, 0.05f);
}

TEST(ParametricMesh, AFaceOfASphereIsNearItsPoint) {
    const ParametricMesh sphere{.columns = 48, .rows = 24, .firstRowIsPoint = true, .lastRowIsPoint = true};
    const Mesh mesh = sphere.mesh(onUnitSphere);
    for (float u = 0; u < 1.f; u += 0.0173f)
        for (float v = 0; v <= 1.f; v += 0.0119f) {
            const Triangle& t = mesh.triangles.at(static_cast<std::size_t>(sphere.face({u, v})));
            const Vec3f centre = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.f;
            EXPECT_LT(length(centre - onUnitSphere({u, v})), 0.16f);  // a cell is 0.131 long
        }
}

TEST(ParametricMesh, WhatLiesOutsideIsTakenToTheEdge) {
    const ParametricMesh grid{.columns = 4, .rows = 2};
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
    EXPECT_EQ(grid.face({nan, nan}), 0);
    EXPECT_EQ(grid.face({-huge, -1}), 0);
    EXPECT_EQ(grid.face({huge, 7}), 14);
    EXPECT_EQ(grid.face({1, 1}), 14);
}

}  // namespace
}  // namespace emca::adapter
