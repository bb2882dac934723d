#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emca/adapter/serving.h"
#include "emca/core/result.h"

namespace emca {

/// "WIDTHxHEIGHT". Errors: invalidArgument.
struct ImageSize {
    std::uint32_t width = 0, height = 0;
};
Result<ImageSize> parseImageSize(const std::string& text);

/// What was typed, checked as far as that needs no scene. Absent: as the scene says.
struct CommandLine {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> output;
    std::optional<std::uint32_t> samplesPerPixel;
    ImageSize size;  ///< 0: as the scene says
    std::optional<std::string> integrator, sampler;
    std::optional<std::uint64_t> seed;
    int threads = 0;  ///< 0: one per processor
    std::map<std::string, std::string> defines;
    std::optional<adapter::ServeAddress> serve;
    std::vector<std::filesystem::path> tools;  ///< server tools in files of their own
};

/// Exit codes, as DESIGN.md and docs say.
enum ExitCode : int { kExitOk = 0, kExitUsage = 2, kExitInput = 3, kExitConnection = 4, kExitServer = 5 };

/// Either a command line, or the code to exit with after everything was said (help, version, usage errors).
struct ParsedCommandLine {
    std::optional<CommandLine> commandLine;
    int exitCode = kExitOk;
};
ParsedCommandLine parseCommandLine(int argc, const char* const* argv);

}  // namespace emca
