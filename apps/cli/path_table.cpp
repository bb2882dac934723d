#include "path_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "emca/analysis/format.h"
#include "emca/analysis/outliers.h"
#include "emca/analysis/path_quantities.h"
#include "table.h"

namespace emca::cli {
namespace {

using analysis::formatColor;
using analysis::formatInteger;
using analysis::formatNumber;

constexpr double kDeviations = 3;

std::string verdictLine(const Replay& replay) {
    switch (replay.verdict) {
        case Verdict::exact:
            return fmt::format("replay exact: rendered and replayed {}, equal bits", formatColor(replay.replayed));
        case Verdict::close:
            return fmt::format("replay close: rendered {}, replayed {}", formatColor(replay.rendered),
                               formatColor(replay.replayed));
        case Verdict::different:
            return fmt::format("replay different: rendered {}, replayed {}; these paths did not make that pixel",
                               formatColor(replay.rendered), formatColor(replay.replayed));
        case Verdict::unknown:
            break;
    }
    return fmt::format(
        "replay unknown: replayed {}; no render with these settings to compare with "
        "(`emca render` makes one, --against names an image)",
        formatColor(replay.replayed));
}

std::string remarks(const client::Trace& trace) {
    std::string text;
    if (trace.replays[0].sums == SumCheck::differs)
        text += "warning: the recorded estimates do not add up to the pixel; the renderer records only a part of it\n";
    const RecordingStats& stats = trace.stats;
    if (stats.droppedByBudget > 0)
        text += fmt::format("warning: {} values did not fit into the recording's budget\n", stats.droppedByBudget);
    if (stats.droppedWithoutPath + stats.droppedWithoutVertex > 0)
        text += fmt::format("warning: {} values came before a path or vertex was begun and were dropped\n",
                            stats.droppedWithoutPath + stats.droppedWithoutVertex);
    return text;
}

struct Contents {
    bool parts = false, events = false;
    explicit Contents(const PathSet& paths) {
        for (Index path = 0; path < paths.pathCount(); ++path) {
            parts = parts || paths.part(path) != 0;
            events = events || !eventLetters(paths, path).empty();
        }
    }
};

Table makeTable(const PathSet& paths, const std::vector<Index>& order, const std::vector<Index>& outliers) {
    const Contents contents(paths);
    std::vector<Table::Column> columns{{""}, {"sample"}};
    if (contents.parts) columns.push_back({"part"});
    for (const char* header : {"depth", "luminance", "red", "green", "blue"}) columns.push_back({header});
    if (contents.events) columns.push_back({"events", Table::Align::left});
    Table table(std::move(columns));
    for (const Index path : order) {
        const bool outlier = std::binary_search(outliers.begin(), outliers.end(), path);
        std::vector<std::string> row{outlier ? "*" : "", formatInteger(paths.sample(path))};
        if (contents.parts) row.push_back(formatInteger(paths.part(path)));
        row.push_back(formatInteger(paths.depth(path)));
        if (const std::optional<Color> e = paths.estimate(path)) {
            for (const float v : {luminance(*e), e->r, e->g, e->b}) row.push_back(formatNumber(static_cast<double>(v)));
        } else {
            row.insert(row.end(), 4, "-");
        }
        if (contents.events) row.push_back(eventLetters(paths, path));
        table.add(std::move(row));
    }
    return table;
}

}  // namespace

std::string eventLetters(const PathSet& paths, Index path) {
    constexpr const char* kLobes[] = {"", "D", "G", "S", "s"};
    const auto letters = [&](Index vertex) -> std::string {
        const auto scattering = paths.scattering(vertex);
        if (!scattering) return paths.isEnvironment(vertex) ? "B" : "·";
        const std::string lobe = kLobes[std::min<std::size_t>(static_cast<std::size_t>(scattering->lobe), 4)];
        switch (scattering->event) {
            case Event::reflect:
                return "R" + lobe;
            case Event::transmit:
                return "T" + lobe;
            case Event::volume:
                return "V" + lobe;
            case Event::emission:
                return "O";
            case Event::background:
                return "B";
            case Event::absorb:
                return "x";
            case Event::pass:
                return "Ts";
            case Event::none:
                break;
        }
        return "·";
    };
    std::string text;
    bool any = false;
    const IndexRange vertices = paths.vertices(path);
    for (Index v = vertices.first; v < vertices.last; ++v) {
        any = any || paths.scattering(v).has_value();
        text += (v > vertices.first ? " " : "") + letters(v);
    }
    return any ? text : "";
}

std::string pixelReport(const client::Trace& trace, const std::string& scene, std::size_t limit) {
    const PathSet& paths = trace.paths;
    std::string text = fmt::format("pixel {} of {}, {} spp", analysis::formatPixel(trace.pixels.at(0)),
                                   printable(scene), trace.samplesPerPixel);
    for (const std::string& setting : {trace.integrator, trace.sampler})
        if (!setting.empty()) text += ", " + printable(setting);
    text += fmt::format(", seed {}\n{}\n{}\n", trace.seed, verdictLine(trace.replays.at(0)), remarks(trace));
    if (trace.matches)
        text += fmt::format("{} of {} paths match\n", trace.matches->matched, trace.matches->paths);
    if (trace.matches && trace.matches->unknown > 0)
        text += fmt::format("for {} paths it is unknown, as something was not recorded\n", trace.matches->unknown);
    if (paths.empty()) return trace.matches ? text : text + "The renderer recorded no paths for this pixel.\n";

    analysis::OutlierOptions options;
    options.deviations = kDeviations;
    const Result<analysis::OutlierReport> report = analysis::detectOutliers(paths, options);
    std::vector<Index> outliers;
    if (report) outliers = report->outliers;
    std::vector<Index> order(paths.pathCount());
    for (Index i = 0; i < paths.pathCount(); ++i) order[i] = i;
    const bool cut = limit > 0 && order.size() > limit;
    if (cut) {
        order = analysis::brightestFirst(paths);
        order.resize(limit);
    }
    text += makeTable(paths, order, outliers).text();
    text += "\nEstimates in W/(sr m²), before division by samples per pixel.\n";
    if (!outliers.empty() && report->considered < 2)
        text += fmt::format("* {} of {} paths are NaN or infinite.\n", outliers.size(), paths.pathCount());
    else if (!outliers.empty())
        text += fmt::format("* {} of {} paths beyond mean ± {:.0f} standard deviations of luminance ({} ± {}).\n",
                            outliers.size(), paths.pathCount(), kDeviations, formatNumber(report->mean),
                            formatNumber(report->deviation));
    if (cut) text += fmt::format("The {} brightest of {} paths; --limit 0 shows all.\n", limit, paths.pathCount());
    return text;
}

}  // namespace emca::cli
