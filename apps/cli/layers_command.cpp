#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "emca/core/replaced_file.h"
#include "interrupt.h"
#include "json.h"
#include "layer_ply.h"
#include "progress_bar.h"
#include "settings_options.h"
#include "table.h"

namespace emca::cli {
namespace {

struct LayersArguments {
    std::string address, render;
    std::vector<std::string> exported;  // name and file
    bool list = false, json = false;
};

/// A layer that the renderer can collect, or one that it added of its own.
struct Listed {
    LayerDescription description;
    bool collected = false;
    std::uint64_t samples = 0;
};

std::vector<Listed> listedLayers(const client::ServerInfo& info) {
    std::vector<Listed> layers;
    for (const LayerDescription& description : info.layers) layers.push_back({description});
    for (const client::CollectedLayer& layer : info.collected) {
        auto found = std::find_if(layers.begin(), layers.end(), [&](const Listed& l) { return l.description.name == layer.description.name; });
        if (found == layers.end()) found = layers.insert(found, {layer.description});
        found->collected = true;
        found->samples = layer.samples;
    }
    return layers;
}

Json listJson(const client::ServerInfo& info) {
    Json out;
    out["render"] = info.surfaceRender == 0 ? Json(nullptr) : Json(info.surfaceRender);
    out["layers"] = Json::array();
    for (const Listed& layer : listedLayers(info)) {
        Json entry;
        entry["name"] = layer.description.name;
        entry["kind"] = name(layer.description.kind);
        entry["unit"] = layer.description.unit;
        entry["description"] = layer.description.description;
        entry["collected"] = layer.collected;
        entry["samples"] = layer.collected ? Json(layer.samples) : Json(nullptr);
        out["layers"].push_back(std::move(entry));
    }
    return out;
}

std::string listText(const client::ServerInfo& info) {
    const std::vector<Listed> layers = listedLayers(info);
    if (layers.empty()) return "This renderer collects no surface layers.\n";
    using Align = Table::Align;
    Table table({{"layer", Align::left}, {"kind", Align::left}, {"unit", Align::left}, {"samples", Align::right}, {"description", Align::left}});
    for (const auto& [description, collected, samples] : layers) {
        table.add({description.name, name(description.kind), description.unit.empty() ? "-" : description.unit,
                   collected ? std::to_string(samples) : "-", description.description});
    }
    const std::string last = info.surfaceRender == 0 ? "No render has collected layers yet: emca render … --layers NAME,NAME,… or all."
                                                     : fmt::format("Samples are those of render {}.", info.surfaceRender);
    return table.text() + "\n" + last + "\n";
}

int runList(const LayersArguments& arguments) {
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    const Result<client::ServerInfo> info = (*connection)->info();
    if (!info) return fail(info.error());
    fmt::print("{}", arguments.json ? dump(listJson(*info)) : listText(*info));
    return Exit::ok;
}

/// What one export needs, from the renderer.
struct Fetched {
    SurfaceField field;
    std::vector<Mesh> meshes;
    std::string scene;
};

Result<Fetched> fetch(client::Connection& connection, std::uint64_t render, const std::string& layer, const InterruptGuard& interrupt) {
    ProgressBar bar("fetching");
    client::RequestObserver observer;
    observer.cancel = interrupt.flag();
    // The layer first: an unknown name is answered at once, and a scene is large.
    observer.progress = [&bar](double fraction) { bar.update(fraction / 2); };
    auto field = connection.surface(render, {layer}, observer);
    if (!field) return field.error();
    observer.progress = [&bar](double fraction) { bar.update(0.5 + fraction / 2); };
    auto meshes = connection.meshes(observer);
    if (!meshes) return meshes.error();
    if (const auto valid = validate(*field, *meshes); !valid) return valid.error();
    const auto info = connection.info();
    if (!info) return info.error();
    return Fetched{std::move(field).value(), std::move(meshes).value(), info->scene};
}

Json exportJson(const std::string& file, const SurfaceLayerData& layer, const LayerPicture& picture, const SurfaceCounts& counts, std::uint64_t faces) {
    Json out;
    out["output"] = file;
    out["layer"] = layer.description.name;
    out["kind"] = name(layer.description.kind);
    out["unit"] = layer.description.unit;
    out["samples"] = layer.samples;
    out["total"] = toJson(layer.total);
    out["faces"] = faces;
    out["coarse"] = counts.coarse;
    out["range"] = Json::array({toJson(picture.range.min), toJson(picture.range.max)});
    out["min"] = toJson(picture.statistics.min);
    out["max"] = toJson(picture.statistics.max);
    out["mean"] = toJson(picture.statistics.mean);
    out["area"] = toJson(picture.statistics.area);
    return out;
}

int runExport(const LayersArguments& arguments, std::uint64_t render) {
    const std::string &wanted = arguments.exported[0], &output = arguments.exported[1];
    if (std::filesystem::path(output).extension() != ".ply")
        return fail({ErrorCode::notSupported, fmt::format("The layer was to be written to {}, but only .ply can be written.", output)});
    auto file = ReplacedFile::create(output);
    if (!file) return fail(file.error());
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());

