#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emca/adapter/serving.h"
#include "emca/core/result.h"

namespace emca::pbrt4 {

struct CommandLine {
    std::vector<std::string> scenes;
    std::string output;  ///< image to write; empty where it serves
    std::optional<adapter::ServeAddress> serve;
    std::string token;
    bool allowQuit = false;
    std::string integrator;  ///< empty: the scene's
    std::optional<int> samplesPerPixel, seed;
    int threads = 0;  ///< 0: one per processor
    std::uint64_t largestTriangleCount = 20'000'000;
};

/// Prints help where that is asked for: then `exit` is set. Errors: invalidArgument.
struct ParsedCommandLine {
    CommandLine line;
    std::optional<int> exit;
};
Result<ParsedCommandLine> parseCommandLine(int argc, char** argv);

}  // namespace emca::pbrt4
