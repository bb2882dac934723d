#include "emca/core/mesh.h"

#include <gtest/gtest.h>

#include <limits>

namespace emca {
namespace {

TEST(Mesh, BoundingBoxIgnoresNonFiniteVertices) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 2, 3}, {std::numeric_limits<float>::quiet_NaN(), 9, 9}};
    const BoundingBox box = boundingBox({mesh});
    EXPECT_EQ(box.max, (Vec3f{1, 2, 3}));
    EXPECT_EQ(box.min, (Vec3f{0, 0, 0}));
}

TEST(Mesh, ValidateNamesTheBadTriangle) {
    Mesh mesh;
    mesh.name = "teapot";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_TRUE(validate(mesh).ok());
    mesh.triangles.push_back({0, 1, 3});
    const auto result = validate(mesh);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find("Triangle 1 of mesh \"teapot\""), std::string::npos) << result.error().message;
}

}  // namespace
}  // namespace emca
