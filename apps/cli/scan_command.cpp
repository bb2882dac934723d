// `emca scan`: a query over all pixels; nothing but counts, sums and what was asked for is kept.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "commands.h"
#include "csv.h"
#include "emca/analysis/format.h"
#include "emca/client/session.h"
#include "emca/imageio/imageio.h"
#include "path_table.h"
#include "settings_options.h"
#include "table.h"
#include "traced.h"

namespace emca::cli {
namespace {

struct ScanArguments {
    std::string address, where, rect, top = "10", perPixel, save;
    SettingsArguments settings;
    bool json = false, csv = false;
};

struct Scanned {
    client::ServerInfo info;
    PixelRect rect;
    client::Trace counts;       ///< of the whole region: no paths but the brightest, and those without details
    client::Trace brightest;    ///< the same paths with all that the table shows
    std::vector<Index> order;   ///< of `brightest`, brightest first
};

std::size_t matchedPixels(const MatchCounts& matches) {
    return static_cast<std::size_t>(std::count_if(matches.matchedOfPixel.begin(), matches.matchedOfPixel.end(), [](std::uint32_t n) { return n > 0; }));
}

std::array<std::size_t, 4> verdicts(const std::vector<Replay>& replays) {
    std::array<std::size_t, 4> counts{};
    for (const Replay& replay : replays) ++counts[static_cast<std::size_t>(replay.verdict)];
    return counts;
}

/// What the matching paths bring to each pixel: their part of the image, how many they are, and what share.
Image perPixelImage(const Scanned& scanned) {
    const MatchCounts& matches = *scanned.counts.matches;
    const PixelRect rect = scanned.rect;
    Image image(rect.x1 - rect.x0, rect.y1 - rect.y0, {"R", "G", "B", "count", "fraction"});
    const auto samples = static_cast<float>(scanned.counts.samplesPerPixel);
    for (std::size_t i = 0; i < matches.matchedOfPixel.size(); ++i) {
        const Color color = matches.sumOfPixel[i] / samples;
        const auto count = static_cast<float>(matches.matchedOfPixel[i]);
        const float values[] = {color.r, color.g, color.b, count, count / samples};
        std::copy_n(values, 5, image.data() + 5 * i);
    }
    return image;
}

/// The paths named by `few`, recorded again with all that `columns` name (empty: all).
Result<client::Trace> again(client::Connection& connection, const PathSet& few, client::TraceOptions options, const InterruptGuard& interrupt) {
    Region region;
    for (Index p = 0; p < few.pathCount(); ++p)
        if (region.pixels.empty() || !(region.pixels.back() == few.pixel(p))) region.pixels.push_back(few.pixel(p));
    options.keep = KeepMatches::all;
    auto trace = traceWithProgress(connection, "tracing matches", region, options, interrupt);
    if (!trace) return trace.error();
    std::vector<Index> wanted;
    for (Index p = 0; p < few.pathCount(); ++p)
        if (const auto found = trace->paths.findPath(few.pixel(p), few.sample(p), few.part(p))) wanted.push_back(*found);
    trace->paths = trace->paths.subset(wanted);
    return trace;
}

std::vector<Index> brightestFirst(const PathSet& paths) {
    std::vector<Index> order(paths.pathCount());
    for (Index i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](Index p) {
        const float value = luminance(paths.estimate(p).value_or(Color(0.f)));
        return value == value ? value : std::numeric_limits<float>::infinity();
    };
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) > key(b); });
    return order;
}

std::string depthText(const PathSet& paths, Index path) { return analysis::formatInteger(paths.depth(path)); }

std::string topTable(const Scanned& scanned) {
    const PathSet& paths = scanned.brightest.paths;
    Table table({{"pixel"}, {"sample"}, {"depth"}, {"luminance"}, {"events", Table::Align::left}});
    for (const Index p : scanned.order) {
        const float value = luminance(paths.estimate(p).value_or(Color(0.f)));
        table.add({analysis::formatPixel(paths.pixel(p)), analysis::formatInteger(paths.sample(p)), depthText(paths, p),
                   analysis::formatNumber(static_cast<double>(value)), eventLetters(paths, p)});
    }
    return table.text();
}

