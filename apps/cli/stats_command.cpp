// `emca stats`: numbers about the paths of a pixel, or about an image.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>

#include "commands.h"
#include "csv.h"
#include "emca/analysis/format.h"
#include "emca/analysis/path_quantities.h"
#include "emca/analysis/statistics.h"
#include "image_stats.h"
#include "one_pixel.h"
#include "query_rows.h"
#include "settings_options.h"
#include "table.h"
#include "traced.h"

namespace emca::cli {
namespace {

using analysis::formatFull;
using analysis::formatNumber;
using analysis::PathQuantity;

struct StatsArguments {
    OnePixelArguments pixel;  // the address is an image's name if there is no X
    std::string table, rect;
    bool json = false, csv = false;
};

constexpr std::array<double, 5> kQuantiles{0.05, 0.25, 0.5, 0.75, 0.95};

/// One number per path, summarised.
struct Summarised {
    const char* name;
    analysis::Summary summary;
    std::array<double, kQuantiles.size()> quantiles{};
};

std::vector<Summarised> summaries(const PathSet& paths) {
    std::vector<Summarised> all;
    constexpr std::pair<const char*, PathQuantity> kRows[] = {
        {"luminance", PathQuantity::luminance}, {"red", PathQuantity::red},
        {"green", PathQuantity::green},         {"blue", PathQuantity::blue},
        {"depth", PathQuantity::depth},         {"vertices", PathQuantity::vertexCount}};
    for (const auto& [name, quantity] : kRows) {
        const std::vector<double> values = analysis::pathSeries(paths, quantity).values;
        Summarised one{name, analysis::summarize(std::span<const double>(values)), {}};
        const std::vector<double> sorted = analysis::sortedFinite(values);
        for (std::size_t i = 0; i < kQuantiles.size(); ++i)
            one.quantiles[i] = analysis::quantile(sorted, kQuantiles[i]);
        all.push_back(std::move(one));
    }
    return all;
}

std::string quantileName(double p) { return fmt::format("p{:02.0f}", p * 100); }

std::string summaryTable(const std::vector<Summarised>& all) {
    std::vector<Table::Column> columns{{"", Table::Align::left}, {"paths"},     {"mean"},
                                       {"std. error"},           {"deviation"}, {"min"}};
    for (const double p : kQuantiles) columns.push_back({quantileName(p)});
    for (const char* last : {"max", "NaN", "infinite"}) columns.push_back({last});
    Table table(std::move(columns));
    for (const auto& [name, s, quantiles] : all) {
        std::vector<std::string> row{name,
                                     std::to_string(s.count),
                                     formatNumber(s.mean),
                                     formatNumber(s.standardError()),
                                     formatNumber(s.deviation()),
                                     formatNumber(s.min)};
        for (const double q : quantiles) row.push_back(formatNumber(q));
        row.insert(row.end(), {formatNumber(s.max), std::to_string(s.nan),
                               std::to_string(s.positiveInfinite + s.negativeInfinite)});
        table.add(std::move(row));
    }
    return table.text();
}

Json summaryJson(const std::vector<Summarised>& all) {
    Json out;
    for (const auto& [name, s, quantiles] : all) {
        Json one;
        one["count"] = s.count;
        one["finite"] = s.finite;
        one["nan"] = s.nan;
        one["positiveInfinite"] = s.positiveInfinite;
        one["negativeInfinite"] = s.negativeInfinite;
        one["mean"] = toJson(s.mean);
        one["variance"] = toJson(s.variance);
        one["standardDeviation"] = toJson(s.deviation());
        one["standardError"] = toJson(s.standardError());
        one["min"] = toJson(s.min);
        one["max"] = toJson(s.max);
        for (std::size_t i = 0; i < kQuantiles.size(); ++i)
            one["quantiles"][quantileName(kQuantiles[i])] = toJson(quantiles[i]);
        out[name] = std::move(one);
    }
    return out;
}

std::string summaryCsv(const std::vector<Summarised>& all) {
    std::vector<std::string> header{"quantity",         "count", "finite",   "nan",           "positiveInfinite",
                                    "negativeInfinite", "mean",  "variance", "standardError", "min"};
    for (const double p : kQuantiles) header.push_back(quantileName(p));
    header.push_back("max");
    std::string text = csvLine(header);
    for (const auto& [name, s, quantiles] : all) {
        std::vector<std::string> row{name,
                                     std::to_string(s.count),
                                     std::to_string(s.finite),
                                     std::to_string(s.nan),
                                     std::to_string(s.positiveInfinite),
                                     std::to_string(s.negativeInfinite),
                                     formatFull(s.mean),
                                     formatFull(s.variance),
                                     formatFull(s.standardError()),
                                     formatFull(s.min)};
        for (const double q : quantiles) row.push_back(formatFull(q));
        row.push_back(formatFull(s.max));
        text += csvLine(row);
    }
    return text;
}

/// The two tables that are asked for most often.
constexpr const char* kByDepth =
    "count() as paths, sum(luminance) as sum, mean(luminance) as mean, max(luminance) as max group by depth";
constexpr const char* kByTechnique =
    "count() as contributions, sum(c.luminance) as sum, mean(c.luminance) as mean, max(c.luminance) as max group by "
    "c.technique";

/// \param key  name of the column by which rows are grouped, which comes first
Result<query::TableRows> rowsOf(const char* text, const char* key, const PathSet& paths) {
    const Result<query::Table> table = query::Table::parse(text);
    if (!table) return table.error();
    auto rows = table->evaluate(paths);
    if (rows) rows->columns.at(0).name = key;
    return rows;
}

int runSummary(const StatsArguments& arguments) {
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {{"estimate", "position", "contribution"}}, traced);
        code != Exit::ok)
        return code;
    const PathSet& paths = traced.trace.paths;
    const std::vector<Summarised> all = summaries(paths);
    if (arguments.csv) {
        fmt::print("{}", summaryCsv(all));
        return Exit::ok;
    }
    const Result<query::TableRows> byDepth = rowsOf(kByDepth, "depth", paths);
    const Result<query::TableRows> byTechnique = rowsOf(kByTechnique, "technique", paths);
    if (!byDepth) return fail(byDepth.error());
    if (!byTechnique) return fail(byTechnique.error());
    if (arguments.json) {
        Json out = headJson(traced, arguments.pixel.where);
        out["paths"] = paths.pathCount();
        out["vertices"] = paths.vertexCount();
        out["summary"] = summaryJson(all);
        out["byDepth"] = rowsJson(*byDepth);
        out["byTechnique"] = rowsJson(*byTechnique);
        fmt::print("{}", dump(out));
        return Exit::ok;
    }
    std::string text = headLine(traced) + "\n" + summaryTable(all);
    if (byDepth->rowCount > 0) text += "\nLuminance of the paths, by depth:\n" + rowsText(*byDepth);
    if (byTechnique->rowCount > 0) text += "\nLuminance of the contributions, by technique:\n" + rowsText(*byTechnique);
    fmt::print("{}\nRadiance in W/(sr m²), before division by samples per pixel.\n", text);
    return Exit::ok;
}

