#pragma once

#include <optional>
#include <string>

#include "bridge_renderer.h"
#include "emca/adapter/serving.h"
#include "published_server.h"

namespace emca::bridge {

struct CommandLine {
    PublishedServerOptions server;
    BridgeOptions bridge;
    adapter::ServeAddress serve;
    bool allowQuit = false;
};

struct ParsedCommandLine {
    std::optional<CommandLine> commandLine;  ///< nothing: there is nothing more to do
    int exitCode = 0;
};

/// Prints help and complaints itself.
ParsedCommandLine parseCommandLine(int argc, const char* const* argv);

}  // namespace emca::bridge
