#include "html_data.h"

#include <algorithm>

#include "emca/analysis/outliers.h"
#include "emca/analysis/path_quantities.h"
#include "emca/analysis/statistics.h"
#include "html_scene.h"
#include "path_json.h"
#include "path_table.h"
#include "version.h"

namespace emca::cli {
namespace {

using analysis::PathQuantity;

constexpr double kDeviations = 3;
constexpr int kTicks = 5;

/// The brightest paths, in the order of the set; ascending positions.
std::vector<Index> keptPaths(const PathSet& paths, std::size_t maximum) {
    std::vector<Index> kept = analysis::brightestFirst(paths);
    if (maximum > 0 && kept.size() > maximum) kept.resize(maximum);
    std::sort(kept.begin(), kept.end());
    return kept;
}

Json ticksJson(const std::vector<analysis::Tick>& ticks) {
    Json out = Json::array();
    for (const analysis::Tick& tick : ticks) out.push_back(Json::array({toJson(tick.value), tick.major ? tick.label : ""}));
    return out;
}

Json axisJson(const std::vector<double>& values, bool log) {
    analysis::RobustRangeOptions options;
    options.log = log;
    options.includeZero = !log;
    const analysis::RobustRange robust = analysis::robustRange(values, options);
    Json out;
    out["range"] = Json::array({toJson(robust.range.min), toJson(robust.range.max)});
    out["ticks"] = ticksJson(analysis::ticks(robust.range, kTicks));
    out["below"] = robust.below;
    out["above"] = robust.above;
    return out;
}

/// Positions in a series become positions of paths.
Json quantityJson(const PathSet& paths, PathQuantity quantity) {
    const analysis::PathSeries series = analysis::pathSeries(paths, quantity);
    Json out;
    out["label"] = analysis::label(quantity);
    out["unit"] = analysis::unit(quantity);
    out["values"] = Json::array();
    std::vector<Json> values(paths.pathCount());
    for (std::size_t i = 0; i < series.size(); ++i) values[series.paths[i]] = toJson(series.values[i]);
    for (Json& value : values) out["values"].push_back(std::move(value));
    for (const bool log : {false, true}) {
        Json axis = axisJson(series.values, log);
        for (const char* side : {"below", "above"})
            for (Json& i : axis[side]) i = series.paths[i.get<std::size_t>()];
        out[log ? "log" : "linear"] = std::move(axis);
    }
    const analysis::Summary summary = analysis::summarize(series.values);
    out["mean"] = toJson(summary.mean);
    return out;
}

Json samplesJson(const PathSet& paths) {
    double first = 0, last = 1;
    if (!paths.empty()) first = last = static_cast<double>(paths.sample(0));
    for (Index i = 0; i < paths.pathCount(); ++i) {
        first = std::min(first, static_cast<double>(paths.sample(i)));
        last = std::max(last, static_cast<double>(paths.sample(i)));
    }
    const analysis::ValueRange range = analysis::ValueRange{first - 0.5, last + 0.5, false}.repaired();
    return {{"range", {range.min, range.max}}, {"ticks", ticksJson(analysis::integerTicks(range, kTicks + 1))}};
}

Json depthsJson(const PathSet& paths) {
    std::int32_t least = 0, most = 0;
    for (Index i = 0; i < paths.pathCount(); ++i) {
        least = i == 0 ? paths.depth(i) : std::min(least, paths.depth(i));
        most = i == 0 ? paths.depth(i) : std::max(most, paths.depth(i));
    }
    // A renderer's depths are its own numbers; bins of several depths where they are many.
    const double width = std::max(1.0, std::ceil((static_cast<double>(most) - least + 1) / 64));
    const double bins = std::ceil((static_cast<double>(most) - least + 1) / width);
    const analysis::ValueRange range{least - 0.5, least - 0.5 + bins * width, false};
    std::vector<double> values;
    for (Index i = 0; i < paths.pathCount(); ++i) values.push_back(paths.depth(i));
    const analysis::Histogram histogram = analysis::histogram(values, range, static_cast<std::size_t>(bins));
    const auto largest = static_cast<double>(std::max<std::uint64_t>(histogram.largest(), 1));
    Json out;
    out["range"] = {range.min, range.max};
    out["width"] = width;
    out["counts"] = histogram.counts;
    out["ticks"] = ticksJson(analysis::integerTicks(range, 12));
    out["countTicks"] = ticksJson(analysis::integerTicks({0, largest, false}, kTicks));
    return out;
}

/// [from, to, kind] per segment: positions of vertices in the path, -1 for its origin; kind as in analysis::SegmentKind.
Json segmentsJson(const PathSet& paths, const std::vector<Mesh>& meshes) {
    Json out = Json::array();
    for (Index path = 0; path < paths.pathCount(); ++path) {
        const Index first = paths.vertices(path).first;
        Json segments = Json::array();
        for (const analysis::Segment& segment : analysis::pathSegments(paths, path, meshes))
            segments.push_back({segment.from == analysis::kNoIndex ? -1 : static_cast<int>(segment.from - first),
                                segment.to - first, static_cast<int>(segment.kind)});
        out.push_back(std::move(segments));
    }
    return out;
}

Json outliersJson(const PathSet& all, const std::vector<Index>& kept) {
    analysis::OutlierOptions options;
    options.deviations = kDeviations;
    const Result<analysis::OutlierReport> report = analysis::detectOutliers(all, options);
    Json out;
    if (!report) return out;
    out["deviations"] = kDeviations;
    out["considered"] = report->considered;
    out["notFinite"] = report->notFinite;
    out["mean"] = toJson(report->mean);
    out["deviation"] = toJson(report->deviation);
    out["limits"] = {toJson(report->lower), toJson(report->upper)};
    out["count"] = report->outliers.size();
    out["paths"] = Json::array();
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (std::binary_search(report->outliers.begin(), report->outliers.end(), kept[i])) out["paths"].push_back(i);
    return out;
}

Json analysisJson(const PathSet& all, const std::vector<Index>& kept, const PathSet& paths, const std::vector<Mesh>& meshes) {
    Json out;
    out["paths"] = all.pathCount();
    out["shown"] = paths.pathCount();
    out["order"] = analysis::brightestFirst(paths);
    out["outliers"] = outliersJson(all, kept);
    out["luminance"] = quantityJson(paths, PathQuantity::luminance);
    out["red"] = quantityJson(paths, PathQuantity::red);
    out["green"] = quantityJson(paths, PathQuantity::green);
    out["blue"] = quantityJson(paths, PathQuantity::blue);
    out["samples"] = samplesJson(paths);
    out["depths"] = depthsJson(paths);
    out["segments"] = segmentsJson(paths, meshes);
    out["events"] = Json::array();
    for (Index path = 0; path < paths.pathCount(); ++path) out["events"].push_back(eventLetters(paths, path));
    return out;
}

}  // namespace

Json pageJson(const PageContent& content) {
    static const std::vector<Mesh> kNoMeshes;
    const std::vector<Mesh>& meshes = content.meshes ? *content.meshes : kNoMeshes;
    const std::vector<Index> kept = keptPaths(content.trace.paths, content.maximumPaths);
    client::Trace shown = content.trace;
    shown.paths = content.trace.paths.subset(kept);

    Json out;
    out["format"] = 1;
    out["software"] = std::string("emca ") + kVersion;
    out["title"] = content.title;
    out["renderer"] = content.info ? Json(content.info->renderer) : Json(nullptr);
    out["sceneName"] = content.info ? Json(content.info->scene) : Json(nullptr);
    out["image"] = content.info ? Json{content.info->width, content.info->height} : Json(nullptr);
    out["query"] = content.query.empty() ? Json(nullptr) : Json(content.query);
    out["pixel"] = pixelJson(shown);
    out["analysis"] = analysisJson(content.trace.paths, kept, shown.paths, meshes);
    out["camera"] = content.camera ? cameraJson(*content.camera) : Json(nullptr);
    out["meshNames"] = Json::array();
    for (const Mesh& mesh : meshes) out["meshNames"].push_back(mesh.name);
    out["scene"] = content.withScene && content.meshes ? sceneJson(meshes, content.maximumTriangles) : Json(nullptr);
    return out;
}

}  // namespace emca::cli
