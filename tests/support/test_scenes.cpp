#include "support/test_scenes.h"

#include <gtest/gtest.h>

namespace emca::test {
namespace {

const std::filesystem::path kSource = EMCA_SOURCE_DIR;

std::vector<TestScene> existing(std::vector<TestScene> scenes) {
    std::erase_if(scenes, [](const TestScene& scene) { return !std::filesystem::exists(scene.file); });
    return scenes;
}

}  // namespace

std::vector<TestScene> ownScenes() {
    std::vector<TestScene> scenes;
    for (const char* name : {"cornell-box", "cornell-glass", "firefly"})
        scenes.push_back({name, kSource / "scenes" / name / "scene.xml", {}});
    return existing(std::move(scenes));
}

std::vector<TestScene> publicScenes() {
    const std::filesystem::path folder = kSource / ".." / "shared" / "scenes";
    // The references were rendered from the files of the early dialect.
    const auto scene = [&](const char* name, std::uint32_t width, std::uint32_t height) {
        return TestScene{name, folder / name / "scene_v06.xml", folder / name / "reference.exr", width, height};
    };
    return existing({scene("cornell-box", 256, 256), scene("veach-mis", 320, 180), scene("veach-ajar", 320, 180),
                     scene("veach-bidir", 256, 256)});
}

std::shared_ptr<const render::Scene> load(const TestScene& scene, std::uint32_t width, std::uint32_t height) {
    render::SceneOptions options;
    options.width = width;
    options.height = height;
    auto loaded = render::loadScene(scene.file, options);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().message);
    return loaded.ok() ? *loaded : nullptr;
}

}  // namespace emca::test
