#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emca/render/mesh_files.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Result<LoadedMesh> load(const std::string& text, const MeshFileOptions& options = {}) {
    const TemporaryFolder folder;
    return loadObj(folder.write("mesh.obj", text), options);
}

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjFile, SplitsPolygonsIntoTriangles) {
    const auto loaded = load("# a pentagon\n" + kQuad + "v -1 0.5 0\no name\ng group\nusemtl m\ns off\nf 1 2 3 4 5\n");
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_THAT(loaded->warnings, IsEmpty());
    EXPECT_THAT(loaded->mesh.positions, SizeIs(5));
    EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
    EXPECT_THAT(loaded->mesh.uvs, IsEmpty());
}

TEST(ObjFile, UnderstandsAllKindsOfCorners) {
    const std::string lists = kQuad + "vt 0.25 0.5\nvn 0 0 2\n";
    for (const char* face : {"f 1/1/1 2/1/1 3/1/1", "f -4/-1/-1 -3/-1/-1 -2/-1/-1", "f\t1/1/1  2/1/1 \\\n 3/1/1 # comment", "f 1/1/1 2/1/1 3/1/1\r"}) {
        const auto loaded = load(lists + face);
        ASSERT_TRUE(loaded.ok()) << loaded.error().message;
        EXPECT_THAT(loaded->mesh.positions, ElementsAre(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{1, 1, 0})) << face;
        EXPECT_THAT(loaded->mesh.uvs, ElementsAre(Vec2f{0.25f, 0.5f}, Vec2f{0.25f, 0.5f}, Vec2f{0.25f, 0.5f})) << face;
        EXPECT_THAT(loaded->mesh.normals, ElementsAre(Vec3f{0, 0, 1}, Vec3f{0, 0, 1}, Vec3f{0, 0, 1})) << face;
    }
    for (const char* face : {"f 1 2 3", "f 1// 2// 3//", "f 1/ 2/ 3/", "f 1//1 2//1 3//1", "f 1/1 2/1 3/1", "f 1/1/ 2/1/ 3/1/"}) {
        const auto loaded = load(lists + face);
        ASSERT_TRUE(loaded.ok()) << face << loaded.error().message;
        EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2})) << face;
    }
}

TEST(ObjFile, VerticesAreSharedOnlyIfAllTheirPartsAre) {
    const auto loaded = load(kQuad + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\n");
    ASSERT_TRUE(loaded.ok());
    EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 3, 4}));
    EXPECT_THAT(loaded->mesh.positions, SizeIs(5));
}

TEST(ObjFile, FaceNormalsForgetNormalsAndOtherwiseTheyAreComputed) {
    EXPECT_THAT(load(kQuad + "vn 0 0 1\nf 1//1 2//1 3//1", {.faceNormals = true})->mesh.normals, IsEmpty());
    const auto computed = load(kQuad + "f 1 2 3 4");
    EXPECT_THAT(computed->mesh.normals, ElementsAre(Vec3f{0, 0, 1}, Vec3f{0, 0, 1}, Vec3f{0, 0, 1}, Vec3f{0, 0, 1}));
    // Where only some corners have one, the others get theirs from the faces.
    const auto mixed = load(kQuad + "vn 1 0 1\nf 1//1 2 3");
    EXPECT_NEAR(mixed->mesh.normals[0].x, std::sqrt(0.5f), 1e-6);
    EXPECT_EQ(mixed->mesh.normals[1], (Vec3f{0, 0, 1}));
}

TEST(ObjFile, FacesTurnToTheirNormals) {
    const auto loaded = load(kQuad + "vn 0 0 -1\nf 1//1 2//1 3//1");
    EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 2, 1}));
}

TEST(ObjFile, FlipsTextureCoordinates) {
    const auto loaded = load(kQuad + "vt 0.25 0.25\nf 1/1 2/1 3/1", {.flipTexCoords = true});
    EXPECT_EQ(loaded->mesh.uvs[0], (Vec2f{0.25f, 0.75f}));
}

TEST(ObjFile, FacesThatCannotBeAreLeftOutAndTheRestLoads) {
    const auto loaded = load(kQuad + "v nan 0 0\nv 1e999 0 0\nf 1 2 3\nf 1 2 9\nf 0 1 2\nf -9 1 2\nf 1 2 5\nf 1 2 6\nf 1/7 2/7 3/7\nf 1 2\n");
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_THAT(loaded->mesh.triangles, SizeIs(1));
    for (const auto& p : loaded->mesh.positions)
        EXPECT_TRUE(isFinite(p));
    EXPECT_THAT(loaded->warnings, ElementsAre(AllOf(HasSubstr("4 triangles"), HasSubstr("mesh.obj"), HasSubstr("first is triangle 1,")),
                                              AllOf(HasSubstr("2 triangles"), HasSubstr("not finite"), HasSubstr("first is triangle 4,")),
                                              HasSubstr("1 faces")));
}

TEST(ObjFile, PositiveIndicesMayReferToLaterVertices) {
    EXPECT_THAT(load("f 1 2 3\n" + kQuad)->mesh.triangles, SizeIs(1));
}

TEST(ObjFile, WhatIsNoObjFileIsRefusedWithItsLine) {
    const auto message = [](const std::string& text) {
        const auto loaded = load(text);
        EXPECT_FALSE(loaded.ok()) << text;
        return loaded.ok() ? "" : loaded.error().message;
    };
    EXPECT_THAT(message("v 1 2\n"), AllOf(HasSubstr("mesh.obj:1:"), HasSubstr("after \"v\"")));
    EXPECT_THAT(message(kQuad + "\nf 1 2 x\n"), HasSubstr("mesh.obj:6:"));
    EXPECT_THAT(message(kQuad + "f 1/2/3/4 2 3\n"), HasSubstr("mesh.obj:5:"));
    EXPECT_THAT(message(kQuad + "f\n"), HasSubstr("mesh.obj:5:"));
    EXPECT_THAT(message(""), HasSubstr("no usable triangle"));
    EXPECT_THAT(message(kQuad + "f 7 8 9\n"), HasSubstr("name a vertex that is not there"));
    EXPECT_EQ(loadObj("/nowhere/mesh.obj", {}).error().code, ErrorCode::fileNotFound);
    EXPECT_EQ(loadObj("/", {}).error().code, ErrorCode::fileUnreadable);
}

TEST(ObjFile, EveryTruncationIsAMeshOrAnError) {
    const TemporaryFolder folder;
    const std::string text = kQuad + "vt 0.25 0.5\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -1 -2 -3 \\\n -4\n";
    for (std::size_t length = 0; length <= text.size(); ++length) {
        const auto loaded = loadObj(folder.write("mesh.obj", text.substr(0, length)), {});
        if (!loaded) {
            EXPECT_THAT(loaded.error().message, HasSubstr("mesh.obj")) << length;
            continue;
        }
        for (const auto& t : loaded->mesh.triangles)
            for (const auto index : t)
                ASSERT_LT(index, loaded->mesh.positions.size()) << length;
    }
}

}  // namespace
}  // namespace emca::render
