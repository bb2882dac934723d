// `emca outliers`: the paths of a pixel or of a region that stand out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "commands.h"
#include "csv.h"
#include "emca/analysis/format.h"
#include "emca/analysis/outliers.h"
#include "one_pixel.h"
#include "path_table.h"
#include "settings_options.h"
#include "table.h"

namespace emca::cli {
namespace {

using analysis::EsdStep;
using analysis::formatFull;
using analysis::formatInteger;
using analysis::formatNumber;
using analysis::OutlierMethod;
using analysis::OutlierOptions;
using analysis::OutlierReport;
using analysis::PixelOutliers;
using analysis::PathQuantity;

struct OutliersArguments {
    OnePixelArguments pixel;
    std::string method = "sigma", deviations = "3", alpha = "0.05", maximum = "10", quantity = "luminance";
    bool upperOnly = false, perPixel = false, json = false, csv = false;
};

struct NamedQuantity {
    const char* name;
    PathQuantity quantity;
};
constexpr std::array<NamedQuantity, 6> kQuantities{{{"luminance", PathQuantity::luminance},
                                                    {"red", PathQuantity::red},
                                                    {"green", PathQuantity::green},
                                                    {"blue", PathQuantity::blue},
                                                    {"depth", PathQuantity::depth},
                                                    {"vertices", PathQuantity::vertexCount}}};

Result<OutlierOptions> parseOptions(const OutliersArguments& arguments) {
    OutlierOptions options;
    if (arguments.method == "esd")
        options.method = OutlierMethod::generalizedEsd;
    else if (arguments.method != "sigma")
        return Error{ErrorCode::invalidArgument,
                     fmt::format("--method is \"{}\"; it must be sigma or esd.", arguments.method)};
    const auto deviations = parseReal("--deviations", arguments.deviations, 1e-6, 1e6);
    if (!deviations) return deviations.error();
    const auto alpha = parseReal("--alpha", arguments.alpha, 1e-12, 0.999);
    if (!alpha) return alpha.error();
    const auto maximum = parseWhole("--max", arguments.maximum, 1, 1u << 20);
    if (!maximum) return maximum.error();
    for (const NamedQuantity& named : kQuantities)
        if (arguments.quantity == named.name) {
            options.quantity = named.quantity;
            options.deviations = *deviations;
            options.significance = *alpha;
            options.maximum = *maximum;
            options.upperOnly = arguments.upperOnly;
            return options;
        }
    return Error{ErrorCode::invalidArgument,
                 fmt::format("--quantity is \"{}\"; it must be luminance, red, green, blue, depth or vertices.",
                             arguments.quantity)};
}

/// A path that stands out: how far from the mean, in standard deviations; nothing where that is no number.
struct Row {
    Index path;
    double value;
    std::optional<double> deviations;
};

/// NaN and infinite values first, then the farthest from the mean of their report.
std::vector<Row> rowsOf(const PathSet& paths, const std::vector<PixelOutliers>& reports, const OutlierOptions& options) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity(), kLargest = std::numeric_limits<double>::max();
    std::vector<std::pair<std::array<double, 2>, Row>> rows;
    for (const auto& [pixel, report] : reports)
        for (const Index path : report.outliers) {
            Row row{path, analysis::pathValue(paths, path, options.quantity).value_or(0), {}};
            const bool finite = std::isfinite(row.value);
            if (finite && report.deviation > 0) row.deviations = (row.value - report.mean) / report.deviation;
            rows.push_back({{!finite ? kInfinity : row.deviations ? std::abs(*row.deviations) : kLargest, finite ? std::abs(row.value - report.mean) : 0}, row});
        }
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Row> sorted;
    for (const auto& [key, row] : rows) sorted.push_back(row);
    return sorted;
}

std::string limitsLine(const OutlierReport& report, const OutlierOptions& options, const std::string& quantity) {
    std::string line;
    if (options.method == OutlierMethod::meanDeviation) {
        line = report.considered < 2
                   ? fmt::format("Too few finite values of {} for limits ({}).\n", quantity, report.considered)
                   : fmt::format(
                         "{} beyond mean ± {} standard deviations ({} ± {}): outside [{}, {}]\n", quantity,
                         formatNumber(options.deviations), formatNumber(report.mean), formatNumber(report.deviation),
                         options.upperOnly ? "-Infinity" : formatNumber(report.lower), formatNumber(report.upper));
    } else if (report.steps.empty()) {
        line = fmt::format(
            "Generalized ESD test of {}: nothing to test, as there are too few values or all are equal.\n", quantity);
    } else {
        line = fmt::format(
            "generalized ESD test of {}, alpha {}, {}at most {}; the other {} values: {} ± {}, in [{}, {}]\n", quantity,
            formatNumber(options.significance), options.upperOnly ? "one-sided, " : "", report.steps.size(),
            report.considered + report.notFinite - report.outliers.size(), formatNumber(report.mean),
            formatNumber(report.deviation), formatNumber(report.lower), formatNumber(report.upper));
    }
    if (report.notFinite > 0) line += fmt::format("{} values are NaN or infinite\n", report.notFinite);
    if (report.withoutValue > 0) line += fmt::format("{} paths have no {}\n", report.withoutValue, quantity);
    return line;
}

std::string stepsTable(const PathSet& paths, const OutlierReport& report) {
    Table table({{""}, {"i"}, {"sample"}, {"value"}, {"R"}, {"lambda"}});
    for (std::size_t i = 0; i < report.steps.size(); ++i) {
        const EsdStep& step = report.steps[i];
        table.add({step.significant() ? "*" : "", formatInteger(static_cast<std::int64_t>(i + 1)),
                   formatInteger(paths.sample(step.index)), formatNumber(step.value), formatNumber(step.statistic),
                   formatNumber(step.critical)});
    }
    return table.text();
}

/// Of several pixels each path says its own.
std::string rowsTable(const PathSet& paths, const std::vector<Row>& rows, const std::string& quantity, bool pixels) {
    std::vector<Table::Column> columns{{"sample"}, {"part"}, {quantity}, {"deviations"}, {"depth"}, {"events", Table::Align::left}};
    if (pixels) columns.insert(columns.begin(), {{"x"}, {"y"}});
    Table table(columns);
    for (const Row& row : rows) {
        std::vector<std::string> cells{formatInteger(paths.sample(row.path)), formatInteger(paths.part(row.path)), formatNumber(row.value),
                                       row.deviations ? formatNumber(*row.deviations) : "-", formatInteger(paths.depth(row.path)),
                                       eventLetters(paths, row.path)};
        if (pixels) cells.insert(cells.begin(), {formatInteger(paths.pixel(row.path).x), formatInteger(paths.pixel(row.path).y)});
        table.add(cells);
    }
    return table.text();
}

std::string perPixelLine(const std::vector<PixelOutliers>& reports, const OutlierOptions& options, const std::string& quantity) {
    std::size_t with = 0;
    for (const PixelOutliers& one : reports) with += !one.report.outliers.empty();
    const std::string how = options.method == OutlierMethod::meanDeviation
                                ? fmt::format("beyond mean ± {} standard deviations", formatNumber(options.deviations))
                                : fmt::format("by the generalized ESD test, alpha {}, at most {}", formatNumber(options.significance), options.maximum);
    return fmt::format("{} {} of the paths of its own pixel: in {} of {} pixels\n", quantity, how, with, reports.size());
}

std::string outliersText(const OnePixel& traced, const std::vector<PixelOutliers>& reports, const OutlierOptions& options,
                         const std::vector<Row>& rows, const OutliersArguments& arguments) {
    const PathSet& paths = traced.trace.paths;
    std::string text = headLine(traced);
    const OutlierReport& first = reports.front().report;
    if (arguments.perPixel) text += perPixelLine(reports, options, arguments.quantity);
    else text += limitsLine(first, options, arguments.quantity);
    if (!arguments.perPixel && !first.steps.empty())
        text += "\n" + stepsTable(paths, first) +
                "\nR: distance from the mean of what is left, in its standard deviations; *: beyond lambda.\n";
    text += fmt::format("\n{} of {} paths {} out{}\n", rows.size(), paths.pathCount(),
                        rows.size() == 1 ? "stands" : "stand", rows.empty() ? "." : ":");
    if (rows.empty()) return text;
    text += "\n" + rowsTable(paths, rows, arguments.quantity, traced.trace.pixels.size() > 1);
    if (std::ranges::any_of(reports, [](const PixelOutliers& one) { return one.report.maximumReached(); }))
        text += arguments.perPixel ? "\nIn some pixels all values that were tested are outliers: there may be more, --max tests more.\n"
                                   : "\nAll values that were tested are outliers: there may be more, --max tests more.\n";
    return text;
}

/// What the detector found out about some paths, without the outliers themselves.
Json reportJson(const PathSet& paths, std::size_t count, const OutlierReport& report, bool esd) {
    Json out;
    if (esd) out["maxReached"] = report.maximumReached();
    out["paths"] = count;
    out["considered"] = report.considered;
    out["notFinite"] = report.notFinite;
    out["withoutValue"] = report.withoutValue;
    out["mean"] = toJson(report.mean);
    out["standardDeviation"] = toJson(report.deviation);
    out["lower"] = toJson(report.lower);
    out["upper"] = toJson(report.upper);
    if (!esd) return out;
    out["steps"] = Json::array();
    for (const EsdStep& step : report.steps) {
        Json one;
        one["sample"] = paths.sample(step.index);
        one["part"] = paths.part(step.index);
        one["value"] = toJson(step.value);
        one["mean"] = toJson(step.mean);
        one["standardDeviation"] = toJson(step.deviation);
        one["statistic"] = toJson(step.statistic);
        one["critical"] = toJson(step.critical);
        one["significant"] = step.significant();
        out["steps"].push_back(std::move(one));
    }
    return out;
}

Json outliersJson(const OnePixel& traced, const std::vector<PixelOutliers>& reports, const OutlierOptions& options,
                  const std::vector<Row>& rows, const OutliersArguments& arguments) {
    const PathSet& paths = traced.trace.paths;
    const bool esd = options.method == OutlierMethod::generalizedEsd;
    Json out = headJson(traced, arguments.pixel.where);
    out["quantity"] = arguments.quantity;
    out["method"] = arguments.method;
    out["upperOnly"] = options.upperOnly;
    if (esd) {
        out["alpha"] = toJson(options.significance);
        out["max"] = options.maximum;
    } else {
        out["deviations"] = toJson(options.deviations);
    }
    if (arguments.perPixel) {
        out["paths"] = paths.pathCount();
        out["pixels"] = Json::array();
        for (const auto& [pixel, report] : reports) {
            Json one;
            one["pixel"] = toJson(pixel);
            one.update(reportJson(paths, report.considered + report.notFinite + report.withoutValue, report, esd));
            out["pixels"].push_back(std::move(one));
        }
    } else {
        out.update(reportJson(paths, paths.pathCount(), reports.front().report, esd));
    }
    out["outliers"] = Json::array();
    for (const Row& row : rows) {
        Json one;
        if (traced.trace.pixels.size() > 1) one["pixel"] = toJson(paths.pixel(row.path));
        one["sample"] = paths.sample(row.path);
        one["part"] = paths.part(row.path);
        one["value"] = toJson(row.value);
        one["deviations"] = toJson(row.deviations);
        one["depth"] = paths.depth(row.path);
        one["estimate"] = toJson(paths.estimate(row.path));
        one["events"] = eventLetters(paths, row.path);
        out["outliers"].push_back(std::move(one));
    }
    return out;
}

std::string outliersCsv(const OnePixel& traced, const std::vector<Row>& rows, const std::string& quantity) {
    const PathSet& paths = traced.trace.paths;
    const bool pixels = traced.trace.pixels.size() > 1;
    std::vector<std::string> names{"sample", "part", quantity, "deviations", "depth", "events"};
    if (pixels) names.insert(names.begin(), {"x", "y"});
    std::string text = csvLine(names);
    for (const Row& row : rows) {
        std::vector<std::string> cells{std::to_string(paths.sample(row.path)), std::to_string(paths.part(row.path)), formatFull(row.value),
                                       row.deviations ? formatFull(*row.deviations) : "", std::to_string(paths.depth(row.path)), eventLetters(paths, row.path)};
        if (pixels) cells.insert(cells.begin(), {std::to_string(paths.pixel(row.path).x), std::to_string(paths.pixel(row.path).y)});
        text += csvLine(cells);
    }
    return text;
}

int runOutliers(const OutliersArguments& arguments) {
    const Result<OutlierOptions> options = parseOptions(arguments);
    if (!options) return failUsage(options.error().message);
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {{"estimate", "position", "event"}}, traced); code != Exit::ok)
        return code;
    const PathSet& paths = traced.trace.paths;
    std::vector<PixelOutliers> reports;
    if (arguments.perPixel) {
        auto each = analysis::detectOutliersPerPixel(paths, *options);
        if (!each) return fail(each.error());
        reports = std::move(each).value();
    } else {
        auto all = analysis::detectOutliers(paths, *options);
        if (!all) return fail(all.error());
        reports.push_back({traced.trace.pixels.at(0), std::move(all).value()});
    }
    const std::vector<Row> rows = rowsOf(paths, reports, *options);
    fmt::print("{}", arguments.json  ? dump(outliersJson(traced, reports, *options, rows, arguments))
                     : arguments.csv ? outliersCsv(traced, rows, arguments.quantity)
                                     : outliersText(traced, reports, *options, rows, arguments));
    return Exit::ok;
}

}  // namespace

void addOutliersCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<OutliersArguments>();
    CLI::App* command = app.add_subcommand("outliers", "The paths of a pixel, or of a region, that stand out from the others");
    addPixelArguments(*command, arguments->pixel, true);
    command
        ->add_option("--method", arguments->method,
                     "sigma: beyond mean ± M standard deviations (default); esd: generalized ESD test")
        ->type_name("METHOD");
    command->add_option("--deviations", arguments->deviations, "sigma: M (default 3)")->type_name("M");
    command
        ->add_option("--alpha", arguments->alpha, "esd: chance to find an outlier where there is none (default 0.05)")
        ->type_name("A");
    command->add_option("--max", arguments->maximum, "esd: test for at most R outliers (default 10)")->type_name("R");
    command->add_option("--quantity", arguments->quantity, "luminance (default), red, green, blue, depth or vertices")
        ->type_name("NAME");
    command->add_flag("--per-pixel", arguments->perPixel, "with --rect: each path against the paths of its own pixel");
    command->add_flag("--upper-only", arguments->upperOnly, "ignore values below");
    command
        ->add_option("--where", arguments->pixel.where,
                     "among the paths for which a condition is true (docs/queries.md)")
        ->type_name("QUERY");
    addSettingsOptions(*command, arguments->pixel.settings);
    CLI::Option* json = command->add_flag("--json", arguments->json, "for scripts");
    command->add_flag("--csv", arguments->csv, "the outliers as comma-separated values")->excludes(json);
    command->footer(
        "Examples:\n  emca outliers localhost:50013 117 64\n  emca outliers localhost:50013 117 64 --method esd --max "
        "50 --alpha 0.01\n  emca outliers localhost:50013 --rect 112,60,120,68 --per-pixel --upper-only");
    command->callback([arguments, &run] { run = [arguments] { return runOutliers(*arguments); }; });
}

}  // namespace emca::cli
