#include "path_json.h"

#include <cmath>

namespace emca::cli {
namespace {

/// Adds "data" (of each key the last value) and, if a key has several values, "history" (all of them in call order).
void addData(const PathSet& paths, Scope scope, Index owner, Json& out) {
    Json data = Json::object(), history = Json::object();
    for (const Column& column : paths.userColumns()) {
        if (column.scope != scope) continue;
        const IndexRange values = column.valuesOf(owner);
        if (values.empty()) continue;
        const bool repeated = values.size() > 1 || data.contains(column.name);
        if (repeated && !history.contains(column.name)) {
            history[column.name] = Json::array();
            if (data.contains(column.name)) history[column.name].push_back(data[column.name]);  // of another type
        }
        for (Index i = values.first; repeated && i < values.last; ++i)
            history[column.name].push_back(toJson(paths.value(column, i)));
        data[column.name] = toJson(paths.value(column, values.last - 1));
    }
    out["data"] = std::move(data);
    if (!history.empty()) out["history"] = std::move(history);
}

Json eventJson(const PathSet& paths, Index vertex) {
    const auto scattering = paths.scattering(vertex);
    if (!scattering) return nullptr;
    Json out;
    out["type"] = name(scattering->event);
    out["lobe"] = name(scattering->lobe);
    out["label"] = scattering->label.empty() ? Json(nullptr) : Json(scattering->label);
    return out;
}

Json surfaceJson(const PathSet& paths, Index vertex) {
    const auto surface = paths.surface(vertex);
    if (!surface) return nullptr;
    return {{"mesh", surface->mesh}, {"face", surface->face}};
}

Json nextEventsJson(const PathSet& paths, Index vertex) {
    Json events = Json::array();
    const IndexRange range = paths.nextEvents(vertex);
    for (Index i = range.first; i < range.last; ++i) {
        const NextEvent& event = paths.nextEvent(i);
        events.push_back({{"position", toJson(event.position)}, {"visible", event.visible != 0}});
    }
    return events;
}

Json vertexJson(const PathSet& paths, Index vertex) {
    const std::optional<Vec3f> position = paths.position(vertex);
    const bool environment = paths.isEnvironment(vertex);
    Json out;
    out["depth"] = paths.depthIndex(vertex);
    if (paths.subpath(vertex) == Subpath::light) out["subpath"] = "light";
    out["position"] = environment ? Json(nullptr) : toJson(position);
    out["event"] = eventJson(paths, vertex);
    out["surface"] = surfaceJson(paths, vertex);
    out["nee"] = nextEventsJson(paths, vertex);
    out["envmap"] = environment ? toJson(position) : Json(nullptr);
    out["estimate"] = toJson(paths.vertexEstimate(vertex));
    out["emission"] = toJson(paths.emission(vertex));
    addData(paths, Scope::vertex, vertex, out);
    return out;
}

void addContributions(const PathSet& paths, Index vertex, Json& out) {
    const IndexRange range = paths.contributions(vertex);
    for (Index i = range.first; i < range.last; ++i) {
        const Contribution& c = paths.contribution(i);
        Json item;
        item["depth"] = paths.depthIndex(vertex);
        if (paths.subpath(vertex) == Subpath::light) item["subpath"] = "light";
        item["technique"] = paths.text(c.technique);
        item["value"] = toJson(c.value);
        // NaN is how a recording says that the renderer gave none.
        item["misWeight"] = std::isnan(c.misWeight) ? Json(nullptr) : toJson(c.misWeight);
        item["end"] = name(c.end);
        out.push_back(std::move(item));
    }
}

Json splatsJson(const PathSet& paths, IndexRange range) {
    Json splats = Json::array();
    for (Index i = range.first; i < range.last; ++i) {
        const Splat& splat = paths.columns().splats[i];
        splats.push_back({{"pixel", toJson(splat.pixel)}, {"value", toJson(splat.value)}});
    }
    return splats;
}

Json pathJson(const PathSet& paths, Index path) {
    Json out;
    out["sample"] = paths.sample(path);
    out["part"] = paths.part(path);
    out["origin"] = toJson(paths.origin(path));
    out["depth"] = paths.depth(path);
    out["estimate"] = toJson(paths.estimate(path));
    addData(paths, Scope::path, path, out);
    Json contributions = Json::array(), vertices = Json::array();
    const IndexRange range = paths.vertices(path);
    for (Index v = range.first; v < range.last; ++v) {
        addContributions(paths, v, contributions);
        vertices.push_back(vertexJson(paths, v));
    }
    out["contributions"] = std::move(contributions);
    if (const IndexRange splats = paths.splats(path); !splats.empty()) out["splats"] = splatsJson(paths, splats);
    out["vertices"] = std::move(vertices);
    return out;
}

Json replayJson(const Replay& replay) {
    Json out;
    out["verdict"] = name(replay.verdict);
    out["rendered"] = replay.verdict == Verdict::unknown ? Json(nullptr) : toJson(replay.rendered);
    out["replayed"] = toJson(replay.replayed);
    out["sums"] = name(replay.sums);
    return out;
}

}  // namespace

Json pathsJson(const PathSet& paths) {
    Json out = Json::array();
    for (Index path = 0; path < paths.pathCount(); ++path) out.push_back(pathJson(paths, path));
    return out;
}

Json pixelJson(const client::Trace& trace) {
    Json out;
    out["pixel"] = toJson(trace.pixels.at(0));
    out["spp"] = trace.samplesPerPixel;
    out["seed"] = trace.seed;
    out["integrator"] = trace.integrator;
    out["sampler"] = trace.sampler;
    out["replay"] = replayJson(trace.replays.at(0));
    const RecordingStats& stats = trace.stats;
    if (stats.droppedWithoutPath + stats.droppedWithoutVertex + stats.droppedByBudget > 0)
        out["dropped"] = {{"withoutPath", stats.droppedWithoutPath},
                          {"withoutVertex", stats.droppedWithoutVertex},
                          {"byBudget", stats.droppedByBudget}};
    out["paths"] = pathsJson(trace.paths);
    return out;
}

}  // namespace emca::cli
