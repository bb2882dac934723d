#include "emca/render/scene_xml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Every remark is a sentence.
std::string withoutStop(const std::string& sentence) {
    EXPECT_TRUE(sentence.ends_with('.')) << sentence;
    return sentence.substr(0, sentence.size() - 1);
}

std::vector<std::string> messages(const SceneDocument& document) {
    std::vector<std::string> texts;
    for (const auto& d : document.diagnostics)
        texts.push_back(d.where.text() + ": " + withoutStop(d.message));
    return texts;
}

SceneDocument read(const std::string& content, const SceneDefines& defines = {}) {
    auto document = readSceneText("<scene version=\"3.0.0\">" + content + "</scene>", "scene.xml", defines);
    EXPECT_TRUE(document.ok()) << document.error().message;
    return document.ok() ? *document : SceneDocument{std::make_shared<SceneNode>(), {}, {}, {}};
}

template <typename T>
T property(const SceneNode& node, const std::string& name) {
    const auto found = node.properties.find(name);
    EXPECT_TRUE(found != node.properties.end()) << "no property " << name;
    if (found == node.properties.end() || !std::holds_alternative<T>(found->second.value)) {
        ADD_FAILURE() << name << " has another type";
        return T{};
    }
    return std::get<T>(found->second.value);
}

const SceneNode& child(const SceneDocument& document, std::size_t i) { return *document.root->children.at(i).node; }

TEST(SceneXml, ReadsNodesWithTheirKindTypeIdAndLine) {
    const auto document = read("\n<!-- a\n comment -->\n<shape type=\"obj\" id=\"Floor\">\n\n<string name=\"filename\"\nvalue=\"a.obj\"/>\n"
                               "<bsdf type=\"diffuse\" name=\"inside\"/></shape>");
    EXPECT_THAT(messages(document), IsEmpty());
    const SceneNode& shape = child(document, 0);
    EXPECT_EQ(shape.kind, "shape");
    EXPECT_EQ(shape.type, "obj");
    EXPECT_EQ(shape.id, "Floor");
    EXPECT_EQ(shape.where.text(), "scene.xml:4");
    EXPECT_EQ(shape.properties.at("filename").where.text(), "scene.xml:6");
    EXPECT_EQ(property<std::string>(shape, "filename"), "a.obj");
    ASSERT_THAT(shape.children, SizeIs(1));
    EXPECT_EQ(shape.children[0].name, "inside");
    EXPECT_EQ(shape.children[0].where.line, 8);
}

TEST(SceneXml, LinesAreRightWithWindowsLineEndsAndByteOrderMark) {
    const auto document = readSceneText("\xef\xbb\xbf<scene version=\"3.0.0\">\r\n\r\n<bsdf type=\"diffuse\"/>\r\n<foo/></scene>", "a.xml");
    ASSERT_TRUE(document.ok());
    EXPECT_EQ(child(*document, 0).where.line, 3);
    EXPECT_EQ(document->diagnostics.at(0).where.line, 4);
}

TEST(SceneXml, SpellsBothDialectsAlike) {
    const char* old = R"(<scene version="0.6.0"><sensor type="thinlens"><transform name="toWorld"><lookAt origin="0 0 5" target="0,0,0" up="0 1 0"/>
        </transform><float name="apertureRadius" value="2"/></sensor><bsdf type="roughdielectric"><float name="intIOR" value="1.5"/>
        <rgb name="specularTransmittance" value="1"/><float name="alphaU" value="1"/><texture type="checkerboard" name="specularReflectance">
        <transform name="toUV"><scale x="2" y="3"/></transform></texture></bsdf><luminaire type="point"/><camera type="perspective"/></scene>)";
    const char* modern = R"(<scene version="3.5.0"><sensor type="thinlens"><transform name="to_world"><lookat origin="0, 0, 5" target="0,0,0" up="0,1,0"/>
        </transform><float name="aperture_radius" value="2"/></sensor><bsdf type="roughdielectric"><float name="int_ior" value="1.5"/>
        <rgb name="specular_transmittance" value="1, 1, 1"/><float name="alpha_u" value="1"/><texture type="checkerboard" name="specular_reflectance">
        <transform name="to_uv"><scale value="2 3 1"/></transform></texture></bsdf><emitter type="point"/><sensor type="perspective"/></scene>)";
    const auto a = readSceneText(old, "a.xml"), b = readSceneText(modern, "b.xml");
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_THAT(messages(*a), IsEmpty());
    EXPECT_THAT(messages(*b), IsEmpty());
    ASSERT_EQ(a->root->children.size(), b->root->children.size());
    for (std::size_t i = 0; i < 4; ++i) {
        const SceneNode &x = child(*a, i), &y = child(*b, i);
        EXPECT_EQ(x.kind, y.kind);
        ASSERT_EQ(x.properties.size(), y.properties.size());
        for (const auto& [name, entry] : x.properties) {
            ASSERT_TRUE(y.properties.contains(name)) << name;
            EXPECT_TRUE(entry.value == y.properties.at(name).value) << name;
        }
    }
    EXPECT_EQ(child(*a, 1).children.at(0).name, "specular_reflectance");
    EXPECT_EQ(property<Transform>(*child(*a, 1).children[0].node, "to_uv"), Transform::scale({2, 3, 1}));
    EXPECT_EQ(property<double>(child(*a, 1), "int_ior"), 1.5);
}

