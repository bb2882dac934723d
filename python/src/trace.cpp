// What a trace brought besides its paths.
#include "arrays.h"
#include "bindings.h"
#include "emca/client/connection.h"

namespace emca::python {
namespace {

using client::Trace;
using SharedTrace = std::shared_ptr<Trace>;

/// (verdict, sums, rendered, replayed) per pixel
py::list replaysOf(const Trace& trace) {
    py::list out;
    for (const Replay& replay : trace.replays)
        out.append(py::make_tuple(name(replay.verdict), name(replay.sums), toTuple(replay.rendered),
                                  toTuple(replay.replayed)));
    return out;
}

py::dict settingsOf(const Trace& trace) {
    py::dict out;
    out["samples_per_pixel"] = trace.samplesPerPixel;
    out["render_seconds"] = trace.renderSeconds;
    out["total_seconds"] = trace.totalSeconds;
    out["render_id"] = trace.renderId;
    out["seed"] = trace.seed;
    out["integrator"] = toText(trace.integrator);
    out["sampler"] = toText(trace.sampler);
    return out;
}

py::dict statsOf(const Trace& trace) {
    py::dict out;
    out["dropped_without_path"] = trace.stats.droppedWithoutPath;
    out["dropped_without_vertex"] = trace.stats.droppedWithoutVertex;
    out["dropped_by_budget"] = trace.stats.droppedByBudget;
    out["paths_not_kept"] = trace.stats.pathsNotKept;
    out["bytes"] = trace.stats.bytes;
    return out;
}

py::object matchesOf(const SharedTrace& trace) {
    if (!trace->matches) return py::none();
    const MatchCounts& matches = *trace->matches;
    py::dict out;
    out["paths"] = matches.paths;
    out["matched"] = matches.matched;
    out["unknown"] = matches.unknown;
    out["omitted"] = matches.omitted;
    out["missing"] = toList(matches.missing);
    out["matched_of_pixel"] = view(matches.matchedOfPixel, Number::uint32);
    out["sum_of_pixel"] = view(matches.sumOfPixel, Number::float32, 3);
    return out;
}

}  // namespace

void bindTrace(py::module_& module) {
    py::class_<Trace, SharedTrace>(module, "Trace")
        .def("settings", &settingsOf)
        .def("stats", &statsOf)
        .def("replays", &replaysOf)
        .def("matches", &matchesOf)
        .def("pixels",
             [](const SharedTrace& trace) {
                 return view(trace->pixels.data(), Number::uint32, trace->pixels.size(), 2, sizeof(Pixel), trace);
             })
        .def("paths", [](const SharedTrace& trace) { return std::shared_ptr<PathSet>(trace, &trace->paths); });
}

}  // namespace emca::python
