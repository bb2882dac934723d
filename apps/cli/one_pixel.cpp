#include "one_pixel.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "command.h"
#include "emca/analysis/format.h"
#include "emca/client/session.h"
#include "emca/imageio/imageio.h"
#include "progress_bar.h"
#include "session_pixel.h"
#include "table.h"
#include "traced.h"

namespace emca::cli {

namespace {

/// Colour of the pixel in an image that the person has, which must be of the renderer's size.
Result<Color> colorIn(const std::string& file, const client::ServerInfo& info, Pixel pixel) {
    const Result<Image> image = imageio::read(file);
    if (!image) return image.error();
    if (image->width() != info.width || image->height() != info.height)
        return Error{ErrorCode::invalidArgument,
                     fmt::format("{} has {} x {} pixels, but the renderer's image {} x {}; compare with an image of "
                                 "the same scene and size.",
                                 file, image->width(), image->height(), info.width, info.height)};
    return image->color(pixel);
}

bool isGiven(const SettingsArguments& s) {
    return !s.samples.empty() || !s.seed.empty() || !s.integrator.empty() || !s.sampler.empty();
}

Result<void> fromSession(const OnePixelArguments& arguments, Pixel pixel, const InterruptGuard& interrupt, OnePixel& out) {
    client::RequestObserver observer;
    observer.cancel = interrupt.flag();
    Result<client::OpenedSession> opened = client::openSession(arguments.source, {}, observer);
    if (!opened) return opened.error();
    for (const std::string& notice : opened->notices) fmt::print(stderr, "warning: {}\n", printable(notice));
    Result<client::Trace> trace = pixelOf(opened->session, arguments.source, pixel, arguments.where);
    if (!trace) return trace.error();
    out.info = opened->session.info;
    out.camera = opened->session.camera;
    out.meshes = opened->session.meshes;
    out.trace = std::move(trace).value();
    return {};
}

Result<void> fetchScene(client::Connection& connection, const InterruptGuard& interrupt, OnePixel& out) {
    const Result<Camera> camera = connection.camera();
    if (!camera) return camera.error();
    out.camera = *camera;
    ProgressBar bar("fetching");
    client::RequestObserver observer;
    observer.progress = [&bar](double fraction) { bar.update(fraction); };
    observer.cancel = interrupt.flag();
    Result<std::vector<Mesh>> meshes = connection.meshes(observer);
    if (!meshes) return meshes.error();
    out.meshes = std::make_shared<const std::vector<Mesh>>(std::move(meshes).value());
    return {};
}

Result<void> fromRenderer(const OnePixelArguments& arguments, const Settings& settings, Pixel pixel, const WantedOfPixel& wanted,
                          const InterruptGuard& interrupt, OnePixel& out) {
    const auto connection = connect(arguments.source);
    if (!connection) return connection.error();
    auto info = (*connection)->info();
    if (!info) return info.error();
    out.info = std::move(info).value();
    if (const Result<void> inside = checkInside(pixel, *out.info); !inside) return inside.error();
    client::TraceOptions options;
    apply(settings, options);
    options.query = arguments.where;
    options.columns = wanted.columns;
    if (!arguments.against.empty()) {
        const Result<Color> color = colorIn(arguments.against, *out.info, pixel);
        if (!color) return color.error();
        options.against = client::VerdictAgainst::givenColors;
        options.colors = {*color};
    }
    auto trace = traceWithProgress(**connection, "tracing", {{pixel}, {}}, options, interrupt);
    if (!trace) return trace.error();
    out.trace = std::move(trace).value();
    return wanted.scene ? fetchScene(**connection, interrupt, out) : Result<void>();
}

}  // namespace

void addPixelArguments(CLI::App& command, OnePixelArguments& arguments) {
    command.add_option("source", arguments.source, "a session, or where the renderer listens; HOST and PORT default to 127.0.0.1 and 50013")
        ->required()
        ->type_name("FILE|HOST:PORT");
    command.add_option("x", arguments.x, "column, from 0 at the left")->required()->type_name("X");
    command.add_option("y", arguments.y, "row, from 0 at the top")->required()->type_name("Y");
}

int traceOnePixel(const OnePixelArguments& arguments, const WantedOfPixel& wanted, OnePixel& out) {
    const Result<Pixel> pixel = parsePixel(arguments.x, arguments.y);
    if (!pixel) return failUsage(pixel.error().message);
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    const bool session = client::isSession(arguments.source);
    if (session && (isGiven(arguments.settings) || !arguments.against.empty()))
        return failUsage("A session holds its paths already; --spp, --seed, --integrator, --sampler and --against belong to a renderer's address.");
    if (!arguments.where.empty() && !parseQuery(arguments.where)) return Exit::usage;

    const InterruptGuard interrupt;
    const Result<void> done = session ? fromSession(arguments, *pixel, interrupt, out)
                                      : fromRenderer(arguments, *settings, *pixel, wanted, interrupt, out);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the trace was cancelled\n");
        return Exit::interrupted;
    }
    if (!done) return fail(done.error());
    if (out.trace.matches) warnAboutMatches(*out.trace.matches, KeepMatches::all);
    if (out.trace.stats.droppedByBudget > 0)
        fmt::print(stderr, "warning: {} values did not fit into the recording's budget\n", out.trace.stats.droppedByBudget);
    return Exit::ok;
}

Json headJson(const OnePixel& traced, const std::string& query) {
    const client::Trace& trace = traced.trace;
    Json out;
    out["pixel"] = toJson(trace.pixels.at(0));
    out["scene"] = traced.scene();
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
                                   printable(traced.scene()), trace.samplesPerPixel, trace.paths.pathCount());
    if (trace.matches) line += fmt::format(" that match, of {}", trace.matches->paths);
    return line + fmt::format(", replay {}\n", name(trace.replays.at(0).verdict));
}

}  // namespace emca::cli
