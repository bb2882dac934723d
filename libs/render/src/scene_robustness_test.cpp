#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "emca/render/scene_xml.h"

namespace emca::render {
namespace {

using testing::HasSubstr;

const std::string kScene = R"(<?xml version="1.0" encoding="utf-8"?>
<scene version="0.6.0">
  <default name="spp" value="64"/>
  <!-- a comment -->
  <integrator type="path"><integer name="maxDepth" value="$spp"/></integrator>
  <bsdf type="twosided" id="A&amp;B"><bsdf type="diffuse"><rgb name="reflectance" value="#ff8000"/></bsdf></bsdf>
  <shape type="sphere"><point name="center" x="0" y="1" z="-2.5e3"/><ref id="A&amp;B"/>
    <transform name="toWorld"><rotate y="1" angle="30"/><matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform>
    <emitter type="area"><spectrum name="radiance" value="400:0.1, 700:3"/></emitter></shape>
  <emitter type="constant"><blackbody name="radiance" temperature="5000K" scale="2"/></emitter>
</scene>
)";

/// Walks the whole tree, as a reader would.
std::size_t countNodes(const SceneNode& node) {
    std::size_t count = 1;
    for (const auto& child : node.children)
        count += countNodes(*child.node);
    return count;
}

void expectDocumentOrError(const std::string& text) {
    const auto document = readSceneText(text, "scene.xml");
    if (document)
        EXPECT_GE(countNodes(*document->root), 1u);
    else
        EXPECT_FALSE(document.error().message.empty());
}

TEST(SceneRobustness, EveryTruncationIsAnErrorOrADocument) {
    ASSERT_TRUE(readSceneText(kScene, "scene.xml").ok());
    for (std::size_t length = 0; length + 2 < kScene.size(); ++length) {
        const auto document = readSceneText(kScene.substr(0, length), "scene.xml");
        // Without its end tag no prefix is well-formed.
        ASSERT_FALSE(document.ok()) << length;
        EXPECT_THAT(document.error().message, HasSubstr("scene.xml:")) << length;
    }
}

TEST(SceneRobustness, EveryChangedByteIsAnErrorOrADocument) {
    for (std::size_t i = 0; i < kScene.size(); ++i)
        for (const char c : {'\0', '<', '>', '"', '$', '&', '9', '\xff', '\n'}) {
            std::string text = kScene;
            text[i] = c;
            expectDocumentOrError(text);
        }
}

TEST(SceneRobustness, RandomDamageIsAnErrorOrADocument) {
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        std::string text = kScene;
        for (int edits = 1 + int(random() % 6); edits > 0; --edits) {
            const std::size_t a = random() % text.size(), b = random() % text.size(), length = random() % 40;
            if (random() % 2)
                text.insert(a, text.substr(b, length));
            else
                text.erase(a, length);
            if (text.empty())
                break;
        }
        expectDocumentOrError(text);
    }
}

TEST(SceneRobustness, DeepNestingIsSaidAndCutOff) {
    constexpr int kLevels = 200000;
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; i < kLevels; ++i)
        text += "<bsdf type=\"twosided\">";
    for (int i = 0; i < kLevels; ++i)
        text += "</bsdf>";
    const auto document = readSceneText(text + "</scene>", "scene.xml");
    ASSERT_TRUE(document.ok()) << document.error().message;
    EXPECT_THAT(document->diagnostics.at(0).message, HasSubstr("nested more than 200 deep"));
    EXPECT_LE(countNodes(*document->root), 201u);
    EXPECT_FALSE(readSceneText(text, "scene.xml").ok());
}

TEST(SceneRobustness, LongChainsOfReferencesAreCutOff) {
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; i < 50000; ++i)
        text += "<bsdf type=\"mask\" id=\"b" + std::to_string(i) + "\"><ref id=\"b" + std::to_string(i + 1) + "\"/></bsdf>";
    const auto document = readSceneText(text + "<bsdf type=\"diffuse\" id=\"b50000\"/></scene>", "scene.xml");
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(document->diagnostics.at(0).message, HasSubstr("chain of references that is too long"));
    int longest = 0;
    for (const auto& child : document->root->children) {
        int length = 0;
        for (const SceneNode* node = child.node.get(); node; node = node->children.empty() ? nullptr : node->children[0].node.get())
            ++length;
        longest = std::max(longest, length);
    }
    EXPECT_GT(longest, 200);
    EXPECT_LE(longest, 402);
}

TEST(SceneRobustness, ManyElementsLoad) {
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; i < 100000; ++i)
        text += "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/><ref id=\"M\"/></shape>\n";
    const auto document = readSceneText(text + "<bsdf type=\"diffuse\" id=\"M\"/></scene>", "scene.xml");
    ASSERT_TRUE(document.ok());
    EXPECT_EQ(document->root->children.size(), 100001u);
    EXPECT_EQ(document->root->children[99999].where.line, 100000);
    EXPECT_TRUE(document->diagnostics.empty());
}

TEST(SceneRobustness, ManyRemarksStayBounded) {
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; i < 100000; ++i)
        text += "<what/>\n";
    const auto document = readSceneText(text + "</scene>", "scene.xml");
    ASSERT_TRUE(document.ok());
    EXPECT_LE(document->diagnostics.size(), 1001u);
}

}  // namespace
}  // namespace emca::render
