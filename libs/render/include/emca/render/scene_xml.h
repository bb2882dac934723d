#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/result.h"
#include "emca/render/scene_node.h"

namespace emca::render {

/// A scene file as a tree of nodes.
struct SceneDocument {
    std::shared_ptr<const SceneNode> root;  ///< kind "scene"; never null. Acyclic; a node with several refs is shared
    std::vector<Diagnostic> diagnostics;    ///< in order of discovery
    std::filesystem::path folder;           ///< of the scene file
    std::vector<std::filesystem::path> searchFolders;  ///< `folder`, then every <path> of the file
};

/// Values for $names (command line: -D name=value); they win over the file's <default>s.
using SceneDefines = std::map<std::string, std::string>;

/// Reads a scene file in Mitsuba's XML, versions 0.4 to 0.6 and 2.x to 3.x, with all files that it includes.
/// What is unknown or wrong in one element becomes a diagnostic with file and line and is left out; the rest loads.
/// Errors: fileNotFound, fileUnreadable; parseFailed with file, line and the XML parser's words; tooLarge.
Result<SceneDocument> readSceneFile(const std::filesystem::path& path, const SceneDefines& defines = {});

/// As readSceneFile, from memory. \param path  stands for the text in messages; files are sought beside it
Result<SceneDocument> readSceneText(std::string text, const std::filesystem::path& path, const SceneDefines& defines = {});

}  // namespace emca::render
