#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "emca/client/session.h"
#include "emca/core/replaced_file.h"
#include "html_data.h"
#include "html_page.h"
#include "progress_bar.h"
#include "settings_options.h"
#include "table.h"
#include "traced.h"

namespace emca::cli {
namespace {

struct ExportArguments {
    std::string source, x, y, html, title, where, limit = "1024", maximumTriangles = "60000";
    SettingsArguments settings;
    bool noScene = false, json = false;
};


/// The paths of one pixel of a trace of many.
Result<client::Trace> onlyPixel(const client::Trace& trace, Pixel pixel) {
    const auto found = std::find(trace.pixels.begin(), trace.pixels.end(), pixel);
    if (found == trace.pixels.end()) return Error{ErrorCode::invalidArgument, "The trace does not hold the pixel."};
    client::Trace out = trace;
    out.pixels = {pixel};
    out.replays = {trace.replays.at(static_cast<std::size_t>(found - trace.pixels.begin()))};
    if (trace.pixels.size() == 1) return out;
    std::vector<Index> paths;
    for (Index i = 0; i < trace.paths.pathCount(); ++i)
        if (trace.paths.pixel(i) == pixel) paths.push_back(i);
    out.paths = trace.paths.subset(paths);
    return out;
}

std::string pixelsOf(const client::Session& session) {
    std::string text;
    std::size_t count = 0;
    for (const auto& trace : session.traces)
        for (const Pixel pixel : trace->pixels) {
            if (count < 8) text += (count > 0 ? ", " : "") + analysis::formatPixel(pixel);
            ++count;
        }
    if (count == 0) return "it holds no traced pixel";
    return fmt::format("it holds {}{}", text, count > 8 ? fmt::format(" and {} more", count - 8) : "");
}

/// A condition on paths that are here already.
Result<void> select(const std::string& where, client::Trace& trace) {
    const Result<query::Query> query = query::Query::parse(where);
    if (!query) return query.error();
    const Result<query::Matches> matches = query->select(trace.paths);
    if (!matches) return matches.error();
    MatchCounts counts;
    counts.paths = trace.paths.pathCount();
    counts.matched = matches->paths.size();
    counts.unknown = matches->unknown;
    counts.missing = matches->missing;
    trace.paths = trace.paths.subset(matches->paths);
    trace.matches = counts;
    return {};
}

Result<PageContent> fromSession(const ExportArguments& arguments, Pixel pixel, const InterruptGuard& interrupt) {
    client::RequestObserver observer;
    observer.cancel = interrupt.flag();
    Result<client::OpenedSession> opened = client::openSession(arguments.source, {}, observer);
    if (!opened) return opened.error();
    for (const std::string& notice : opened->notices) fmt::print(stderr, "warning: {}\n", printable(notice));
    const client::Session& session = opened->session;
    PageContent content;
    content.info = session.info;
    content.camera = session.camera;
    content.meshes = session.meshes;
    for (const auto& trace : session.traces) {
        Result<client::Trace> found = onlyPixel(*trace, pixel);
        if (!found) continue;
        content.trace = std::move(found).value();
        if (!arguments.where.empty())
            if (const Result<void> selected = select(arguments.where, content.trace); !selected) return selected.error();
        return content;
    }
    return Error{ErrorCode::invalidArgument,
                 fmt::format("Pixel {} was not traced in {}; {}.", analysis::formatPixel(pixel), arguments.source, pixelsOf(session))};
}

Result<PageContent> fromRenderer(const ExportArguments& arguments, const Settings& settings, Pixel pixel, const InterruptGuard& interrupt) {
    const auto connection = connect(arguments.source);
    if (!connection) return connection.error();
    const Result<client::ServerInfo> info = (*connection)->info();
    if (!info) return info.error();
    if (const Result<void> inside = checkInside(pixel, *info); !inside) return inside.error();
    client::TraceOptions options;
    apply(settings, options);
    options.query = arguments.where;
    Result<client::Trace> trace = traceWithProgress(**connection, "tracing", {{pixel}, {}}, options, interrupt);
    if (!trace) return trace.error();
    PageContent content;
    content.info = *info;
    content.trace = std::move(trace).value();
    const Result<Camera> camera = (*connection)->camera();
    if (!camera) return camera.error();
    content.camera = *camera;
    ProgressBar bar("fetching");
    client::RequestObserver observer;
    observer.progress = [&bar](double fraction) { bar.update(fraction); };
    observer.cancel = interrupt.flag();
    Result<std::vector<Mesh>> meshes = (*connection)->meshes(observer);
    if (!meshes) return meshes.error();
    content.meshes = std::make_shared<const std::vector<Mesh>>(std::move(meshes).value());
    return content;
}

bool isGiven(const SettingsArguments& s) {
    return !s.samples.empty() || !s.seed.empty() || !s.integrator.empty() || !s.sampler.empty();
}

std::string titleOf(const PageContent& content, Pixel pixel) {
    const std::string scene = content.info && !content.info->scene.empty() ? content.info->scene + ", " : "";
    return printable(scene) + "pixel " + analysis::formatPixel(pixel);
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
    const Result<Pixel> pixel = parsePixel(arguments.x, arguments.y);
    if (!pixel) return failUsage(pixel.error().message);
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    const auto limit = parseWhole("--limit", arguments.limit, 0, 1u << 20);
    if (!limit) return failUsage(limit.error().message);
    const auto triangles = parseWhole("--max-triangles", arguments.maximumTriangles, 1, 50'000'000);
    if (!triangles) return failUsage(triangles.error().message);
    const bool session = client::isSession(arguments.source);
    if (session && isGiven(arguments.settings))
        return failUsage("A session holds its paths already; --spp, --seed, --integrator and --sampler belong to a renderer's address.");
    if (!arguments.where.empty() && !parseQuery(arguments.where)) return Exit::usage;
    auto file = ReplacedFile::create(arguments.html);
    if (!file) return fail(file.error());

    const InterruptGuard interrupt;
    Result<PageContent> content = session ? fromSession(arguments, *pixel, interrupt) : fromRenderer(arguments, *settings, *pixel, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: {} is as it was\n", arguments.html);
        return Exit::interrupted;
    }
    if (!content) return fail(content.error());
    content->title = arguments.title.empty() ? titleOf(*content, *pixel) : arguments.title;
    content->query = arguments.where;
    content->maximumPaths = *limit;
    content->maximumTriangles = *triangles;
    content->withScene = !arguments.noScene;
    const Json data = pageJson(*content);
    const std::string page = htmlPage(content->title, data);
    file->stream().write(page.data(), static_cast<std::streamsize>(page.size()));
    if (const Result<void> written = file->commit(); !written) return fail(written.error());

    const Json report = reportJson(arguments.html, page.size(), data);
    fmt::print("{}", arguments.json ? dump(report) : reportText(report));
    if (content->trace.matches) warnAboutMatches(*content->trace.matches, KeepMatches::all);
    return Exit::ok;
}

}  // namespace

void addExportCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand("export", "Makes a page that shows one pixel in any browser: scene, paths, plots, values");
    command->add_option("source", arguments->source, "a session, or where the renderer listens")->required()->type_name("FILE|HOST:PORT");
    command->add_option("x", arguments->x, "column, from 0 at the left")->required()->type_name("X");
    command->add_option("y", arguments->y, "row, from 0 at the top")->required()->type_name("Y");
    command->add_option("--html", arguments->html, "the page: one file that loads nothing")->required()->type_name("OUT.html");
    addSettingsOptions(*command, arguments->settings);
    command->add_option("--where", arguments->where, "only paths for which a condition is true (docs/queries.md)")->type_name("QUERY");
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
