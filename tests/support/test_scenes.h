#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emca/render/scene_loader.h"

namespace emca::test {

/// A scene that tests may render.
struct TestScene {
    std::string name;
    std::filesystem::path file;
    std::filesystem::path reference;  ///< image by another renderer; empty for scenes of our own
    std::uint32_t width = 0, height = 0;  ///< of the reference
};

/// Scenes of this repository.
std::vector<TestScene> ownScenes();
/// Public scenes with references, beside the checkout; empty where that folder is absent.
std::vector<TestScene> publicScenes();

/// Loads a scene for a test; fails the test and returns null if it cannot be loaded.
std::shared_ptr<const render::Scene> load(const TestScene& scene, std::uint32_t width, std::uint32_t height);

}  // namespace emca::test