std::string report(const Scanned& scanned) {
    const MatchCounts& matches = *scanned.counts.matches;
    const double percent = matches.paths ? 100.0 * static_cast<double>(matches.matched) / static_cast<double>(matches.paths) : 0;
    std::string text = fmt::format("{}: {} of {} paths match ({:.3g} %), in {} of {} pixels; {}\n", printable(scanned.info.scene),
                                   analysis::formatInteger(static_cast<std::int64_t>(matches.matched)),
                                   analysis::formatInteger(static_cast<std::int64_t>(matches.paths)), percent,
                                   analysis::formatInteger(static_cast<std::int64_t>(matchedPixels(matches))),
                                   analysis::formatInteger(static_cast<std::int64_t>(matches.matchedOfPixel.size())),
                                   analysis::formatDuration(scanned.counts.renderSeconds));
    if (matches.unknown > 0)
        text += fmt::format("for {} paths it is unknown, as something was not recorded\n", analysis::formatInteger(static_cast<std::int64_t>(matches.unknown)));
    if (scanned.order.empty()) return text;
    text += "\n" + topTable(scanned);
    if (matches.matched > scanned.order.size()) text += fmt::format("\nThe {} brightest of them; --top shows more.\n", scanned.order.size());
    return text;
}

Json topJson(const Scanned& scanned) {
    Json top = Json::array();
    const PathSet& paths = scanned.brightest.paths;
    for (const Index p : scanned.order) {
        Json one;
        one["pixel"] = toJson(paths.pixel(p));
        one["sample"] = paths.sample(p);
        one["part"] = paths.part(p);
        one["depth"] = paths.depth(p);
        one["estimate"] = toJson(paths.estimate(p));
        one["luminance"] = toJson(luminance(paths.estimate(p).value_or(Color(0.f))));
        one["events"] = eventLetters(paths, p);
        top.push_back(std::move(one));
    }
    return top;
}

Json scanJson(const Scanned& scanned, const std::string& query) {
    const MatchCounts& matches = *scanned.counts.matches;
    Json out = matchesJson(query, matches);
    out["scene"] = scanned.info.scene;
    out["spp"] = scanned.counts.samplesPerPixel;
    out["seed"] = scanned.counts.seed;
    out["rect"] = {scanned.rect.x0, scanned.rect.y0, scanned.rect.x1, scanned.rect.y1};
    out["pixels"] = matches.matchedOfPixel.size();
    out["matchedPixels"] = matchedPixels(matches);
    out["seconds"] = toJson(scanned.counts.renderSeconds);
    const auto counts = verdicts(scanned.counts.replays);
    for (const Verdict verdict : {Verdict::exact, Verdict::close, Verdict::different, Verdict::unknown})
        out["replay"][name(verdict)] = counts[static_cast<std::size_t>(verdict)];
    out["top"] = topJson(scanned);
    return out;
}

std::string scanCsv(const Scanned& scanned) {
    const PathSet& paths = scanned.brightest.paths;
    std::string text = csvLine({"x", "y", "sample", "part", "depth", "luminance", "r", "g", "b", "events"});
    const auto field = [](const auto& value) { return fmt::format("{}", value); };
    for (const Index p : scanned.order) {
        std::vector<std::string> fields{field(paths.pixel(p).x), field(paths.pixel(p).y), field(paths.sample(p)), field(paths.part(p)),
                                        field(paths.depth(p))};
        const auto e = paths.estimate(p);
        for (const float value : e ? std::array{luminance(*e), e->r, e->g, e->b} : std::array<float, 4>{})
            fields.push_back(e ? field(value) : std::string());
        fields.push_back(eventLetters(paths, p));
        text += csvLine(fields);
    }
    return text;
}

/// All that a person needs to go on without the renderer: scene, camera, and the matching paths with everything recorded.
Result<void> save(const ScanArguments& arguments, const Scanned& scanned, client::Connection& connection,
                  client::TraceOptions options, const InterruptGuard& interrupt) {
    client::Session session;
    session.info = scanned.info;
    auto camera = connection.camera();
    if (!camera) return camera.error();
    session.camera = std::move(camera).value();
    auto meshes = connection.meshes();
    if (!meshes) return meshes.error();
    session.meshes = std::make_shared<const std::vector<Mesh>>(std::move(meshes).value());
    Region matching;
    const MatchCounts& matches = *scanned.counts.matches;
    for (std::size_t i = 0; i < matches.matchedOfPixel.size(); ++i)
        if (matches.matchedOfPixel[i] > 0) matching.pixels.push_back(scanned.counts.pixels[i]);
    if (!matching.pixels.empty()) {
        options.keep = KeepMatches::all;
        options.columns.clear();
        auto trace = traceWithProgress(connection, "tracing matches", matching, options, interrupt);
        if (!trace) return trace.error();
        warnAboutMatches(*trace->matches, KeepMatches::all);
        session.traces.push_back(std::make_shared<const client::Trace>(std::move(trace).value()));
        session.shown = {0};
    }
    session.notes = fmt::format("emca scan --where {}", query::quotedText(arguments.where));
    return client::saveSession(arguments.save, session);
}

