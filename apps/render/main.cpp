// emca-render: the reference renderer as a command and as a server.

#include <iostream>
#include <optional>

#include "command_line.h"
#include "emca/adapter/serving.h"
#include "emca/imageio/imageio.h"
#include "emca/render/scene_loader.h"
#include "emca/server/tool_file.h"
#include "light_probe_tool.h"
#include "progress_bar.h"
#include "renderer_adapter.h"

namespace emca {

namespace {

int fail(const Error& error, int exitCode) {
    std::cerr << "error: " << error.message << std::endl;
    return exitCode;
}

void printDiagnostics(const render::Scene& scene) {
    for (const render::Diagnostic& diagnostic : scene.diagnostics()) {
        std::cerr << "warning: " << diagnostic.where.text() << ": " << diagnostic.message << '\n';
    }
}

int renderToFile(const std::shared_ptr<const render::Scene>& scene, const render::RenderOptions& options,
                 const CommandLine& line) {
    const render::ImageRenderer renderer(scene, line.threads);
    Result<RenderedImage> image = [&] {
        ProgressBar bar(scene->name());
        render::RenderCallbacks callbacks;
        callbacks.progress = [&](double fraction) { bar.update(fraction); };
        return renderer.renderImage(options, callbacks);
    }();
    if (!image) return fail(image.error(), kExitInput);
    const std::filesystem::path output = line.output.value_or(scene->name() + ".exr");
    if (auto written = imageio::write(output, *image); !written) return fail(written.error(), kExitInput);
    return kExitOk;
}

/// The renderer's own tools, and those that the command line names.
Result<std::vector<std::shared_ptr<ServerTool>>> toolsOf(const std::shared_ptr<const render::Scene>& scene, const render::RenderOptions& options,
                                                         const CommandLine& line) {
    std::vector<std::shared_ptr<ServerTool>> tools{std::make_shared<LightProbeTool>(scene, options, line.threads)};
    for (const std::filesystem::path& file : line.tools) {
        auto tool = loadTool(file);
        if (!tool) return tool.error();
        tools.push_back(std::move(tool).value());
    }
    return tools;
}

int serve(const std::shared_ptr<const render::Scene>& scene, const render::RenderOptions& options,
          const CommandLine& line, adapter::EndingSignal& ending) {
    RendererAdapter renderer(scene, options, line.integrator.value_or("path"), line.threads);
    ServerOptions serverOptions;
    serverOptions.host = line.serve->host;
    serverOptions.port = line.serve->port;
    serverOptions.maximumSamplesPerPixel = render::kMaximumSamplesPerPixel;
    serverOptions.log = [](const std::string& remark) { std::cerr << remark << std::endl; };
    const auto tools = toolsOf(scene, options, line);
    if (!tools) return fail(tools.error(), kExitInput);
    const auto served = adapter::serve(renderer, serverOptions, *tools, ending, std::cout);
    return served ? kExitOk : fail(served.error(), kExitConnection);
}

int run(const CommandLine& line) {
    std::optional<adapter::EndingSignal> ending;
    if (line.serve) ending.emplace();
    if (line.output) imageio::prepareFor(*line.output);
    render::SceneOptions sceneOptions;
    sceneOptions.defines = line.defines;
    sceneOptions.width = line.size.width;
    sceneOptions.height = line.size.height;
    const auto scene = render::loadScene(line.scene, sceneOptions);
    if (!scene) return fail(scene.error(), kExitInput);
    printDiagnostics(**scene);

    render::RenderOptions options = render::sceneOptions(**scene);
    if (auto named = applyNames(line.integrator.value_or(""), line.sampler.value_or(""), (*scene)->integrator(), options); !named) {
        return fail(named.error(), kExitUsage);
    }
    if (line.samplesPerPixel) options.samplesPerPixel = *line.samplesPerPixel;
    if (line.seed) options.seed = *line.seed;
    if (!line.serve) return renderToFile(*scene, options, line);
    if (line.output) {
        if (const int code = renderToFile(*scene, options, line); code != kExitOk) return code;
    }
    return serve(*scene, options, line, *ending);
}

}  // namespace

}  // namespace emca

int main(int argc, char** argv) {
    const auto parsed = emca::parseCommandLine(argc, argv);
    return parsed.commandLine ? emca::run(*parsed.commandLine) : parsed.exitCode;
}
