#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "emca/core/replaced_file.h"
#include "html_data.h"
#include "html_page.h"
#include "one_pixel.h"
#include "settings_options.h"
#include "table.h"

namespace emca::cli {
namespace {

struct ExportArguments {
    OnePixelArguments pixel;
    std::string html, title, limit = "1024", maximumTriangles = "60000";
    bool noScene = false, json = false;
};

std::string titleOf(const PageContent& content) {
    const std::string scene = content.info && !content.info->scene.empty() ? content.info->scene + ", " : "";
    return printable(scene) + "pixel " + analysis::formatPixel(content.trace.pixels.at(0));
}

Json reportJson(const std::string& file, std::size_t bytes, const Json& page) {
    Json out;
    out["output"] = file;
    out["bytes"] = bytes;
    out["pixel"] = page["pixel"]["pixel"];
    out["verdict"] = page["pixel"]["replay"]["verdict"];
    out["paths"] = page["analysis"]["shown"];
    out["ofPaths"] = page["analysis"]["paths"];
    out["triangles"] = page["scene"].is_null() ? Json(nullptr) : page["scene"]["shown"];
    out["ofTriangles"] = page["scene"].is_null() ? Json(nullptr) : page["scene"]["triangles"];
    return out;
}

/// "a.html: 256 of 1024 paths, 7446 triangles, replay exact, 1.022 MiB"
std::string reportText(const Json& report) {
    const auto share = [](const Json& part, const Json& whole) {
        return part == whole ? part.dump() : fmt::format("{} of {}", part.dump(), whole.dump());
    };
    std::string text = fmt::format("{}: {} {}, ", report["output"].get<std::string>(), share(report["paths"], report["ofPaths"]),
                                   report["ofPaths"] == 1 ? "path" : "paths");
    text += report["triangles"].is_null() ? std::string("no scene") : share(report["triangles"], report["ofTriangles"]) + " triangles";
    return text + fmt::format(", replay {}, {}\n", report["verdict"].get<std::string>(), analysis::formatBytes(report["bytes"].get<std::uint64_t>()));
}

int runExport(const ExportArguments& arguments) {
    const auto limit = parseWhole("--limit", arguments.limit, 0, 1u << 20);
    if (!limit) return failUsage(limit.error().message);
    const auto triangles = parseWhole("--max-triangles", arguments.maximumTriangles, 1, 50'000'000);
    if (!triangles) return failUsage(triangles.error().message);
    if (const auto pixel = parsePixel(arguments.pixel.x, arguments.pixel.y); !pixel) return failUsage(pixel.error().message);
    // Asked first: nobody wants to learn it after a long trace.
    auto file = ReplacedFile::create(arguments.html);
    if (!file) return fail(file.error());
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {{}, true}, traced); code != Exit::ok) return code;

    PageContent content;
    content.info = traced.info;
    content.camera = traced.camera;
    content.meshes = traced.meshes;
    content.trace = std::move(traced.trace);
    content.title = arguments.title.empty() ? titleOf(content) : arguments.title;
    content.query = arguments.pixel.where;
    content.maximumPaths = *limit;
    content.maximumTriangles = *triangles;
    content.withScene = !arguments.noScene;
    const Json data = pageJson(content);
    const std::string page = htmlPage(content.title, data);
    file->stream().write(page.data(), static_cast<std::streamsize>(page.size()));
    if (const Result<void> written = file->commit(); !written) return fail(written.error());

    const Json report = reportJson(arguments.html, page.size(), data);
    fmt::print("{}", arguments.json ? dump(report) : reportText(report));
    return Exit::ok;
}

}  // namespace

void addExportCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand("export", "Makes a page that shows one pixel in any browser: scene, paths, plots, values");
    addPixelArguments(*command, arguments->pixel);
    command->add_option("--html", arguments->html, "the page: one file that loads nothing")->required()->type_name("OUT.html");
    addSettingsOptions(*command, arguments->pixel.settings);
    command->add_option("--where", arguments->pixel.where, "only paths for which a condition is true (docs/queries.md)")->type_name("QUERY");
    command->add_option("--limit", arguments->limit, "at most so many paths, the brightest (default 1024, 0: all)")->type_name("N");
    command->add_option("--title", arguments->title, "what the page is called (default: scene and pixel)")->type_name("TEXT");
    command->add_flag("--no-scene", arguments->noScene, "without the meshes: paths alone");
    command->add_option("--max-triangles", arguments->maximumTriangles, "larger scenes are made simpler (default 60000)")->type_name("N");
    command->add_flag("--json", arguments->json, "what was written, for scripts");
    command->footer("Examples:\n  emca export localhost:50013 117 64 --html firefly.html\n"
                    "  emca export hunt.emca 117 64 --html firefly.html --where 'luminance > 10'");
    command->callback([arguments, &run] { run = [arguments] { return runExport(*arguments); }; });
}

}  // namespace emca::cli
