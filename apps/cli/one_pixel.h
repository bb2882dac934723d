#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "emca/client/connection.h"
#include "json.h"

namespace CLI {
class App;
}

namespace emca::cli {

/// What a person typed who asks about the paths of one pixel (some commands: of a rectangle), at a renderer or in a session.
struct OnePixelArguments {
    std::string source, x, y, where;
    std::string rect;               ///< instead of x and y
    std::string against;            ///< image to compare with instead of the renderer's latest; empty: none
    SettingsArguments settings;
};

/// What a command wants to know.
struct WantedOfPixel {
    std::vector<std::string> columns;    ///< of a renderer; a session has what it has. Empty: all
    bool scene = false;                  ///< camera and meshes, too
};

struct OnePixel {
    std::optional<client::ServerInfo> info;            ///< there, but of sessions that were saved without
    client::Trace trace;
    std::optional<Camera> camera;
    std::shared_ptr<const std::vector<Mesh>> meshes;
    std::string scene() const { return info ? info->scene : std::string(); }
};

/// Declares the positionals FILE|HOST:PORT X Y. \param regions  X and Y may be left out for --rect
void addPixelArguments(CLI::App& command, OnePixelArguments& arguments, bool regions = false);

/// Replays a pixel, or takes it from a session. Says on standard error what went wrong, and what the query found wanting.
/// \return Exit::ok, or how to end: nothing is in `out` then
int traceOnePixel(const OnePixelArguments& arguments, const WantedOfPixel& wanted, OnePixel& out);

/// {"pixel" (or "rect" and "replays"), "scene", "spp", "seed", "integrator", "sampler", "verdict"} and, if there was a query, "where".
Json headJson(const OnePixel& traced, const std::string& query);
/// The same as a line for people.
std::string headLine(const OnePixel& traced);

}  // namespace emca::cli