TEST(SceneXml, DefaultsAreReplacedAlsoInTypesAndInsideOfText) {
    const std::string content = R"(<default name="spp" value="64"/><default name="kind" value="path"/><default name="s" value="wrong"/>
        <integrator type="$kind"><integer name="n" value="$spp"/><string name="out" value="a_$spp.exr"/></integrator>)";
    const auto document = read(content);
    EXPECT_THAT(messages(document), IsEmpty());
    EXPECT_EQ(child(document, 0).type, "path");
    EXPECT_EQ(property<std::int64_t>(child(document, 0), "n"), 64);
    EXPECT_EQ(property<std::string>(child(document, 0), "out"), "a_64.exr");

    const auto other = read(content, {{"spp", "8"}, {"kind", "volpath"}});
    EXPECT_THAT(messages(other), IsEmpty());
    EXPECT_EQ(child(other, 0).type, "volpath");
    EXPECT_EQ(property<std::int64_t>(child(other, 0), "n"), 8);
}

TEST(SceneXml, UnknownNamesAndUselessDefinesAreSaid) {
    const auto document = read("\n<default name=\"idle\" value=\"1\"/>\n<bsdf type=\"diffuse\" id=\"$who\"/>", {{"ssp", "8"}, {"idle", "2"}});
    EXPECT_THAT(messages(document),
                ElementsAre("scene.xml:3: $who is not a name that the scene declares with <default> or that was given a value",
                            "scene.xml:1: the value given for $idle changes nothing: the scene declares that name but does not use it",
                            "scene.xml:1: the value given for $ssp changes nothing: the scene does not use that name"));
}

TEST(SceneXml, DefaultsThatDoubleEachOtherStayBounded) {
    std::string content = "<default name=\"a0\" value=\"0123456789\"/>";
    for (int i = 1; i < 60; ++i)
        content += "<default name=\"b" + std::to_string(i) + "\" value=\"$" + (i == 1 ? "a0" : "b" + std::to_string(i - 1)) + "$" +
                   (i == 1 ? "a0" : "b" + std::to_string(i - 1)) + "\"/>";
    read(content + "<string name=\"s\" value=\"$b59\"/>");
}

TEST(SceneXml, ReferencesShareOneNodeBeforeAndAfterIt) {
    const auto document = read(R"(<shape type="a"><ref id="M"/></shape><bsdf type="diffuse" id="M"/>
        <shape type="b"><ref name="outside" id="M"/></shape><alias id="M" as="N"/><shape type="c"><ref id="N"/></shape>)");
    EXPECT_THAT(messages(document), IsEmpty());
    const auto material = document.root->children.at(1).node;
    EXPECT_EQ(child(document, 0).children.at(0).node, material);
    EXPECT_EQ(child(document, 2).children.at(0).node, material);
    EXPECT_EQ(child(document, 2).children.at(0).name, "outside");
    EXPECT_EQ(child(document, 3).children.at(0).node, material);
}

