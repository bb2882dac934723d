#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "json.h"
#include "session_summary.h"
#include "table.h"

namespace emca::cli {
namespace {

struct InfoArguments {
    std::string address;
    bool json = false;
};

Json infoJson(const client::ServerInfo& info) {
    Json out;
    out["renderer"] = info.renderer;
    out["scene"] = info.scene;
    out["width"] = info.width;
    out["height"] = info.height;
    out["spp"] = info.samplesPerPixel;
    out["seed"] = info.seed;
    out["integrator"] = info.integrator;
    out["sampler"] = info.sampler;
    out["triangles"] = info.triangles;
    out["meshes"] = info.meshes;
    out["capabilities"] = info.capabilities;
    out["tools"] = info.tools;
    out["layers"] = Json::array();
    for (const LayerDescription& layer : info.layers) {
        Json entry;
        entry["name"] = layer.name;
        entry["kind"] = name(layer.kind);
        entry["unit"] = layer.unit;
        entry["description"] = layer.description;
        out["layers"].push_back(std::move(entry));
    }
    out["latestRender"] = info.latestRender == 0 ? Json(nullptr) : Json(info.latestRender);
    out["limits"]["spp"] = info.maximumSamplesPerPixel;
    out["limits"]["pixelsPerTrace"] = info.maximumPixelsPerTrace;
    if (!info.layers.empty()) out["limits"]["surfaceBudget"] = info.maximumSurfaceBudget;
    return out;
}

std::string joined(const std::vector<std::string>& words) {
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string infoText(const client::ServerInfo& info) {
    Table table({{"renderer", Table::Align::left}, {printable(info.renderer), Table::Align::left}});
    table.add({"scene", info.scene});
    table.add({"image", fmt::format("{} x {} pixels, {} spp", info.width, info.height, info.samplesPerPixel)});
    table.add({"integrator", info.integrator.empty() ? "not named" : info.integrator});
    table.add({"sampler", fmt::format("{}, seed {}", info.sampler.empty() ? "not named" : info.sampler, info.seed)});
    table.add({"geometry", fmt::format("{} triangles in {} meshes", info.triangles, info.meshes)});
    table.add({"latest render", info.latestRender == 0 ? "none yet" : fmt::format("{}", info.latestRender)});
    table.add({"capabilities", joined(info.capabilities)});
    table.add({"tools", joined(info.tools)});
    std::vector<std::string> layers;
    for (const LayerDescription& layer : info.layers) layers.push_back(layer.name);
    table.add({"surface layers", joined(layers)});
    table.add(
        {"limits", fmt::format("{} spp, {} pixels a trace", info.maximumSamplesPerPixel, info.maximumPixelsPerTrace)});
    return table.text();
}

int runSession(const InfoArguments& arguments) {
    const auto opened = client::openSession(arguments.address);
    if (!opened) return fail(opened.error());
    if (!arguments.json) {
        for (const std::string& notice : opened->notices) fmt::print(stderr, "warning: {}\n", printable(notice));
        fmt::print("{}", summaryText(arguments.address, *opened));
        return Exit::ok;
    }
    Json out = summaryJson(arguments.address, *opened);
    out["renderer"] = opened->session.info ? infoJson(*opened->session.info) : Json(nullptr);
    fmt::print("{}", dump(out));
    return Exit::ok;
}

int runInfo(const InfoArguments& arguments) {
    if (namesSession(arguments.address)) return runSession(arguments);
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    const Result<client::ServerInfo> info = (*connection)->info();
    if (!info) return fail(info.error());
    fmt::print("{}", arguments.json ? dump(infoJson(*info)) : infoText(*info));
    return Exit::ok;
}

}  // namespace

void addInfoCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "What a renderer says about itself and its scene, or what a session file holds");
    command->add_option("address", arguments->address, "where the renderer listens, or a session")
        ->required()
        ->type_name("HOST:PORT|FILE.emca");
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer("Example:\n  emca info localhost:50013 --json | jq .triangles\n  emca info firefly.emca");
    command->callback([arguments, &run] { run = [arguments] { return runInfo(*arguments); }; });
}

}  // namespace emca::cli