Result<Scanned> scan(const ScanArguments& arguments, client::Connection& connection, client::TraceOptions options, const InterruptGuard& interrupt) {
    Scanned scanned;
    auto info = connection.info();
    if (!info) return info.error();
    scanned.info = std::move(info).value();
    const Result<PixelRect> rect = regionOf(arguments.rect, scanned.info);
    if (!rect) return rect.error();
    scanned.rect = *rect;
    auto counts = traceWithProgress(connection, "scanning", {{}, scanned.rect}, options, interrupt);
    if (!counts) return counts.error();
    scanned.counts = std::move(counts).value();
    if (scanned.counts.paths.empty()) return scanned;
    // Only now is recorded what the table shows, of a few pixels instead of all.
    options.columns = {"estimate", "position", "event"};
    auto brightest = again(connection, scanned.counts.paths, options, interrupt);
    if (!brightest) return brightest.error();
    scanned.brightest = std::move(brightest).value();
    scanned.order = brightestFirst(scanned.brightest.paths);
    return scanned;
}

int runScan(const ScanArguments& arguments) {
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    const auto top = parseWhole("--top", arguments.top, 0, 1u << 20);
    if (!top) return failUsage(top.error().message);
    if (!arguments.rect.empty())
        if (const auto rect = parseRect(arguments.rect); !rect) return failUsage(rect.error().message);
    const auto query = parseQuery(arguments.where);
    if (!query) return Exit::usage;
    if (!arguments.perPixel.empty())
        if (const auto writable = imageio::checkWritable(arguments.perPixel); !writable) return fail(writable.error());

    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    client::TraceOptions options;
    apply(*settings, options);
    options.query = arguments.where;
    options.keep = *top > 0 ? KeepMatches::brightest : KeepMatches::none;
    options.keepCount = static_cast<std::uint32_t>(*top);
    options.columns = {"estimate"};
    const InterruptGuard interrupt;
    const Result<Scanned> scanned = scan(arguments, **connection, options, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the scan was cancelled\n");
        return Exit::interrupted;
    }
    if (!scanned) return fail(scanned.error());
    if (!arguments.perPixel.empty())
        if (const auto written = imageio::write(arguments.perPixel, perPixelImage(*scanned)); !written) return fail(written.error());
    if (!arguments.save.empty())
        if (const auto saved = save(arguments, *scanned, **connection, options, interrupt); !saved) return fail(saved.error());
    fmt::print("{}", arguments.json ? dump(scanJson(*scanned, arguments.where)) : arguments.csv ? scanCsv(*scanned) : report(*scanned));
    warnAboutMatches(*scanned->counts.matches, options.keep);
    return Exit::ok;
}

}  // namespace

void addScanCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<ScanArguments>();
    CLI::App* command = app.add_subcommand("scan", "Replays the whole image and finds the paths for which a query is true");
    addAddressOption(*command, arguments->address);
    command->add_option("--where", arguments->where, "a condition on paths (docs/queries.md)")->required()->type_name("QUERY");
    command->add_option("--rect", arguments->rect, "a part of the image (default: all of it)")->type_name("X0,Y0,X1,Y1");
    command->add_option("--top", arguments->top, "show the K brightest matches (default 10)")->type_name("K");
    command->add_option("--per-pixel", arguments->perPixel, "image of what the matches bring, their number and share")->type_name("OUT.exr");
    command->add_option("--save", arguments->save, "session with scene and matching paths, for the explorer")->type_name("FILE.emca");
    addSettingsOptions(*command, arguments->settings);
    command->add_flag("--json", arguments->json, "for scripts");
    command->add_flag("--csv", arguments->csv, "the brightest matches as comma-separated values")->excludes("--json");
    command->footer("Examples:\n  emca scan localhost:50013 --where 'luminance > 100'\n"
                    "  emca scan localhost:50013 --where 'lpe(\"C<RD>S+L\")' --per-pixel caustics.exr\n\nCtrl-C cancels the scan.");
    command->callback([arguments, &run] { run = [arguments] { return runScan(*arguments); }; });
}

}  // namespace emca::cli
