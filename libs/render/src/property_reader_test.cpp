#include "emca/render/property_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emca/render/scene_xml.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Every remark is a sentence.
std::string withoutStop(const std::string& sentence) {
    EXPECT_TRUE(sentence.ends_with('.')) << sentence;
    return sentence.substr(0, sentence.size() - 1);
}

/// A scene with one node, and a reader of it.
struct Reading {
    explicit Reading(const std::string& content, const std::filesystem::path& path = "scene.xml")
        : document(readSceneText("<scene version=\"3.0.0\">\n" + content + "\n</scene>", path)),
          reader(*document->root->children.at(0).node, diagnostics, document->searchFolders) {}
    std::vector<std::string> messages() const {
        std::vector<std::string> texts;
        for (const auto& d : diagnostics)
            texts.push_back(d.where.text() + ": " + withoutStop(d.message));
        return texts;
    }
    Result<SceneDocument> document;
    std::vector<Diagnostic> diagnostics;
    PropertyReader reader;
};

TEST(PropertyReader, ReadsEachTypeAndFallsBack) {
    Reading r(R"(<bsdf type="roughplastic" id="P"><float name="alpha" value="0.25"/><integer name="n" value="7"/>
        <boolean name="nonlinear" value="true"/><string name="distribution" value="ggx"/>
        <rgb name="diffuse" value="0.1 0.2 0.3"/><point name="p" x="1" y="2" z="3"/>
        <transform name="to_uv"><scale value="2"/></transform></bsdf>)");
    EXPECT_EQ(r.reader.number("alpha", 0.0), 0.25);
    EXPECT_EQ(r.reader.integer("n", 0), 7);
    EXPECT_TRUE(r.reader.flag("nonlinear", false));
    EXPECT_EQ(r.reader.text("distribution", "beckmann"), "ggx");
    EXPECT_EQ(r.reader.color("diffuse", Color(0.f)), Color(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(r.reader.vector("p", Vec3f{}), (Vec3f{1, 2, 3}));
    EXPECT_EQ(r.reader.transform("to_uv", Transform()), Transform::scale({2, 2, 2}));
    EXPECT_EQ(r.reader.number("absent", 5.0), 5.0);
    EXPECT_EQ(r.reader.text("absent", "x"), "x");
    EXPECT_EQ(r.reader.reportUnused(), 0);
    EXPECT_THAT(r.messages(), ElementsAre());
}

TEST(PropertyReader, ConvertsWhereNothingIsLost) {
    Reading r(R"(<bsdf type="b"><integer name="i" value="3"/><float name="f" value="4"/><rgb name="grey" value="0.5"/></bsdf>)");
    EXPECT_EQ(r.reader.number("i", 0.0), 3.0);
    EXPECT_EQ(r.reader.integer("f", 0), 4);
    EXPECT_EQ(r.reader.number("grey", 0.0), 0.5);
    EXPECT_EQ(r.reader.color("f", Color(0.f)), Color(4.f));
    EXPECT_EQ(r.reader.color("i", Color(0.f)), Color(3.f));
    EXPECT_THAT(r.messages(), ElementsAre());
}

TEST(PropertyReader, WrongTypesAreSaidWithPluginPropertyAndLine) {
    Reading r("<bsdf type=\"roughplastic\" id=\"P\">\n<string name=\"alpha\" value=\"rough\"/>\n"
              "<float name=\"n\" value=\"1.5\"/>\n<rgb name=\"c\" value=\"1, 2, 3\"/></bsdf>");
    EXPECT_EQ(r.reader.number("alpha", 0.1), 0.1);
    EXPECT_EQ(r.reader.number("alpha", 0.1), 0.1);  // said once only
    EXPECT_EQ(r.reader.integer("n", 2), 2);
    EXPECT_EQ(r.reader.number("c", 3.0), 3.0);
    EXPECT_THAT(r.messages(),
                ElementsAre("scene.xml:3: property \"alpha\" of bsdf \"roughplastic\" (P) is a string, but a float is expected; it is ignored",
                            "scene.xml:4: property \"n\" of bsdf \"roughplastic\" (P) is a float, but an integer is expected; it is ignored",
                            "scene.xml:5: property \"c\" of bsdf \"roughplastic\" (P) is a colour, but a float is expected; it is ignored"));
}

TEST(PropertyReader, ReportsWhatNobodyAskedFor) {
    Reading r("<bsdf type=\"diffuse\">\n<float name=\"foo\" value=\"1\"/>\n<float name=\"bar\" value=\"1\"/>\n"
              "<texture type=\"bitmap\" name=\"reflectance\"/>\n<bsdf type=\"mask\"/></bsdf>");
    r.reader.ignore("bar");
    EXPECT_EQ(r.reader.reportUnused(), 3);
    EXPECT_THAT(r.messages(), ElementsAre("scene.xml:3: property \"foo\" of bsdf \"diffuse\" is not known and ignored",
                                          "scene.xml:5: texture \"bitmap\" in bsdf \"diffuse\" as \"reflectance\" is not known there and ignored",
                                          "scene.xml:6: bsdf \"mask\" in bsdf \"diffuse\" is not known there and ignored"));
}

TEST(PropertyReader, FindsChildrenByRoleAndKind) {
    Reading r(R"(<shape type="obj"><texture type="a" name="reflectance"/><bsdf type="b"/><bsdf type="c"/><emitter type="d"/></shape>)");
    EXPECT_TRUE(r.reader.hasChild("reflectance"));
    EXPECT_EQ(r.reader.child("reflectance")->type, "a");
    EXPECT_EQ(r.reader.child("absent"), nullptr);
    EXPECT_EQ(r.reader.firstOfKind("emitter")->type, "d");
    EXPECT_EQ(r.reader.firstOfKind("medium"), nullptr);
    EXPECT_EQ(r.reader.firstOfKind("bsdf")->type, "b");
    EXPECT_EQ(r.reader.reportUnused(), 1);  // the second bsdf
    EXPECT_EQ(r.reader.childrenOfKind("bsdf").size(), 2u);
}

TEST(PropertyReader, SeeksFilesBesideTheXmlThenInTheSearchFolders) {
    const TemporaryFolder folder;
    folder.write("sub/here.obj", "");
    folder.write("assets/there.obj", "");
    const std::string scene = R"(<shape type="obj"><string name="a" value="here.obj"/><string name="b" value="there.obj"/>
        <string name="c" value="nowhere.obj"/><string name="d" value="/absolute.obj"/></shape><path value="../assets"/>)";
    Reading r(scene, folder.path() / "sub" / "scene.xml");
    EXPECT_EQ(r.reader.file("a")->resolved, folder.path() / "sub" / "here.obj");
    EXPECT_EQ(r.reader.file("b")->resolved, folder.path() / "sub" / "../assets" / "there.obj");
    EXPECT_EQ(r.reader.file("b")->written, "there.obj");
    EXPECT_EQ(r.reader.file("c")->resolved, folder.path() / "sub" / "nowhere.obj");
    EXPECT_EQ(r.reader.file("d")->resolved, "/absolute.obj");
    EXPECT_FALSE(r.reader.file("e").has_value());
}

TEST(PropertyReader, DiagnosticsHaveALimit) {
    std::string content = "<bsdf type=\"b\">";
    for (int i = 0; i < 3000; ++i)
        content += "<float name=\"p" + std::to_string(i) + "\" value=\"1\"/>\n";
    Reading r(content + "</bsdf>");
    EXPECT_EQ(r.reader.reportUnused(), 3000);
    EXPECT_EQ(r.diagnostics.size(), 1001u);
    EXPECT_THAT(r.diagnostics.back().message, HasSubstr("the rest is left out"));
}

}  // namespace
}  // namespace emca::render