TEST(SceneXml, ReferencesToNothingAndInCirclesAreLeftOut) {
    const auto document = read("\n<shape type=\"a\"><ref id=\"Nobody\"/></shape>\n<bsdf type=\"b\" id=\"B\"><ref id=\"C\"/></bsdf>\n"
                               "<bsdf type=\"c\" id=\"C\"><ref id=\"B\"/></bsdf>\n<bsdf type=\"d\" id=\"D\"><ref id=\"D\"/></bsdf>"
                               "<alias id=\"X\" as=\"Y\"/><alias id=\"Y\" as=\"X\"/><ref id=\"X\"/>");
    EXPECT_THAT(messages(document), ElementsAre("scene.xml:2: ref to \"Nobody\", but nothing has that id; it is ignored",
                                                "scene.xml:5: ref to \"X\", but nothing has that id; it is ignored",
                                                "scene.xml:4: ref to \"B\" makes a circle; it is ignored",
                                                "scene.xml:5: ref to \"D\" makes a circle; it is ignored"));
    EXPECT_THAT(child(document, 0).children, IsEmpty());
    EXPECT_EQ(child(document, 1).children.at(0).node, document.root->children.at(2).node);
    EXPECT_THAT(child(document, 2).children, IsEmpty());
}

TEST(SceneXml, TakenIdsAreSaid) {
    const auto document = read("<bsdf type=\"a\" id=\"M\"/>\n<bsdf type=\"b\" id=\"M\"/><shape type=\"s\"><ref id=\"M\"/></shape>");
    EXPECT_THAT(messages(document), ElementsAre(HasSubstr("scene.xml:2: id \"M\" is taken by the bsdf at scene.xml:1")));
    EXPECT_EQ(child(document, 2).children.at(0).node->type, "a");
}

TEST(SceneXml, UnknownElementsAndAttributesAreSaidAndTheRestLoads) {
    const auto document = read("\n<frobnicator type=\"x\"><bsdf type=\"lost\"/></frobnicator>\n<bsdf type=\"diffuse\" colour=\"red\">\n"
                               "<rgb name=\"reflectance\" value=\"zero\"/>\n<float value=\"1\"/><float name=\"x\"/>\nhello</bsdf>\n<shape/>"
                               "<integer name=\"n\" value=\"1.5\"/><boolean name=\"b\" value=\"maybe\"/>");
    EXPECT_THAT(messages(document),
                ElementsAre("scene.xml:2: element <frobnicator> is not known and ignored, with all that it contains",
                            "scene.xml:4: value \"zero\" of rgb \"reflectance\" is not a colour (\"r, g, b\", \"#rrggbb\" or one number); it is ignored",
                            "scene.xml:5: <float> has no attribute \"name\" and is ignored",
                            "scene.xml:5: float \"x\" has no attribute \"value\"; it is ignored",
                            "scene.xml:6: text between the elements is ignored: \"hello\"",
                            "scene.xml:3: attribute \"colour\" of <bsdf> is not known and ignored",
                            "scene.xml:7: <shape> has no attribute \"type\" and is ignored",
                            "scene.xml:7: value \"1.5\" of integer \"n\" is not an integer; it is ignored",
                            "scene.xml:7: value \"maybe\" of boolean \"b\" is neither \"true\" nor \"false\"; it is ignored"));
    EXPECT_THAT(document.root->children, SizeIs(1));
}

TEST(SceneXml, PropertiesGivenTwiceAreSaidAndTheLastCounts) {
    const auto document = read("<float name=\"toWorld\" value=\"1\"/>\n<float name=\"to_world\" value=\"2\"/>");
    EXPECT_THAT(messages(document), ElementsAre("scene.xml:2: property \"to_world\" is given twice; this one counts"));
    EXPECT_EQ(property<double>(*document.root, "to_world"), 2);
}

TEST(SceneXml, VersionsOutsideOfTheKnownOnesAreSaid) {
    for (const char* version : {"0.4.0", "0.5", "0.6.0", "2.0.0", "2.2.1", "3.0.0", "3.6.2"}) {
        const auto document = readSceneText(std::string("<scene version=\"") + version + "\"/>", "s.xml");
        ASSERT_TRUE(document.ok());
        EXPECT_THAT(document->diagnostics, IsEmpty()) << version;
    }
    for (const char* version : {"0.3", "1.0", "4.0.0", "", "new", "3.x"}) {
        const auto document = readSceneText(std::string("<scene version=\"") + version + "\"/>", "s.xml");
        ASSERT_TRUE(document.ok());
        EXPECT_THAT(document->diagnostics, SizeIs(1)) << version;
    }
}

