#include "layer_ply.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "ply_for_tests.h"

namespace emca::cli {
namespace {

/// Two triangles, the first divided once; a second mesh without values.
struct Scene {
    Scene() : meshes(2) {
        meshes[0].positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
        meshes[0].triangles = {{0, 1, 2}, {0, 2, 3}};
        meshes[1].positions = {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}};
        meshes[1].triangles = {{0, 1, 2}};
        field.meshes = {{{{1}}, 0, 5}, {{}, 5, 0}};
        field.points = std::vector<float>{1, 1, 1, 1, 1};
    }
    Ply written(LayerDescription description, std::vector<float> values) {
        field.layers = {{std::move(description), std::move(values), 7, 8}};
        EXPECT_TRUE(validate(field, meshes).ok());
        picture = pictureOf(field, field.layers[0], meshes);
        std::ostringstream out;
        const auto faces = writePly(out, field, field.layers[0], meshes, picture, {"scene: a\nb"});
        EXPECT_TRUE(faces.ok());
        EXPECT_EQ(*faces, 6u);
        return parsePly(out.str());
    }
    std::vector<Mesh> meshes;
    SurfaceField field;
    LayerPicture picture;
};

std::array<std::uint8_t, 3> bytes(analysis::Color8 c) { return {c.r, c.g, c.b}; }

TEST(LayerPly, ADensity) {
    Scene scene;
    const Ply ply = scene.written({"hits", LayerKind::density, "1/m^2", "one\nline"}, {1, 2, 3, 4, 5});
    ASSERT_EQ(ply.vertices.size(), 10u) << "four corners, three midpoints, three corners of the other mesh";
    ASSERT_EQ(ply.faces.size(), 6u);
    for (std::size_t f = 0; f < 5; ++f) {
        EXPECT_EQ(ply.faces[f].quality, static_cast<float>(f + 1));
        EXPECT_EQ(ply.faces[f].color, bytes(scene.picture.colors[f]));
    }
    EXPECT_EQ(ply.faces[0].color, bytes(analysis::ColorMap::get(analysis::ColorMapId::viridis).map(0.0)));
    EXPECT_EQ(ply.faces[4].color, bytes(analysis::ColorMap::get(analysis::ColorMapId::viridis).map(1.0)));
    EXPECT_EQ(ply.faces[5].quality, 0) << "no sample: the density is 0";
    EXPECT_EQ(ply.vertices.at(ply.faces[5].vertices[2]), (Vec3f{9, 0, 1})) << "vertices count on from mesh to mesh";
    EXPECT_EQ(ply.vertices.at(ply.faces[4].vertices[2]), (Vec3f{0, 2, 0}));
    EXPECT_NE(ply.header.find("comment description: one?line\n"), std::string::npos) << "one line stays one line";
    EXPECT_NE(ply.header.find("comment scene: a?b\n"), std::string::npos);
    EXPECT_EQ(ply.header.find("property float r"), std::string::npos);
    EXPECT_DOUBLE_EQ(scene.picture.statistics.area, 4);
    EXPECT_DOUBLE_EQ(scene.picture.statistics.mean, (1 + 2 + 3 + 4) * 0.5 / 4 + 5 * 2 / 4.);
}

TEST(LayerPly, AMeanWithoutDataSomewhere) {
    Scene scene;
    const float none = std::numeric_limits<float>::quiet_NaN();
    const Ply ply = scene.written({"weight", LayerKind::mean, "", ""}, {none, 2, 3, 4, 5});
    EXPECT_TRUE(std::isnan(ply.faces[0].quality));
    EXPECT_EQ(ply.faces[0].color, bytes(analysis::kNoDataColor));
    EXPECT_EQ(ply.faces[5].color, bytes(analysis::kNoDataColor));
    EXPECT_NE(ply.header.find("comment unit: none\n"), std::string::npos);
    EXPECT_EQ(ply.header.find("comment description"), std::string::npos);
}

TEST(LayerPly, AColour) {
    Scene scene;
    std::vector<float> values;
    for (int f = 0; f < 5; ++f) values.insert(values.end(), {0.25f, 0.5f, 4});
    const Ply ply = scene.written({"radiance", LayerKind::meanColor, "W/(sr m^2)", ""}, values);
    EXPECT_EQ(ply.faces[2].rgb, (std::array<float, 3>{0.25f, 0.5f, 4}));
    EXPECT_EQ(ply.faces[2].quality, luminance(Color(0.25f, 0.5f, 4)));
    EXPECT_EQ(ply.faces[2].color, bytes(scene.picture.colors[2]));
    EXPECT_TRUE(std::isnan(ply.faces[5].rgb[1]));
    EXPECT_EQ(ply.faces[5].color, bytes(analysis::kNoDataColor));
    EXPECT_NE(ply.header.find("exposure"), std::string::npos);
}

}  // namespace
}  // namespace emca::cli
