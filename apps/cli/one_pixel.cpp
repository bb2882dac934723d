#include "one_pixel.h"

#include <fmt/format.h>

#include "command.h"
#include "emca/analysis/format.h"
#include "table.h"
#include "traced.h"

namespace emca::cli {

int traceOnePixel(const OnePixelArguments& arguments, std::vector<std::string> columns, OnePixel& out) {
    const Result<Pixel> pixel = parsePixel(arguments.x, arguments.y);
    if (!pixel) return failUsage(pixel.error().message);
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    if (!arguments.where.empty() && !parseQuery(arguments.where)) return Exit::usage;

    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    auto info = (*connection)->info();
    if (!info) return fail(info.error());
    if (const Result<void> inside = checkInside(*pixel, *info); !inside) return fail(inside.error());
    client::TraceOptions options;
    apply(*settings, options);
    options.query = arguments.where;
    options.columns = std::move(columns);
    const InterruptGuard interrupt;
    auto trace = traceWithProgress(**connection, "tracing", {{*pixel}, {}}, options, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the trace was cancelled\n");
        return Exit::interrupted;
    }
    if (!trace) return fail(trace.error());
    if (trace->matches) warnAboutMatches(*trace->matches, options.keep);
    if (trace->stats.droppedByBudget > 0)
        fmt::print(stderr, "warning: {} values did not fit into the recording's budget\n",
                   trace->stats.droppedByBudget);
    out.info = std::move(info).value();
    out.trace = std::move(trace).value();
    return Exit::ok;
}

Json headJson(const OnePixel& traced, const std::string& query) {
    const client::Trace& trace = traced.trace;
    Json out;
    out["pixel"] = toJson(trace.pixels.at(0));
    out["scene"] = traced.info.scene;
    out["spp"] = trace.samplesPerPixel;
    out["seed"] = trace.seed;
    out["integrator"] = trace.integrator;
    out["sampler"] = trace.sampler;
    out["verdict"] = name(trace.replays.at(0).verdict);
    if (trace.matches) out["where"] = matchesJson(query, *trace.matches);
    return out;
}

std::string headLine(const OnePixel& traced) {
    const client::Trace& trace = traced.trace;
    std::string line = fmt::format("pixel {} of {}, {} spp, {} paths", analysis::formatPixel(trace.pixels.at(0)),
                                   printable(traced.info.scene), trace.samplesPerPixel, trace.paths.pathCount());
    if (trace.matches) line += fmt::format(" that match, of {}", trace.matches->paths);
    return line + fmt::format(", replay {}\n", name(trace.replays.at(0).verdict));
}

}  // namespace emca::cli
