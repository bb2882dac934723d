// A server may be wrong or hostile: pieces that do not fit together are refused, and memory follows what arrived.
#include "assemble.h"

#include <gtest/gtest.h>

namespace emca::client {
namespace {

using protocol::ImageRows;
using protocol::MeshPart;
using protocol::RenderResult;
using protocol::SceneChunk;

MeshPart part(std::uint32_t mesh, std::uint32_t firstVertex, std::uint32_t vertices, std::uint32_t firstTriangle, std::uint32_t triangles) {
    MeshPart result;
    result.mesh = mesh;
    result.vertexCount = 4;
    result.triangleCount = 2;
    result.firstVertex = firstVertex;
    result.firstTriangle = firstTriangle;
    result.positions = std::vector<Vec3f>(vertices);
    result.triangles = std::vector<Triangle>(triangles, Triangle{0, 1, 2});
    return result;
}

SceneChunk chunk(std::vector<MeshPart> parts, bool last, std::uint32_t meshes = 1) { return {meshes, 4, 2, std::move(parts), last}; }

TEST(SceneAssembler, PutsPartsTogether) {
    SceneAssembler scene;
    ASSERT_TRUE(scene.add(chunk({part(0, 0, 3, 0, 0)}, false)).ok());
    ASSERT_TRUE(scene.add(chunk({part(0, 3, 1, 0, 1)}, false)).ok());
    EXPECT_DOUBLE_EQ(scene.fraction(), 0.5);
    ASSERT_TRUE(scene.add(chunk({part(0, 4, 0, 1, 1)}, true)).ok());
    ASSERT_TRUE(scene.complete());
    const auto meshes = scene.take();
    ASSERT_EQ(meshes.size(), 1u);
    EXPECT_EQ(meshes[0].positions.size(), 4u);
    EXPECT_EQ(meshes[0].triangles.size(), 2u);
}

TEST(SceneAssembler, RefusesGapsOverlapsAndFalseCounts) {
    const auto refused = [](std::vector<SceneChunk> chunks) {
        SceneAssembler scene;
        for (std::size_t i = 0; i + 1 < chunks.size(); ++i) EXPECT_TRUE(scene.add(chunks[i]).ok());
        const auto result = scene.add(chunks.back());
        return !result.ok() && result.error().code == ErrorCode::protocolViolation;
    };
    EXPECT_TRUE(refused({chunk({part(0, 1, 3, 0, 0)}, false)})) << "gap at the begin";
    EXPECT_TRUE(refused({chunk({part(0, 0, 3, 0, 0), part(0, 2, 2, 0, 0)}, false)})) << "overlap";
    EXPECT_TRUE(refused({chunk({part(0, 0, 5, 0, 0)}, false)})) << "more vertices than announced";
    EXPECT_TRUE(refused({chunk({part(0, 0, 4, 0, 3)}, false)})) << "more triangles than announced";
    EXPECT_TRUE(refused({chunk({part(1, 0, 4, 0, 2)}, false)})) << "the first mesh is 0";
    EXPECT_TRUE(refused({chunk({part(0, 0, 3, 0, 2)}, true)})) << "ends early";
    EXPECT_TRUE(refused({chunk({part(0, 0, 3, 0, 2), part(1, 0, 4, 0, 2)}, true, 2)})) << "a mesh ends early";
    EXPECT_TRUE(refused({chunk({part(0, 0, 4, 0, 2)}, true, 2)})) << "a mesh is missing";
    EXPECT_TRUE(refused({chunk({part(0, 0, 4, 0, 2)}, true), chunk({}, true)})) << "goes on after its end";
    MeshPart bad = part(0, 0, 4, 0, 2);
    bad.triangles = std::vector<Triangle>{{0, 1, 2}, {0, 1, 4}};
    EXPECT_TRUE(refused({chunk({bad}, true)})) << "an index outside the vertices";
}

TEST(SceneAssembler, AFalseAnnouncementCostsNoMemory) {
    MeshPart huge = part(0, 0, 1, 0, 0);
    huge.vertexCount = huge.triangleCount = 0xffffffffu;
    SceneAssembler scene;
    ASSERT_TRUE(scene.add(chunk({huge}, false)).ok());
    EXPECT_LE(scene.take()[0].positions.capacity(), 1u << 22);
}

RenderResult announced(std::uint32_t width, std::uint32_t height) { return {1, {}, 0, width, height}; }

ImageRows rows(std::uint32_t first, std::uint32_t count, bool last, bool variance = true, std::uint32_t width = 2) {
    ImageRows result;
    result.firstRow = first;
    result.rowCount = count;
    result.colors = std::vector<Color>(std::size_t(count) * width, Color(1));
    result.samples = std::vector<float>(std::size_t(count) * width, 4);
    if (variance) result.variance = std::vector<Color>(std::size_t(count) * width);
    result.last = last;
    return result;
}

TEST(ImageAssembler, PutsRowsTogether) {
    ImageAssembler image;
    ASSERT_TRUE(image.begin(announced(2, 3)).ok());
    ASSERT_TRUE(image.add(rows(0, 2, false)).ok());
    ASSERT_FALSE(image.complete());
    ASSERT_TRUE(image.add(rows(2, 1, true)).ok());
    ASSERT_TRUE(image.complete());
    const Render render = image.take();
    EXPECT_EQ(render.image.color.color({1, 2}), Color(1));
    EXPECT_EQ(*render.image.samples.at({1, 2}), 4);
    EXPECT_EQ(render.image.variance.size(), 18u);
}

TEST(ImageAssembler, ARendererMayNotKnowVariances) {
    ImageAssembler image;
    ASSERT_TRUE(image.begin(announced(2, 1)).ok());
    ASSERT_TRUE(image.add(rows(0, 1, true, false)).ok());
    EXPECT_TRUE(image.take().image.variance.empty());
}

TEST(ImageAssembler, RefusesGapsOverlapsAndImpossibleSizes) {
    const auto refused = [](std::vector<ImageRows> all) {
        ImageAssembler image;
        EXPECT_TRUE(image.begin(announced(2, 3)).ok());
        for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_TRUE(image.add(all[i]).ok());
        return !image.add(all.back()).ok();
    };
    EXPECT_TRUE(refused({rows(1, 2, true)})) << "gap";
    EXPECT_TRUE(refused({rows(0, 2, false), rows(1, 2, true)})) << "overlap";
    EXPECT_TRUE(refused({rows(0, 4, true)})) << "more rows than announced";
    EXPECT_TRUE(refused({rows(0, 2, true)})) << "ends early";
    EXPECT_TRUE(refused({rows(0, 3, false)})) << "does not end";
    EXPECT_TRUE(refused({rows(0, 0, false)})) << "no rows";
    EXPECT_TRUE(refused({rows(0, 3, true, true, 3)})) << "too wide";
    EXPECT_TRUE(refused({rows(0, 2, false, true), rows(2, 1, true, false)})) << "variances for some rows only";
    EXPECT_TRUE(refused({rows(0, 2, false, false), rows(2, 1, true, true)})) << "variances for some rows only";
    ImageAssembler never;
    EXPECT_FALSE(never.add(rows(0, 1, true)).ok()) << "rows before their announcement";
    for (const auto& [w, h] : {std::pair{0u, 1u}, {1u, 0u}, {0xffffffffu, 0xffffffffu}, {65536u, 65536u}, {65537u, 1u}}) {
        ImageAssembler image;
        EXPECT_FALSE(image.begin(announced(w, h)).ok()) << w << " x " << h;
    }
    ImageAssembler twice;
    EXPECT_TRUE(twice.begin(announced(2, 1)).ok());
    EXPECT_FALSE(twice.begin(announced(2, 1)).ok());
}

}  // namespace
}  // namespace emca::client
