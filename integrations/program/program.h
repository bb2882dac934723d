#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emca/core/result.h"
#include "emca/server/renderer.h"
#include "emca/server/server_tool.h"

/// An adapter as a command: renders a scene to a file, or serves it. What such programs share, so that they take the same
/// options and end with the same codes.
namespace emca::program {

enum ExitCode : int { kExitOk = 0, kExitUsage = 2, kExitInput = 3, kExitConnection = 4, kExitServer = 5 };

/// What the person says. Zero or empty: as the scene says.
struct ProgramLine {
    std::string scene;   ///< its file
    std::string output;  ///< image to write; empty: none if it serves, else the scene's name with .exr
    std::string serve;   ///< [HOST:]PORT; empty: it does not serve
    std::uint32_t samplesPerPixel = 0;
    std::string integrator;
    std::uint64_t seed = 0;
    unsigned threads = 0;  ///< that render; 0: one per processor
};

/// What is rendered or served.
struct Offer {
    std::unique_ptr<Renderer> renderer;
    std::vector<std::shared_ptr<ServerTool>> tools;  ///< the server's
};

struct Program {
    std::string name;      ///< of the command: "emca-lajolla"
    std::string renderer;  ///< whose scenes it reads, for the help: "lajolla"
    std::vector<std::string> integrators;  ///< names for --integrator; empty: there is no such option
    /// Called once, after the signals are taken care of: it may begin threads. Errors: invalidArgument where the line asks
    /// for what there is not (ends with kExitUsage); others are about the scene (kExitInput).
    std::function<Result<Offer>(const ProgramLine&)> load;
};

/// Does what the command line says; messages go to standard error, help and the line "listening on ..." to standard output.
/// \return  the exit code of the process
int run(const Program& program, int argc, const char* const* argv);

}  // namespace emca::program