int runTable(const StatsArguments& arguments) {
    query::QueryError where;
    const Result<query::Table> table = query::Table::parse(arguments.table, &where);
    if (!table) {
        fmt::print(stderr, "error: {}\n{}\n", table.error().message, query::pointAt(arguments.table, where.where));
        return Exit::usage;
    }
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {table->columns()}, traced); code != Exit::ok) return code;
    const Result<query::TableRows> rows = table->evaluate(traced.trace.paths);
    if (!rows) return fail(rows.error());
    for (const std::string& name : rows->missing)
        fmt::print(stderr, "warning: the table reads \"{}\", but no path has it\n", name);
    if (arguments.json) {
        Json out = headJson(traced, arguments.pixel.where);
        out["table"] = arguments.table;
        out["missing"] = rows->missing;
        out["rows"] = rowsJson(*rows);
        fmt::print("{}", dump(out));
    } else {
        fmt::print("{}", arguments.csv ? rowsCsv(*rows) : rowsText(*rows));
    }
    return Exit::ok;
}

int runStats(const StatsArguments& arguments) {
    const OnePixelArguments& pixel = arguments.pixel;
    if (pixel.x.empty()) {
        const SettingsArguments& settings = pixel.settings;
        for (const std::string* option : {&arguments.table, &pixel.where, &settings.samples, &settings.seed,
                                          &settings.integrator, &settings.sampler})
            if (!option->empty())
                return failUsage(
                    "An image has no paths: --table, --where and the renderer's settings need HOST:PORT X Y.");
        PixelRect rect;
        if (!arguments.rect.empty()) {
            const Result<PixelRect> parsed = parseRect(arguments.rect);
            if (!parsed) return failUsage(parsed.error().message);
            rect = *parsed;
        }
        return printImageStats(pixel.source, rect, arguments.json  ? StatsFormat::json
                                              : arguments.csv ? StatsFormat::csv
                                                              : StatsFormat::text);
    }
    if (!arguments.rect.empty()) return failUsage("--rect is about an image: emca stats IMAGE --rect X0,Y0,X1,Y1.");
    return arguments.table.empty() ? runSummary(arguments) : runTable(arguments);
}

}  // namespace

void addStatsCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<StatsArguments>();
    CLI::App* command = app.add_subcommand("stats", "Numbers about the paths of a pixel, or about an image");
    command->add_option("source", arguments->pixel.source, "a session or where the renderer listens, with X and Y; or an image")
        ->required()
        ->type_name("FILE|HOST:PORT|IMAGE");
    CLI::Option* x = command->add_option("x", arguments->pixel.x, "column, from 0 at the left")->type_name("X");
    CLI::Option* y = command->add_option("y", arguments->pixel.y, "row, from 0 at the top")->type_name("Y");
    x->needs(y);
    command->add_option("--table", arguments->table, "aggregates in groups (docs/queries.md)")->type_name("TABLE");
    command
        ->add_option("--where", arguments->pixel.where, "of the paths for which a condition is true (docs/queries.md)")
        ->type_name("QUERY");
    command->add_option("--rect", arguments->rect, "a part of the image (default: all of it)")->type_name("X0,Y0,X1,Y1");
    addSettingsOptions(*command, arguments->pixel.settings);
    CLI::Option* json = command->add_flag("--json", arguments->json, "for scripts");
    command->add_flag("--csv", arguments->csv, "comma-separated values")->excludes(json);
    command->footer(
        "Examples:\n  emca stats localhost:50013 117 64\n"
        "  emca stats localhost:50013 117 64 --table 'count(), mean(luminance) group by depth'\n"
        "  emca stats cornell.exr --rect 12,30,20,38");
    command->callback([arguments, &run] { run = [arguments] { return runStats(*arguments); }; });
}

}  // namespace emca::cli
