#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "emca/core/result.h"
#include "emca/render/scene.h"
#include "emca/render/scene_xml.h"

namespace emca::render {

/// What a command line says besides the scene file. Zero: as the file says.
struct SceneOptions {
    SceneDefines defines;                 ///< values of $names
    std::uint32_t width = 0, height = 0;  ///< of the image, in pixels
};

inline constexpr std::uint32_t kMaximumImageSide = 65536;          ///< pixels
inline constexpr std::uint64_t kMaximumImagePixels = 1ull << 28;

/// Reads a scene file and builds the scene. What is unknown or missing is left out or replaced, and said in
/// Scene::diagnostics().
/// Errors: of readSceneFile; invalidArgument or tooLarge (image size); of Scene::make.
Result<std::shared_ptr<const Scene>> loadScene(const std::filesystem::path& path, const SceneOptions& options = {});

/// The same from a document that was read already.
Result<std::shared_ptr<const Scene>> buildScene(const SceneDocument& document, std::string name,
                                                const SceneOptions& options = {});

}  // namespace emca::render
