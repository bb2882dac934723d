// `emca outliers`: the paths of a pixel that stand out.
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
using analysis::PathQuantity;

struct OutliersArguments {
    OnePixelArguments pixel;
    std::string method = "sigma", deviations = "3", alpha = "0.05", maximum = "10", quantity = "luminance";
    bool upperOnly = false, json = false, csv = false;
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

/// NaN and infinite values first, then the farthest from the mean.
std::vector<Row> rowsOf(const PathSet& paths, const OutlierReport& report, const OutlierOptions& options) {
    std::vector<Row> rows;
    for (const Index path : report.outliers) {
        Row row{path, analysis::pathValue(paths, path, options.quantity).value_or(0), {}};
        if (std::isfinite(row.value) && report.deviation > 0)
            row.deviations = (row.value - report.mean) / report.deviation;
        rows.push_back(row);
    }
    const auto key = [&](const Row& row) {
        return std::isfinite(row.value) ? std::abs(row.value - report.mean) : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return key(a) > key(b); });
    return rows;
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

std::string outliersText(const OnePixel& traced, const OutlierReport& report, const OutlierOptions& options,
                         const std::vector<Row>& rows, const std::string& quantity) {
    const PathSet& paths = traced.trace.paths;
    std::string text = headLine(traced) + limitsLine(report, options, quantity);
    if (!report.steps.empty())
        text += "\n" + stepsTable(paths, report) +
                "\nR: distance from the mean of what is left, in its standard deviations; *: beyond lambda.\n";
    text += fmt::format("\n{} of {} paths {} out{}\n", rows.size(), paths.pathCount(),
                        rows.size() == 1 ? "stands" : "stand", rows.empty() ? "." : ":");
    if (rows.empty()) return text;
    Table table({{"sample"}, {"part"}, {quantity}, {"deviations"}, {"depth"}, {"events", Table::Align::left}});
    for (const Row& row : rows)
        table.add({formatInteger(paths.sample(row.path)), formatInteger(paths.part(row.path)), formatNumber(row.value),
                   row.deviations ? formatNumber(*row.deviations) : "-", formatInteger(paths.depth(row.path)),
                   eventLetters(paths, row.path)});
    text += "\n" + table.text();
    if (report.maximumReached())
        text += "\nAll values that were tested are outliers: there may be more, --max tests more.\n";
    return text;
}

Json outliersJson(const OnePixel& traced, const OutlierReport& report, const OutlierOptions& options,
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
        out["maxReached"] = report.maximumReached();
    } else {
        out["deviations"] = toJson(options.deviations);
    }
    out["paths"] = paths.pathCount();
    out["considered"] = report.considered;
    out["notFinite"] = report.notFinite;
    out["withoutValue"] = report.withoutValue;
    out["mean"] = toJson(report.mean);
    out["standardDeviation"] = toJson(report.deviation);
    out["lower"] = toJson(report.lower);
    out["upper"] = toJson(report.upper);
    if (esd) {
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
    }
    out["outliers"] = Json::array();
    for (const Row& row : rows) {
        Json one;
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

std::string outliersCsv(const PathSet& paths, const std::vector<Row>& rows, const std::string& quantity) {
    std::string text = csvLine({"sample", "part", quantity, "deviations", "depth", "events"});
    for (const Row& row : rows)
        text += csvLine({std::to_string(paths.sample(row.path)), std::to_string(paths.part(row.path)),
                         formatFull(row.value), row.deviations ? formatFull(*row.deviations) : "",
                         std::to_string(paths.depth(row.path)), eventLetters(paths, row.path)});
    return text;
}

int runOutliers(const OutliersArguments& arguments) {
    const Result<OutlierOptions> options = parseOptions(arguments);
    if (!options) return failUsage(options.error().message);
    OnePixel traced;
    if (const int code = traceOnePixel(arguments.pixel, {{"estimate", "position", "event"}}, traced); code != Exit::ok)
        return code;
    const PathSet& paths = traced.trace.paths;
    const Result<OutlierReport> report = analysis::detectOutliers(paths, *options);
    if (!report) return fail(report.error());
    const std::vector<Row> rows = rowsOf(paths, *report, *options);
    fmt::print("{}", arguments.json  ? dump(outliersJson(traced, *report, *options, rows, arguments))
                     : arguments.csv ? outliersCsv(paths, rows, arguments.quantity)
                                     : outliersText(traced, *report, *options, rows, arguments.quantity));
    return Exit::ok;
}

}  // namespace

void addOutliersCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<OutliersArguments>();
    CLI::App* command = app.add_subcommand("outliers", "The paths of a pixel that stand out from the others");
    addPixelArguments(*command, arguments->pixel);
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
        "50 --alpha 0.01");
    command->callback([arguments, &run] { run = [arguments] { return runOutliers(*arguments); }; });
}

}  // namespace emca::cli
