#include "command_line.h"

#include <CLI/CLI.hpp>

namespace emca::pbrt4 {

Result<ParsedCommandLine> parseCommandLine(int argc, char** argv) {
    ParsedCommandLine parsed;
    CommandLine& line = parsed.line;
    std::string serve;
    int samples = 0, seed = 0;

    CLI::App app("pbrt-v4 with EMCA: renders a scene as pbrt does, or serves it to the explorer.", "emca-pbrt");
    app.add_option("scene", line.scenes, "the scene, a .pbrt file")->required();
    app.add_option("-o,--output", line.output, "image to write; .exr keeps every bit. Without --serve: SCENE.exr");
    app.add_option("--serve", serve, "serve on [HOST:]PORT instead of rendering; 0 takes a free port");
    app.add_option("--token", line.token, "clients have to present it");
    app.add_flag("--allow-quit", line.allowQuit, "a client may end the server");
    app.add_option("--integrator", line.integrator,
                   "instead of the scene's: emcapath, or of pbrt's path, simplepath, volpath, simplevolpath, "
                   "randomwalk, ambientocclusion");
    CLI::Option* sppOption =
        app.add_option("--spp", samples, "samples per pixel instead of the scene's")->check(CLI::Range(1, 1 << 30));
    CLI::Option* seedOption = app.add_option("--seed", seed, "as pbrt's --seed");
    app.add_option("--threads", line.threads, "threads that render; one per processor by default")
        ->check(CLI::Range(1, 1024));
    app.add_option("--max-triangles", line.largestTriangleCount,
                   "of all meshes that the explorer gets; instances beyond are left out");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        parsed.exit = app.exit(help);
        return parsed;
    } catch (const CLI::ParseError& error) {
        return Error{ErrorCode::invalidArgument,
                     std::string(error.what()) + ". \"emca-pbrt --help\" lists what there is."};
    }
    if (*sppOption) line.samplesPerPixel = samples;
    if (*seedOption) line.seed = seed;
    if (!serve.empty()) {
        auto address = adapter::parseServeAddress(serve);
        if (!address) return address.error();
        line.serve = *address;
    }
    return parsed;
}

}  // namespace emca::pbrt4
