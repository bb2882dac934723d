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
#include "table.h"

namespace emca::cli {
namespace {

struct RenderArguments {
    std::string address, output, layers, surfaceBudget;
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
    out["layers"] = Json::array();
    for (std::size_t i = 0; i < render.layers.size(); ++i) {
        Json layer;
        layer["name"] = render.layers[i].name;
        layer["kind"] = name(render.layers[i].kind);
        layer["unit"] = render.layers[i].unit;
        layer["samples"] = render.layerSamples[i];
        out["layers"].push_back(std::move(layer));
    }
    if (!render.layers.empty()) {
        const SurfaceCounts& counts = render.surfaceCounts;
        Json& surface = out["surface"];
        surface["points"] = counts.points;
        surface["faces"] = render.surfaceFaces;
        surface["coarse"] = counts.coarse;
        surface["invalid"] = counts.invalid;
        surface["refusedDivisions"] = counts.refusedDivisions;
        surface["bytes"] = counts.bytesUsed;
        surface["budget"] = counts.budgetBytes;
    }
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

std::string layersText(const client::Render& render) {
    Table table({{"layer", Table::Align::left}, {"kind", Table::Align::left}, {"samples"}});
    for (std::size_t i = 0; i < render.layers.size(); ++i)
        table.add({render.layers[i].name, name(render.layers[i].kind), std::to_string(render.layerSamples[i])});
    const SurfaceCounts& counts = render.surfaceCounts;
    return table.text() + fmt::format("{} points on {} faces, {} of {}\n", counts.points, render.surfaceFaces,
                                      analysis::formatBytes(counts.bytesUsed), analysis::formatBytes(counts.budgetBytes));
}

void warnAboutSurface(const SurfaceCounts& counts) {
    if (counts.coarse > 0)
        fmt::print(stderr, "warning: {} of {} points are kept coarsely, shared by neighbouring faces, as the budget was used up; "
                           "--surface-budget gives more\n", counts.coarse, counts.points);
    if (counts.invalid > 0)
        fmt::print(stderr, "warning: {} points or values were left out, as they were NaN, infinite or on no face\n", counts.invalid);
}

/// The layers that a person named, "all" standing for every layer of the renderer.
Result<std::vector<std::string>> chosenLayers(const std::string& text, client::Connection& connection) {
    if (text != "all") return splitList(text);
    const Result<client::ServerInfo> info = connection.info();
    if (!info) return info.error();
    if (info->layers.empty()) return Error{ErrorCode::notSupported, "All surface layers were asked for, but this renderer has none."};
    std::vector<std::string> names;
    for (const LayerDescription& layer : info->layers) names.push_back(layer.name);
    return names;
}

Result<client::Render> renderWithProgress(client::Connection& connection, client::RenderOptions options,
                                          const InterruptGuard& interrupt) {
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
    client::RenderOptions options;
    apply(*settings, options);
    if (!arguments.surfaceBudget.empty()) {
        const auto mebibytes = parseWhole("--surface-budget", arguments.surfaceBudget, 1, 1u << 24);
        if (!mebibytes) return failUsage(mebibytes.error().message);
        if (arguments.layers.empty()) return failUsage("--surface-budget belongs to --layers: say which layers to collect.");
        options.surfaceBudget = *mebibytes << 20;
    }
    // Asked first: nobody wants to learn it after an hour of rendering.
    const std::filesystem::path output = arguments.output;
    if (const Result<void> writable = imageio::checkWritable(output); !writable) return fail(writable.error());
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());

    if (!arguments.layers.empty()) {
        auto layers = chosenLayers(arguments.layers, **connection);
        if (!layers) return fail(layers.error());
        options.layers = std::move(layers).value();
    }

    const InterruptGuard interrupt;
    const Result<client::Render> render = renderWithProgress(**connection, options, interrupt);
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
        if (!render->layers.empty()) fmt::print("{}", layersText(*render));
    }
    warnAboutFaults(faulty);
    warnAboutSurface(render->surfaceCounts);
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
    command->add_option("--layers", arguments->layers, "3D data to collect on surfaces meanwhile (`emca layers`)")
        ->type_name("NAME,NAME,…|all");
    command->add_option("--surface-budget", arguments->surfaceBudget, "memory for it, at the renderer (default: the server's)")
        ->type_name("MiB");
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer(
        "Example:\n  emca render localhost:50013 -o cornell.exr --spp 256 --seed 7\n\nCtrl-C cancels the render.");
    command->callback([arguments, &run] { run = [arguments] { return runRender(*arguments); }; });
}

}  // namespace emca::cli
