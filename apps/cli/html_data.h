#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/client/connection.h"
#include "json.h"

// What a page of `emca export` shows (docs/html-export.md describes every member).
namespace emca::cli {

struct PageContent {
    std::string title;
    client::Trace trace;                               ///< of one pixel
    std::optional<client::ServerInfo> info;
    std::optional<Camera> camera;
    std::shared_ptr<const std::vector<Mesh>> meshes;   ///< null: none
    std::string query;                                 ///< that chose the paths; empty: none
    std::size_t maximumPaths = 0;                      ///< the brightest; 0: all
    std::uint64_t maximumTriangles = 0;
    bool withScene = true;
};

/// Members: "pixel" (as `emca pixel --json`, with the paths that are kept), "analysis" (all that the page shows besides),
/// "camera", "scene" (html_scene.h) and what it is about. `meshes` serve to tell lights even without the scene.
Json pageJson(const PageContent& content);

}  // namespace emca::cli
