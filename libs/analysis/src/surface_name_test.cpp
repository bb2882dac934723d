#include "emca/analysis/surface_name.h"

#include <gtest/gtest.h>

namespace emca::analysis {
namespace {

TEST(SurfaceName, IsTheScenesWhereItHasOne) {
    std::vector<Mesh> meshes(3);
    meshes[1].name = "lamp";
    EXPECT_EQ(surfaceName({1, 12}, meshes), "lamp, face 12");
    EXPECT_EQ(surfaceName({0, 12}, meshes), "mesh 0, face 12") << "without a name";
    EXPECT_EQ(surfaceName({3, 0}, meshes), "mesh 3, face 0") << "beyond the scene";
    EXPECT_EQ(surfaceName({-1, 0}, meshes), "mesh -1, face 0");
    EXPECT_EQ(surfaceName({1, 12}, {}), "mesh 1, face 12") << "the scene did not come";
    EXPECT_EQ(meshName(1, meshes), "lamp");
}

}  // namespace
}  // namespace emca::analysis
