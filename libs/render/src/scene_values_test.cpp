#include "scene_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emca/render/scene_xml.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// The value of the property "p" that an element makes in a node of some kind.
template <typename T>
T valueOf(const std::string& element, const std::string& kind = "bsdf", const std::filesystem::path& path = "scene.xml") {
    const auto document = readSceneText("<scene version=\"3.0.0\"><" + kind + " type=\"t\">" + element + "</" + kind + "></scene>", path);
    EXPECT_TRUE(document.ok());
    for (const auto& d : document->diagnostics)
        ADD_FAILURE() << element << ": " << d.message;
    const auto& properties = document->root->children.at(0).node->properties;
    if (!properties.contains("p") || !std::holds_alternative<T>(properties.at("p").value)) {
        ADD_FAILURE() << element << " has no or another value";
        return T{};
    }
    return std::get<T>(properties.at("p").value);
}

std::string remarkOf(const std::string& element) {
    const auto document = readSceneText("<scene version=\"3.0.0\"><bsdf type=\"t\">" + element + "</bsdf></scene>", "scene.xml");
    EXPECT_TRUE(document.ok());
    EXPECT_EQ(document->diagnostics.size(), 1u) << element;
    return document->diagnostics.empty() ? "" : document->diagnostics.front().message;
}

Transform transformOf(const std::string& steps) { return valueOf<Transform>("<transform name=\"p\">" + steps + "</transform>"); }

void expectColor(Color a, Color b, float tolerance = 1e-5f) {
    EXPECT_NEAR(a.r, b.r, tolerance);
    EXPECT_NEAR(a.g, b.g, tolerance);
    EXPECT_NEAR(a.b, b.b, tolerance);
}

TEST(SceneValues, SnakeCase) {
    EXPECT_EQ(toSnakeCase("toWorld"), "to_world");
    EXPECT_EQ(toSnakeCase("to_world"), "to_world");
    EXPECT_EQ(toSnakeCase("intIOR"), "int_ior");
    EXPECT_EQ(toSnakeCase("toUV"), "to_uv");
    EXPECT_EQ(toSnakeCase("alphaU"), "alpha_u");
    EXPECT_EQ(toSnakeCase("flipTexCoords"), "flip_tex_coords");
    EXPECT_EQ(toSnakeCase("color0"), "color0");
    EXPECT_EQ(toSnakeCase("UVScale"), "uv_scale");
    EXPECT_EQ(toSnakeCase(""), "");
}

TEST(SceneValues, Scalars) {
    EXPECT_EQ(valueOf<double>(R"(<float name="p" value=" -1.5e-3 "/>)"), -1.5e-3);
    EXPECT_EQ(valueOf<double>(R"(<float name="p" value="+2"/>)"), 2);
    EXPECT_EQ(valueOf<std::int64_t>(R"(<integer name="p" value="-9000000000"/>)"), -9000000000);
    EXPECT_TRUE(valueOf<bool>(R"(<boolean name="p" value="True"/>)"));
    EXPECT_FALSE(valueOf<bool>(R"(<boolean name="p" value="false"/>)"));
    EXPECT_EQ(valueOf<std::string>(R"(<string name="p" value=" a b &amp; c "/>)"), " a b & c ");
    for (const char* bad : {"", "one", "1 2", "1,5", "nan", "inf", "1e999", "--1", "+-1", "0x10"})
        EXPECT_THAT(remarkOf(std::string("<float name=\"p\" value=\"") + bad + "\"/>"), HasSubstr("is not a finite number")) << bad;
}

TEST(SceneValues, PointsAndVectorsInBothNotations) {
    EXPECT_EQ(valueOf<Vec3f>(R"(<point name="p" x="1" y="-2" z="3.5"/>)"), (Vec3f{1, -2, 3.5f}));
    EXPECT_EQ(valueOf<Vec3f>(R"(<vector name="p" value="1, -2, 3.5"/>)"), (Vec3f{1, -2, 3.5f}));
    EXPECT_EQ(valueOf<Vec3f>(R"(<point name="p" value="1 -2 3.5"/>)"), (Vec3f{1, -2, 3.5f}));
    EXPECT_EQ(valueOf<Vec3f>(R"(<vector name="p" y="1"/>)"), (Vec3f{0, 1, 0}));
    EXPECT_THAT(remarkOf(R"(<point name="p" value="1 2"/>)"), HasSubstr("is not three finite numbers"));
    EXPECT_THAT(remarkOf(R"(<point name="p" x="a"/>)"), HasSubstr("(x) is not a finite number"));
}

