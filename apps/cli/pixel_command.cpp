#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "one_pixel.h"
#include "path_json.h"
#include "path_table.h"
#include "query_rows.h"
#include "settings_options.h"
#include "traced.h"
#include "value_rows.h"

namespace emca::cli {
namespace {

struct PixelArguments {
    OnePixelArguments pixel;
    std::string limit = "32";
    std::vector<std::string> values;
    bool json = false, csv = false;
};

/// One row per path with the values that were asked for, and nothing else.
int runValues(const PixelArguments& arguments) {
    const Result<ValueQueries> values = parseValues(arguments.values);
    if (!values) {
        fmt::print(stderr, "error: {}\n", values.error().message);
        return Exit::usage;
    }
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {values->columns}, traced); code != Exit::ok) return code;
    const Result<query::TableRows> rows = valueRows(*values, traced.trace.paths);
    if (!rows) return fail(rows.error());
    for (const std::string& name : rows->missing) fmt::print(stderr, "warning: no path has \"{}\"\n", name);
    if (arguments.json) {
        Json out = headJson(traced, arguments.pixel.where);
        out["missing"] = rows->missing;
        out["rows"] = rowsJson(*rows);
        fmt::print("{}", dump(out));
    } else {
        fmt::print("{}", arguments.csv ? rowsCsv(*rows) : rowsText(*rows));
    }
    return Exit::ok;
}

int runPixel(const PixelArguments& arguments) {
    if (!arguments.values.empty()) return runValues(arguments);
    if (arguments.csv) return failUsage("--csv has columns only with --value: name the quantities that they show.");
    const Result<std::uint64_t> limit = parseWhole("--limit", arguments.limit, 0, 1u << 30);
    if (!limit) return failUsage(limit.error().message);
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {}, traced); code != Exit::ok) return code;
    if (!arguments.json) {
        fmt::print("{}", pixelReport(traced.trace, traced.scene(), *limit));
        return Exit::ok;
    }
    Json json = pixelJson(traced.trace);
    if (traced.trace.matches) json["where"] = matchesJson(arguments.pixel.where, *traced.trace.matches);
    fmt::print("{}", dump(json));
    return Exit::ok;
}

}  // namespace

void addPixelCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<PixelArguments>();
    CLI::App* command = app.add_subcommand("pixel", "Replays one pixel, or takes it from a session, and shows every light path that made it");
    addPixelArguments(*command, arguments->pixel);
    addSettingsOptions(*command, arguments->pixel.settings);
    command->add_option("--against", arguments->pixel.against, "compare with this image instead of the renderer's latest")
        ->type_name("IMAGE");
    command->add_option("--where", arguments->pixel.where, "only paths for which a condition is true (docs/queries.md)")
        ->type_name("QUERY");
    command->add_option("--limit", arguments->limit, "show at most so many paths, the brightest (default 32, 0: all)")
        ->type_name("N");
    command->add_option("--value", arguments->values, "one row per path with the value of an expression (docs/queries.md); several times: several columns")
        ->type_name("EXPRESSION")
        ->expected(1)
        ->take_all();
    CLI::Option* json = command->add_flag("--json", arguments->json, "everything that was recorded, for scripts");
    command->add_flag("--csv", arguments->csv, "with --value: comma-separated values")->excludes(json);
    command->footer(
        "Examples:\n  emca pixel localhost:50013 117 64\n"
        "  emca pixel localhost:50013 117 64 --json | jq '.paths | max_by(.estimate[0])'\n"
        "  emca pixel localhost:50013 117 64 --where 'any(v.lobe == \"specular\") and luminance > 10'\n"
        "  emca pixel hunt.emca 117 64 --value depth --value luminance --value 'last(v.event)' --csv\n"
        "  emca pixel hunt.emca 117 64");
    command->callback([arguments, &run] { run = [arguments] { return runPixel(*arguments); }; });
}

}  // namespace emca::cli
