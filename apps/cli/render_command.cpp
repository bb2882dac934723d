#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "emca/analysis/image_metrics.h"
#include "emca/imageio/imageio.h"
#include "interrupt.h"
#include "json.h"
#include "progress_bar.h"
#include "settings_options.h"

namespace emca::cli {
namespace {

struct RenderArguments {
    std::string address, output;
    SettingsArguments settings;
    bool json = false;
};

Json renderJson(const client::Render& render, const std::filesystem::path& output, std::size_t faulty) {
    Json out;
    out["output"] = output.string();
    out["render"] = render.id;
    out["width"] = render.image.color.width();
    out["height"] = render.image.color.height();
    out["spp"] = render.samplesPerPixel;
    out["seed"] = render.seed;
    out["integrator"] = render.integrator;
    out["sampler"] = render.sampler;
    out["seconds"] = toJson(render.seconds);
    out["faultyPixels"] = faulty;
    return out;
}

/// Names what no image should have; the pixel is the next thing to ask about.
void warnAboutFaults(const std::vector<analysis::FaultyPixel>& faulty) {
    if (faulty.empty()) return;
    const Pixel first = faulty.front().pixel;
    fmt::print(
        stderr, "warning: {} {} NaN, infinite or negative; the first is {} (`emca pixel … {} {}` shows its paths)\n",
        faulty.size(), faulty.size() == 1 ? "pixel is" : "pixels are", analysis::formatPixel(first), first.x, first.y);
}

Result<client::Render> renderWithProgress(client::Connection& connection, const Settings& settings,
                                          const InterruptGuard& interrupt) {
    client::RenderOptions options;
    apply(settings, options);
    options.preview = false;
    ProgressBar bar("rendering");
    client::RequestObserver observer;
    observer.progress = [&bar](double fraction) { bar.update(fraction); };
    observer.cancel = interrupt.flag();
    return connection.render(options, observer);
}

int runRender(const RenderArguments& arguments) {
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    // Asked first: nobody wants to learn it after an hour of rendering.
    const std::filesystem::path output = arguments.output;
    if (const Result<void> writable = imageio::checkWritable(output); !writable) return fail(writable.error());
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());

    const InterruptGuard interrupt;
    const Result<client::Render> render = renderWithProgress(**connection, *settings, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the render was cancelled, {} is as it was\n", output.string());
        return Exit::interrupted;
    }
    if (!render) return fail(render.error());
    if (const Result<void> written = imageio::write(output, render->image); !written) return fail(written.error());

    const auto faulty = analysis::faultyPixels(render->image.color, render->image.color.size());
    const Image& color = render->image.color;
    if (arguments.json) {
        fmt::print("{}", dump(renderJson(*render, output, faulty.size())));
    } else {
        fmt::print("{}: {} x {} pixels, {} spp, {}\n", output.string(), color.width(), color.height(),
                   render->samplesPerPixel, analysis::formatDuration(render->seconds));
    }
    warnAboutFaults(faulty);
    return Exit::ok;
}

}  // namespace

void addRenderCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "Lets the renderer render its image and writes it to a file here");
    addAddressOption(*command, arguments->address);
    command
        ->add_option("-o,--output", arguments->output,
                     "image to write: .exr with samples and variance, .pfm, .hdr, .png")
        ->required()
        ->type_name("OUT.exr");
    addSettingsOptions(*command, arguments->settings);
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer(
        "Example:\n  emca render localhost:50013 -o cornell.exr --spp 256 --seed 7\n\nCtrl-C cancels the render.");
    command->callback([arguments, &run] { run = [arguments] { return runRender(*arguments); }; });
}

}  // namespace emca::cli