TEST(SceneValues, Colours) {
    EXPECT_EQ(valueOf<Color>(R"(<rgb name="p" value="0.1, 0.2, 0.3"/>)"), Color(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(valueOf<Color>(R"(<rgb name="p" value="0.1 0.2 0.3"/>)"), Color(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(valueOf<Color>(R"(<rgb name="p" value="0.5" intent="reflectance"/>)"), Color(0.5f));
    EXPECT_EQ(valueOf<Color>(R"(<rgb name="p" value="#ff0033"/>)"), Color(1, 0, 0.2f));
    expectColor(valueOf<Color>(R"(<srgb name="p" value="#ffffff"/>)"), Color(1.f));
    expectColor(valueOf<Color>(R"(<srgb name="p" value="0.5, 0, 1"/>)"), Color(0.21404f, 0, 1));
    for (const char* bad : {"", "1 2", "1 2 3 4", "#12345", "#12345g", "#1234567", "red"})
        EXPECT_THAT(remarkOf(std::string("<rgb name=\"p\" value=\"") + bad + "\"/>"), HasSubstr("is not a colour")) << bad;
}

TEST(SceneValues, Spectra) {
    EXPECT_EQ(valueOf<Color>(R"(<spectrum name="p" value="0.7"/>)"), Color(0.7f));
    EXPECT_EQ(valueOf<Color>(R"(<spectrum name="p" value="0.1, 0.2, 0.3"/>)"), Color(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(valueOf<Color>(R"(<spectrum name="p" value="550:0.25"/>)"), Color(0.25f));
    expectColor(valueOf<Color>(R"(<spectrum name="p" value="300:0.5, 600:0.5 900:0.5"/>)"), Color(0.5f));
    const SpectrumSample ramp[] = {{400, 0.1}, {700, 0.2}};
    expectColor(valueOf<Color>(R"(<spectrum name="p" value="400:0.1, 700:0.2"/>)"), toRgb(ramp, SpectrumUse::ratio));
    // Light is not adapted: white is D65.
    expectColor(valueOf<Color>(R"(<spectrum name="p" value="400:0.1, 700:0.2"/>)", "emitter"), toRgb(ramp, SpectrumUse::light));
    EXPECT_THAT(remarkOf(R"(<spectrum name="p" value="400:0.1, 500"/>)"), HasSubstr("is not a spectrum"));
    EXPECT_THAT(remarkOf(R"(<spectrum name="p" filename="none.spd"/>)"), HasSubstr("none.spd\" does not exist"));
}

TEST(SceneValues, SpectrumFilesAreBesideTheScene) {
    const TemporaryFolder folder;
    folder.write("a.spd", "300 0.5\n900 0.5\n");
    expectColor(valueOf<Color>(R"(<spectrum name="p" filename="a.spd"/>)", "bsdf", folder.path() / "scene.xml"), Color(0.5f));
}

TEST(SceneValues, Blackbodies) {
    const Color expected = blackbodyRgb(5000) * 1e-3f;
    expectColor(valueOf<Color>(R"(<blackbody name="p" temperature="5000K" scale="1e-3"/>)", "emitter"), expected, 1e-3f);
    expectColor(valueOf<Color>(R"(<blackbody name="p" temperature="5000"/>)", "emitter") * 1e-3f, expected, 1e-3f);
    EXPECT_THAT(remarkOf(R"(<blackbody name="p" temperature="0"/>)"), HasSubstr("not a positive number of kelvins"));
}

TEST(SceneValues, TypedSpectraOfTheThirdDialect) {
    EXPECT_EQ(valueOf<Color>(R"(<spectrum type="uniform" name="p"><float name="value" value="0.3"/></spectrum>)"), Color(0.3f));
    EXPECT_EQ(valueOf<Color>(R"(<spectrum type="d65" name="p"><float name="scale" value="3"/></spectrum>)", "emitter"), Color(3.f));
    expectColor(valueOf<Color>(R"(<spectrum type="blackbody" name="p"><float name="temperature" value="3000"/></spectrum>)", "emitter") * 1e-3f,
                blackbodyRgb(3000) * 1e-3f);
    const SpectrumSample ramp[] = {{400, 0.1}, {700, 0.2}};
    const Color expected = toRgb(ramp, SpectrumUse::ratio);
    expectColor(valueOf<Color>(R"(<spectrum type="irregular" name="p"><string name="wavelengths" value="400, 700"/>
        <string name="values" value="0.1, 0.2"/></spectrum>)"), expected);
    expectColor(valueOf<Color>(R"(<spectrum type="regular" name="p"><float name="wavelengthMin" value="400"/><float name="wavelength_max" value="700"/>
        <string name="values" value="0.1, 0.15, 0.2"/></spectrum>)"), expected);
    EXPECT_THAT(remarkOf(R"(<spectrum type="irregular" name="p"><string name="values" value="1"/></spectrum>)"),
                HasSubstr("0 wavelengths and 1 values"));
}

TEST(SceneValues, TransformStepsAreAppliedInTheOrderOfTheFile) {
    EXPECT_EQ(transformOf(R"(<translate x="1"/>)").point({0, 0, 0}), (Vec3f{1, 0, 0}));
    EXPECT_EQ(transformOf(R"(<translate value="1, 2, 3"/>)").point({0, 0, 0}), (Vec3f{1, 2, 3}));
    EXPECT_EQ(transformOf(R"(<scale value="2"/>)").point({1, 1, 1}), (Vec3f{2, 2, 2}));
    EXPECT_EQ(transformOf(R"(<scale x="2" z="3"/>)").point({1, 1, 1}), (Vec3f{2, 1, 3}));
    EXPECT_EQ(transformOf(R"(<rotate z="1" angle="90"/>)").point({1, 0, 0}), (Vec3f{0, 1, 0}));
    EXPECT_EQ(transformOf(R"(<rotate value="0, 0, 1" angle="-90"/>)").point({1, 0, 0}), (Vec3f{0, -1, 0}));
    EXPECT_EQ(transformOf(R"(<matrix value="1 0 0 5, 0 1 0 6, 0 0 1 7, 0 0 0 1"/>)").point({1, 1, 1}), (Vec3f{6, 7, 8}));
    EXPECT_EQ(transformOf(R"(<matrix value="0 2 0 1 0 0 0 0 1"/>)").point({1, 2, 3}), (Vec3f{4, 1, 3}));
    EXPECT_EQ(transformOf(R"(<lookat origin="1 2 3" target="1, 2, 8" up="0, 1, 0"/>)").point({0, 0, 1}), (Vec3f{1, 2, 4}));
    EXPECT_EQ(transformOf(R"(<scale value="2"/><translate x="1"/>)").point({1, 0, 0}), (Vec3f{3, 0, 0}));
    EXPECT_EQ(transformOf(R"(<translate x="1"/><scale value="2"/>)").point({1, 0, 0}), (Vec3f{4, 0, 0}));
    EXPECT_EQ(transformOf(""), Transform());
}

TEST(SceneValues, BadTransformStepsAreSaid) {
    const auto remark = [](const std::string& step) { return remarkOf("<transform name=\"p\">" + step + "</transform>"); };
    EXPECT_THAT(remark(R"(<rotate angle="3"/>)"), HasSubstr("rotate has no axis"));
    EXPECT_THAT(remark(R"(<rotate x="1"/>)"), HasSubstr("no attribute \"angle\""));
    EXPECT_THAT(remark(R"(<matrix value="1 2 3"/>)"), HasSubstr("not a matrix"));
    EXPECT_THAT(remark(R"(<lookat origin="1 1 1" target="1 1 1"/>)"), HasSubstr("same origin and target"));
    EXPECT_THAT(remark(R"(<shear x="1"/>)"), HasSubstr("<shear> in a transform is not known"));
}

}  // namespace
}  // namespace emca::render