TEST(SceneXml, BrokenXmlIsAnErrorWithFileLineAndTheParsersWords) {
    const auto document = readSceneText("<scene version=\"3.0.0\">\n<shape type=\"obj\">\n</shap>\n</scene>", "dir/bad.xml");
    ASSERT_FALSE(document.ok());
    EXPECT_EQ(document.error().code, ErrorCode::parseFailed);
    EXPECT_THAT(document.error().message, AllOf(HasSubstr("dir/bad.xml:3:"), HasSubstr("Start-end tags mismatch")));
    EXPECT_EQ(readSceneText("<shape type=\"a\"/>", "a.xml").error().code, ErrorCode::parseFailed);
    EXPECT_EQ(readSceneText("", "a.xml").error().code, ErrorCode::parseFailed);
    EXPECT_EQ(readSceneText("just words", "a.xml").error().code, ErrorCode::parseFailed);
    EXPECT_EQ(readSceneFile("/nowhere/scene.xml").error().code, ErrorCode::fileNotFound);
    EXPECT_EQ(readSceneFile("/").error().code, ErrorCode::fileUnreadable);
}

TEST(SceneXml, IncludesAreRelativeToTheFileThatIncludes) {
    const TemporaryFolder folder;
    const auto main = folder.write("scene.xml", R"(<scene version="3.0.0"><default name="n" value="4"/><include filename="parts/materials.xml"/>
        <shape type="obj"><ref id="M"/></shape></scene>)");
    folder.write("parts/materials.xml", "<scene version=\"3.0.0\">\n<include filename=\"deeper.xml\"/></scene>");
    folder.write("parts/deeper.xml", "\n<bsdf type=\"diffuse\" id=\"M\"><integer name=\"n\" value=\"$n\"/></bsdf>");
    const auto document = readSceneFile(main);
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(messages(*document), IsEmpty());
    EXPECT_EQ(document->folder, folder.path());
    const SceneNode& material = *child(*document, 1).children.at(0).node;
    EXPECT_EQ(property<std::int64_t>(material, "n"), 4);
    EXPECT_EQ(material.where.text(), (folder.path() / "parts/deeper.xml").string() + ":2");
}

TEST(SceneXml, InclusionsInCirclesOfNothingAndOfBrokenFilesAreRefused) {
    const TemporaryFolder folder;
    const auto main = folder.write("scene.xml", "<scene version=\"3.0.0\">\n<include filename=\"./a.xml\"/><include filename=\"gone.xml\"/>"
                                                "<include filename=\"bad.xml\"/><bsdf type=\"diffuse\"/></scene>");
    folder.write("a.xml", "<scene version=\"3.0.0\"><include filename=\"scene.xml\"/><include filename=\"a.xml\"/></scene>");
    folder.write("bad.xml", "<scene>");
    const auto document = readSceneFile(main);
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(messages(*document),
                ElementsAre(HasSubstr("a.xml:1: file \"scene.xml\" is not included: it includes itself"),
                            HasSubstr("a.xml:1: file \"a.xml\" is not included: it includes itself"),
                            AllOf(HasSubstr("scene.xml:2: file \"gone.xml\" is not included"), HasSubstr("does not exist")),
                            AllOf(HasSubstr("scene.xml:2: file \"bad.xml\" is not included"), HasSubstr("bad.xml:1:"))));
    EXPECT_THAT(document->root->children, SizeIs(1));
}

TEST(SceneXml, InclusionsThatMultiplyEnd) {
    const TemporaryFolder folder;
    for (int i = 0; i < 12; ++i) {
        const std::string next = "<include filename=\"f" + std::to_string(i + 1) + ".xml\"/>";
        folder.write("f" + std::to_string(i) + ".xml", "<scene version=\"3.0.0\">" + next + next + next + next + "</scene>");
    }
    folder.write("f12.xml", "<scene version=\"3.0.0\"/>");
    EXPECT_TRUE(readSceneFile(folder.path() / "f0.xml").ok());
}

TEST(SceneXml, PathsBecomeSearchFolders) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "assets");
    const auto main = folder.write("scene.xml", R"(<scene version="3.0.0"><path value="assets"/><path value="none"/></scene>)");
    const auto document = readSceneFile(main);
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(document->searchFolders, ElementsAre(folder.path(), folder.path() / "assets"));
    EXPECT_THAT(messages(*document), ElementsAre(HasSubstr("path \"none\" is not a folder")));
}

TEST(SceneXml, AnimationsKeepTheirFirstTransform) {
    const auto document = read(R"(<shape type="a"><animation name="toWorld"><transform time="0"><translate x="1"/></transform>
        <transform time="1"><translate x="2"/></transform></animation></shape>)");
    EXPECT_THAT(messages(document), ElementsAre(HasSubstr("animation is not supported")));
    EXPECT_EQ(property<Transform>(child(document, 0), "to_world"), Transform::translate({1, 0, 0}));
}

}  // namespace
}  // namespace emca::render