    const InterruptGuard interrupt;
    const Result<Fetched> fetched = fetch(**connection, render, wanted, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: {} is as it was\n", output);
        return Exit::interrupted;
    }
    if (!fetched) return fail(fetched.error());
    const SurfaceField& field = fetched->field;
    const SurfaceLayerData& layer = field.layers.front();
    const LayerPicture picture = pictureOf(field, layer, fetched->meshes);
    const Result<std::uint64_t> faces = writePly(file->stream(), field, layer, fetched->meshes, picture, {"scene: " + fetched->scene});
    if (!faces) return fail(faces.error());
    if (const Result<void> written = file->commit(); !written) return fail(written.error());

    if (arguments.json) {
        fmt::print("{}", dump(exportJson(output, layer, picture, field.counts, *faces)));
    } else {
        const std::string unit = layer.description.unit.empty() ? "" : " " + printable(layer.description.unit);
        fmt::print("{}: {}, {} faces, {} samples, mean {}{}, colours from {} to {}\n", output, printable(layer.description.name), *faces,
                   layer.samples, analysis::formatNumber(picture.statistics.mean), unit, analysis::formatNumber(picture.range.min),
                   analysis::formatNumber(picture.range.max));
    }
    return Exit::ok;
}

int runLayers(const LayersArguments& arguments) {
    if (arguments.list == !arguments.exported.empty()) return failUsage("Say either --list or --export NAME OUT.ply.");
    if (!arguments.render.empty() && arguments.list) return failUsage("--render belongs to --export; --list shows the newest render.");
    if (arguments.list) return runList(arguments);
    std::uint64_t render = 0;
    if (!arguments.render.empty()) {
        const auto parsed = parseWhole("--render", arguments.render, 1, std::uint64_t(1) << 53);
        if (!parsed) return failUsage(parsed.error().message);
        render = *parsed;
    }
    return runExport(arguments, render);
}

}  // namespace

void addLayersCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<LayersArguments>();
    CLI::App* command = app.add_subcommand("layers", "3D data on surfaces, collected by `emca render … --layers`");
    addAddressOption(*command, arguments->address);
    command->add_flag("--list", arguments->list, "which layers there are, and which the newest render with layers collected");
    command->add_option("--export", arguments->exported, "write one layer on the refined meshes as PLY")
        ->expected(2)
        ->type_name("NAME OUT.ply");
    command->add_option("--render", arguments->render, "of this render (default: the newest that has layers)")->type_name("ID");
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer("Example:\n  emca render localhost:50013 -o a.exr --layers all\n"
                    "  emca layers localhost:50013 --export \"intersection density\" density.ply");
    command->callback([arguments, &run] { run = [arguments] { return runLayers(*arguments); }; });
}

}  // namespace emca::cli
