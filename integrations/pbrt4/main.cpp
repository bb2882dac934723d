// emca-pbrt: somebody's pbrt-v4 as a command and as a server, with EMCA in it.

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "command_line.h"
#include "emca/imageio/imageio.h"
#include "pbrt_renderer.h"

namespace emca::pbrt4 {

namespace {

constexpr int kExitUsage = 2, kExitInput = 3, kExitServer = 5;

int fail(const Error& error, int exitCode) {
    std::cerr << "error: " << error.message << std::endl;
    return exitCode;
}

/// A render at the command line has nobody who could cancel it.
class Silent final : public RequestMonitor {
  public:
    bool cancelled() const override { return false; }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
};

int renderToFile(PbrtRenderer& renderer, const CommandLine& line) {
    Silent monitor;
    const auto image = renderer.renderImage({}, monitor);
    if (!image) return fail(image.error(), kExitInput);
    std::filesystem::path output = line.output;
    if (output.empty()) output = std::filesystem::path(line.scenes.front()).filename().replace_extension(".exr");
    if (auto written = imageio::write(output, *image); !written) return fail(written.error(), kExitInput);
    return 0;
}

int serveScene(PbrtRenderer& renderer, const CommandLine& line, adapter::EndingSignal& ending) {
    ServerOptions options;
    options.host = line.serve->host;
    options.port = line.serve->port;
    options.token = line.token;
    options.allowQuit = line.allowQuit;
    options.log = [](const std::string& remark) { std::cerr << remark << '\n'; };
    if (auto served = adapter::serve(renderer, options, {renderer.lightProbe()}, ending, std::cout); !served) {
        return fail(served.error(), kExitServer);
    }
    return 0;
}

int run(const CommandLine& line, adapter::EndingSignal& ending) {
    auto scene = LoadedScene::load({.files = line.scenes,
                                    .threads = line.threads,
                                    .seed = line.seed,
                                    .largestTriangleCount = line.largestTriangleCount,
                                    .integrator = line.integrator});
    if (!scene) return fail(scene.error(), kExitInput);
    if (const std::size_t left = (*scene)->surfaces().trianglesLeftOut(); left > 0) {
        std::cerr << "warning: " << left
                  << " triangles of instances are beyond --max-triangles; the explorer does not show them.\n";
    }
    const RenderChoice choice{.sceneName = std::filesystem::path(line.scenes.front()).stem().string(),
                              .samplesPerPixel = line.samplesPerPixel,
                              .threads = static_cast<unsigned>(line.threads)};
    auto renderer = PbrtRenderer::make(std::move(scene).value(), choice);
    if (!renderer) return fail(renderer.error(), kExitUsage);
    return line.serve ? serveScene(**renderer, line, ending) : renderToFile(**renderer, line);
}

}  // namespace

}  // namespace emca::pbrt4

int main(int argc, char** argv) {
    const auto parsed = emca::pbrt4::parseCommandLine(argc, argv);
    if (!parsed) return emca::pbrt4::fail(parsed.error(), emca::pbrt4::kExitUsage);
    if (parsed->exit) return *parsed->exit;
    emca::adapter::EndingSignal ending;
    const int code = emca::pbrt4::run(parsed->line, ending);
    std::cout.flush();
    // pbrt's objects are made to last as long as the process, and its threads with them.
    std::_Exit(code);
}
