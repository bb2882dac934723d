// `emca assert`: a condition that must hold for every path of an image, for continuous integration.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "emca/analysis/format.h"
#include "settings_options.h"
#include "traced.h"

namespace emca::cli {
namespace {

struct AssertArguments {
    std::string address, condition, rect;
    SettingsArguments settings;
    bool json = false;
};

/// A path for which it does not hold.
struct Counterexample {
    Pixel pixel;
    std::int64_t sample = 0;
    std::int32_t part = 0;
    std::optional<Color> estimate;
};

struct Asserted {
    client::Trace trace;
    std::size_t failingPixels = 0;
    std::vector<Counterexample> examples;   ///< of the first pixels that fail, a few
    bool holds() const { return trace.matches->paths > 0 && trace.matches->matched == trace.matches->paths; }
};

/// Paths of the first failing pixels for which the condition is not true.
Result<void> findExamples(client::Connection& connection, client::TraceOptions options, const InterruptGuard& interrupt, Asserted& asserted) {
    constexpr std::size_t kPixels = 3, kExamples = 5;
    const MatchCounts& matches = *asserted.trace.matches;
    Region region;
    for (std::size_t i = 0; i < matches.matchedOfPixel.size(); ++i) {
        if (matches.matchedOfPixel[i] >= asserted.trace.samplesPerPixel) continue;
        ++asserted.failingPixels;
        if (region.pixels.size() < kPixels) region.pixels.push_back(asserted.trace.pixels[i]);
    }
    if (region.pixels.empty()) return {};
    options.query = "(" + options.query + ") == false";
    options.keep = KeepMatches::all;
    const auto trace = traceWithProgress(connection, "finding examples", region, options, interrupt);
    if (!trace) return trace.error();
    const PathSet& paths = trace->paths;
    for (Index p = 0; p < paths.pathCount() && asserted.examples.size() < kExamples; ++p)
        asserted.examples.push_back({paths.pixel(p), paths.sample(p), paths.part(p), paths.estimate(p)});
    return {};
}

Json assertJson(const Asserted& asserted, const std::string& condition) {
    Json out;
    out["assertion"] = condition;
    out["holds"] = asserted.holds();
    const MatchCounts& matches = *asserted.trace.matches;
    out["paths"] = matches.paths;
    out["true"] = matches.matched;
    out["false"] = matches.paths - matches.matched - matches.unknown;
    out["unknown"] = matches.unknown;
    out["missing"] = matches.missing;
    out["failingPixels"] = asserted.failingPixels;
    out["examples"] = Json::array();
    for (const Counterexample& example : asserted.examples) {
        Json one;
        one["pixel"] = toJson(example.pixel);
        one["sample"] = example.sample;
        one["part"] = example.part;
        one["estimate"] = toJson(example.estimate);
        out["examples"].push_back(std::move(one));
    }
    return out;
}

std::string number(std::uint64_t value) { return analysis::formatInteger(static_cast<std::int64_t>(value)); }

std::string report(const Asserted& asserted, const std::string& condition) {
    const MatchCounts& matches = *asserted.trace.matches;
    if (asserted.holds()) return fmt::format("true: {} holds for {} paths in {} pixels\n", condition, number(matches.paths), number(asserted.trace.pixels.size()));
    if (matches.paths == 0) return fmt::format("false: {} was asked, but the renderer recorded no path\n", condition);
    std::string text = fmt::format("false: {} does not hold for {} of {} paths", condition,
                                   number(matches.paths - matches.matched - matches.unknown), number(matches.paths));
    if (matches.unknown > 0) text += fmt::format(" and is unknown for {}", number(matches.unknown));
    text += fmt::format(", in {} pixels\n", number(asserted.failingPixels));
    for (const Counterexample& example : asserted.examples) {
        text += fmt::format("  pixel {}, sample {}", analysis::formatPixel(example.pixel), example.sample);
        if (example.estimate) text += ": " + analysis::formatColor(*example.estimate);
        text += "\n";
    }
    return text;
}

int runAssert(const AssertArguments& arguments) {
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    if (!arguments.rect.empty())
        if (const auto rect = parseRect(arguments.rect); !rect) return failUsage(rect.error().message);
    if (!parseQuery(arguments.condition)) return Exit::usage;
    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    const auto info = (*connection)->info();
    if (!info) return fail(info.error());
    const auto rect = regionOf(arguments.rect, *info);
    if (!rect) return fail(rect.error());

    client::TraceOptions options;
    apply(*settings, options);
    options.query = arguments.condition;
    options.keep = KeepMatches::none;
    options.columns = {"estimate"};
    const InterruptGuard interrupt;
    Asserted asserted;
    auto trace = traceWithProgress(**connection, "checking", {{}, *rect}, options, interrupt);
    Result<void> examples;
    if (trace) {
        asserted.trace = std::move(trace).value();
        if (!asserted.holds()) examples = findExamples(**connection, options, interrupt, asserted);
    }
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the assertion was not decided\n");
        return Exit::interrupted;
    }
    if (!trace) return fail(trace.error());
    if (!examples) return fail(examples.error());
    fmt::print("{}", arguments.json ? dump(assertJson(asserted, arguments.condition)) : report(asserted, arguments.condition));
    warnAboutMatches(*asserted.trace.matches, KeepMatches::none);
    return asserted.holds() ? Exit::ok : Exit::assertionFalse;
}

}  // namespace

void addAssertCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<AssertArguments>();
    CLI::App* command = app.add_subcommand("assert", "Ends with 1 unless a condition is true for every path of the image");
    addAddressOption(*command, arguments->address);
    command->add_option("condition", arguments->condition, "a condition on paths (docs/queries.md)")->required()->type_name("QUERY");
    command->add_option("--rect", arguments->rect, "a part of the image (default: all of it)")->type_name("X0,Y0,X1,Y1");
    addSettingsOptions(*command, arguments->settings);
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer("Example:\n  emca assert localhost:50013 'none(nan(estimate))' --spp 16\n\n"
                    "Unknown is not true: a name that no path has makes the assertion fail.");
    command->callback([arguments, &run] { run = [arguments] { return runAssert(*arguments); }; });
}

}  // namespace emca::cli
