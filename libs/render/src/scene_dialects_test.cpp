#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emca/render/scene_xml.h"

namespace emca::render {
namespace {

using testing::IsEmpty;

/// Properties that only the 0.6 dialect's film has; the 3.x files of these scenes leave them at their defaults.
bool onlyInOldFilms(const SceneNode& node, const std::string& property) {
    return node.kind == "film" && (property == "banner" || property == "component_format");
}

void expectSameProperties(const SceneNode& a, const SceneNode& b) {
    for (const auto& [name, entry] : a.properties) {
        if (onlyInOldFilms(a, name) && !b.properties.contains(name))
            continue;
        ASSERT_TRUE(b.properties.contains(name)) << a.where.text() << ": " << name;
        EXPECT_TRUE(entry.value == b.properties.at(name).value) << a.where.text() << ": " << name;
    }
}

void expectSame(const SceneNode& a, const SceneNode& b) {
    EXPECT_EQ(a.kind, b.kind) << a.where.text();
    EXPECT_EQ(a.type, b.type) << a.where.text();
    EXPECT_EQ(a.id, b.id) << a.where.text();
    expectSameProperties(a, b);
    expectSameProperties(b, a);
    ASSERT_EQ(a.children.size(), b.children.size()) << a.where.text();
    for (std::size_t i = 0; i < a.children.size(); ++i) {
        EXPECT_EQ(a.children[i].name, b.children[i].name) << a.children[i].where.text();
        expectSame(*a.children[i].node, *b.children[i].node);
    }
}

class SceneDialects : public testing::TestWithParam<const char*> {};

TEST_P(SceneDialects, SayTheSame) {
    const auto folder = std::filesystem::path(EMCA_SOURCE_DIR) / ".." / "shared" / "scenes" / GetParam();
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the public scenes are not here (looked for " << folder << ")";
    const auto modern = readSceneFile(folder / "scene.xml"), old = readSceneFile(folder / "scene_v06.xml");
    ASSERT_TRUE(modern.ok()) << modern.error().message;
    ASSERT_TRUE(old.ok()) << old.error().message;
    EXPECT_THAT(modern->diagnostics, IsEmpty());
    EXPECT_THAT(old->diagnostics, IsEmpty());
    EXPECT_GT(modern->root->children.size(), 10u);
    expectSame(*old->root, *modern->root);
}

INSTANTIATE_TEST_SUITE_P(PublicScenes, SceneDialects, testing::Values("cornell-box", "veach-ajar", "veach-bidir", "veach-mis"));

}  // namespace
}  // namespace emca::render
