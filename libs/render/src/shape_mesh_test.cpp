#include "emca/render/shape_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emca/render/scene_xml.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

struct Shape {
    explicit Shape(const std::string& element, const std::filesystem::path& path = "scene.xml") {
        const auto document = readSceneText("<scene version=\"3.0.0\">" + element + "</scene>", path);
        PropertyReader reader(*document->root->children.at(0).node, diagnostics, document->searchFolders);
        geometry = readShapeGeometry(reader);
        reader.reportUnused();
    }
    std::vector<Diagnostic> diagnostics;
    Result<ShapeGeometry> geometry = Error{};
};

Vec3f faceNormal(const TriangleMesh& mesh, std::size_t i) {
    const auto& [a, b, c] = mesh.triangles.at(i);
    return normalize(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
}

TEST(ShapeMesh, ShapesAreMovedToTheWorld) {
    const Shape rectangle(R"(<shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="5"/></transform></shape>)");
    ASSERT_TRUE(rectangle.geometry.ok());
    EXPECT_EQ(rectangle.geometry->mesh.positions.front(), (Vec3f{-2, -2, 5}));
    EXPECT_EQ(faceNormal(rectangle.geometry->mesh, 0), (Vec3f{0, 0, 1}));
    EXPECT_THAT(rectangle.diagnostics, IsEmpty());
    EXPECT_THAT(Shape(R"(<shape type="cube"/>)").geometry->mesh.triangles, SizeIs(12));
}

TEST(ShapeMesh, FlippedShapesLookTheOtherWay) {
    for (const char* type : {"rectangle", "disk"}) {
        const Shape shape(std::string("<shape type=\"") + type + "\"><boolean name=\"flipNormals\" value=\"true\"/></shape>");
        EXPECT_TRUE(shape.geometry->flipped);
        EXPECT_EQ(faceNormal(shape.geometry->mesh, 3 % shape.geometry->mesh.triangles.size()), (Vec3f{0, 0, -1}));
        EXPECT_THAT(shape.diagnostics, IsEmpty());
    }
}

TEST(ShapeMesh, MirroredRectanglesKeepLookingWhereTheirNormalGoes) {
    const Shape shape(R"(<shape type="rectangle"><transform name="to_world"><scale x="-1"/></transform></shape>)");
    EXPECT_EQ(faceNormal(shape.geometry->mesh, 0), (Vec3f{0, 0, 1}));
}

TEST(ShapeMesh, SpheresStayAnalyticUnlessTheyAreStretched) {
    const Shape sphere(R"(<shape type="sphere"><point name="center" x="1" y="0" z="0"/><float name="radius" value="2"/>
        <transform name="toWorld"><scale value="-3"/><rotate x="1" y="2" angle="33"/><translate y="1"/></transform></shape>)");
    ASSERT_TRUE(sphere.geometry.ok() && sphere.geometry->sphere.has_value());
    EXPECT_NEAR(sphere.geometry->sphere->radius, 6, 1e-5);
    for (const auto& p : sphere.geometry->mesh.positions)
        EXPECT_NEAR(length(p - sphere.geometry->sphere->center), 6, 1e-4);
    EXPECT_THAT(sphere.diagnostics, IsEmpty());

    const Shape stretched("\n<shape type=\"sphere\"><transform name=\"toWorld\"><scale x=\"2\"/></transform></shape>");
    ASSERT_TRUE(stretched.geometry.ok());
    EXPECT_FALSE(stretched.geometry->sphere.has_value());
    ASSERT_THAT(stretched.diagnostics, SizeIs(1));
    EXPECT_THAT(stretched.diagnostics[0].message, HasSubstr("stretched"));
    EXPECT_EQ(stretched.diagnostics[0].where.line, 2);
}

TEST(ShapeMesh, FilesAreLoadedWithTheirWarnings) {
    const TemporaryFolder folder;
    folder.write("models/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nf 1/1 2/1 3/1\nf 1 2 8\n");
    const Shape shape(R"(<shape type="obj" id="M"><string name="filename" value="models/m.obj"/>
        <boolean name="faceNormals" value="true"/><bsdf type="diffuse"/></shape>)", folder.path() / "scene.xml");
    ASSERT_TRUE(shape.geometry.ok()) << shape.geometry.error().message;
    EXPECT_THAT(shape.geometry->mesh.normals, IsEmpty());
    EXPECT_EQ(shape.geometry->mesh.uvs.at(0), (Vec2f{0, 0.75f}));
    ASSERT_THAT(shape.diagnostics, SizeIs(2));  // the bsdf was left for others
    EXPECT_THAT(shape.diagnostics[0].message, HasSubstr("name a vertex that is not there"));
}

TEST(ShapeMesh, MissingFilesAreSaidAsWrittenAndAsSought) {
    const Shape shape(R"(<shape type="ply" id="M"><string name="filename" value="models/gone.ply"/></shape>)", "/some/where/scene.xml");
    ASSERT_FALSE(shape.geometry.ok());
    EXPECT_EQ(shape.geometry.error().code, ErrorCode::fileNotFound);
    EXPECT_THAT(shape.geometry.error().message,
                AllOf(HasSubstr("shape \"ply\" (M) cannot load \"models/gone.ply\""), HasSubstr("\"/some/where/models/gone.ply\" does not exist.")));
}

TEST(ShapeMesh, ShapesThatCannotBeAreRefused) {
    const auto code = [](const std::string& element) { return Shape(element).geometry.error().code; };
    EXPECT_EQ(code(R"(<shape type="teapot"/>)"), ErrorCode::notSupported);
    EXPECT_EQ(code(R"(<shape type="obj"/>)"), ErrorCode::invalidArgument);
    EXPECT_EQ(code(R"(<shape type="sphere"><float name="radius" value="0"/></shape>)"), ErrorCode::invalidArgument);
    EXPECT_EQ(code(R"(<shape type="sphere"><float name="radius" value="1e300"/></shape>)"), ErrorCode::invalidArgument);
    EXPECT_EQ(code(R"(<shape type="cube"><transform name="to_world"><scale z="0"/></transform></shape>)"), ErrorCode::invalidArgument);
    EXPECT_EQ(code(R"(<shape type="cube"><transform name="to_world"><scale value="1e60"/></transform></shape>)"), ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace emca::render
