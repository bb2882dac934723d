#include "one_pixel.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

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

PixelRect boundsOf(const std::vector<Pixel>& pixels) {
    PixelRect bounds{pixels.at(0).x, pixels[0].y, pixels[0].x + 1, pixels[0].y + 1};
    for (const Pixel p : pixels)
        bounds = {std::min(bounds.x0, p.x), std::min(bounds.y0, p.y), std::max(bounds.x1, p.x + 1), std::max(bounds.y1, p.y + 1)};
    return bounds;
}

std::vector<Pixel> pixelsIn(PixelRect rect) {
    std::vector<Pixel> pixels;
    for (std::uint32_t y = rect.y0; y < rect.y1; ++y)
        for (std::uint32_t x = rect.x0; x < rect.x1; ++x) pixels.push_back({x, y});
    return pixels;
}

bool isGiven(const SettingsArguments& s) {
    return !s.samples.empty() || !s.seed.empty() || !s.integrator.empty() || !s.sampler.empty();
}

/// Adds what was traced of a pixel of the same region.
void add(client::Trace one, client::Trace& all) {
    all.pixels.push_back(one.pixels.at(0));
    all.replays.push_back(one.replays.at(0));
    if (!one.matches || !all.matches) return;
    all.matches->paths += one.matches->paths;
    all.matches->matched += one.matches->matched;
    all.matches->unknown += one.matches->unknown;
    std::erase_if(all.matches->missing, [&](const std::string& name) { return std::ranges::find(one.matches->missing, name) == one.matches->missing.end(); });
}

Result<client::Trace> regionOf(const client::Session& session, const OnePixelArguments& arguments, const Region& region) {
    std::vector<PathSet> paths;
    client::Trace all;
    for (const Pixel pixel : region.pixels.empty() ? pixelsIn(region.rect) : region.pixels) {
        Result<client::Trace> one = pixelOf(session, arguments.source, pixel, arguments.where);
        if (!one) return one.error();
        paths.push_back(one->paths);
        if (all.pixels.empty()) all = std::move(one).value();
        else add(std::move(one).value(), all);
    }
    all.paths = PathSet::merged(paths);
    return all;
}

Result<void> fromSession(const OnePixelArguments& arguments, const Region& region, const InterruptGuard& interrupt, OnePixel& out) {
    client::RequestObserver observer;
    observer.cancel = interrupt.flag();
    Result<client::OpenedSession> opened = client::openSession(arguments.source, {}, observer);
    if (!opened) return opened.error();
    for (const std::string& notice : opened->notices) fmt::print(stderr, "warning: {}\n", printable(notice));
    Result<client::Trace> trace = regionOf(opened->session, arguments, region);
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

Result<void> checkInside(const Region& region, const OnePixelArguments& arguments, const client::ServerInfo& info) {
    if (!region.pixels.empty()) return cli::checkInside(region.pixels.front(), info);
    const Result<PixelRect> inside = cli::regionOf(arguments.rect, info);
    return inside ? Result<void>() : inside.error();
}

Result<void> fromRenderer(const OnePixelArguments& arguments, const Settings& settings, const Region& region, const WantedOfPixel& wanted,
                          const InterruptGuard& interrupt, OnePixel& out) {
    const auto connection = connect(arguments.source);
    if (!connection) return connection.error();
    auto info = (*connection)->info();
    if (!info) return info.error();
    out.info = std::move(info).value();
    if (const Result<void> inside = checkInside(region, arguments, *out.info); !inside) return inside.error();
    client::TraceOptions options;
    apply(settings, options);
    options.query = arguments.where;
    options.columns = wanted.columns;
    if (!arguments.against.empty()) {
        const Result<Color> color = colorIn(arguments.against, *out.info, region.pixels.at(0));
        if (!color) return color.error();
        options.against = client::VerdictAgainst::givenColors;
        options.colors = {*color};
    }
    auto trace = traceWithProgress(**connection, "tracing", region, options, interrupt);
    if (!trace) return trace.error();
    out.trace = std::move(trace).value();
    return wanted.scene ? fetchScene(**connection, interrupt, out) : Result<void>();
}

}  // namespace

void addPixelArguments(CLI::App& command, OnePixelArguments& arguments, bool regions) {
    command.add_option("source", arguments.source, "a session, or where the renderer listens; HOST and PORT default to 127.0.0.1 and 50013")
        ->required()
        ->type_name("FILE|HOST:PORT");
    command.add_option("x", arguments.x, "column, from 0 at the left")->required(!regions)->type_name("X");
    command.add_option("y", arguments.y, "row, from 0 at the top")->required(!regions)->type_name("Y");
    if (!regions) return;
    command.add_option("--rect", arguments.rect, "instead of X Y, the pixels from column X0 to before X1 and from row Y0 to before Y1")
        ->type_name("X0,Y0,X1,Y1");
}

namespace {

Result<Region> parseRegion(const OnePixelArguments& arguments) {
    if (arguments.rect.empty()) {
        if (arguments.x.empty() || arguments.y.empty()) return Error{ErrorCode::invalidArgument, "Name a pixel by X and Y, or several by --rect X0,Y0,X1,Y1."};
        const Result<Pixel> pixel = parsePixel(arguments.x, arguments.y);
        if (!pixel) return pixel.error();
        return Region{{*pixel}, {}};
    }
    if (!arguments.x.empty()) return Error{ErrorCode::invalidArgument, "X and Y name one pixel and --rect several: give one of the two."};
    const Result<PixelRect> rect = parseRect(arguments.rect);
    if (!rect) return rect.error();
    return Region{{}, *rect};
}

}  // namespace

int traceOnePixel(const OnePixelArguments& arguments, const WantedOfPixel& wanted, OnePixel& out) {
    const Result<Region> region = parseRegion(arguments);
    if (!region) return failUsage(region.error().message);
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    const bool session = client::isSession(arguments.source);
    if (session && (isGiven(arguments.settings) || !arguments.against.empty()))
        return failUsage("A session holds its paths already; --spp, --seed, --integrator, --sampler and --against belong to a renderer's address.");
    if (!arguments.where.empty() && !parseQuery(arguments.where)) return Exit::usage;

    const InterruptGuard interrupt;
    const Result<void> done = session ? fromSession(arguments, *region, interrupt, out)
                                      : fromRenderer(arguments, *settings, *region, wanted, interrupt, out);
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
    const bool several = trace.pixels.size() > 1;
    if (several) {
        const PixelRect rect = boundsOf(trace.pixels);
        out["rect"] = {rect.x0, rect.y0, rect.x1, rect.y1};
    } else {
        out["pixel"] = toJson(trace.pixels.at(0));
    }
    out["scene"] = traced.scene();
    out["spp"] = trace.samplesPerPixel;
    out["seed"] = trace.seed;
    out["integrator"] = trace.integrator;
    out["sampler"] = trace.sampler;
    const ReplayCounts replays = countReplays(trace.replays);
    out["verdict"] = name(several ? replays.worst() : trace.replays.at(0).verdict);
    if (several) out["replays"] = {{"exact", replays.exact}, {"close", replays.close}, {"different", replays.different}, {"unknown", replays.unknown}};
    if (trace.matches) out["where"] = matchesJson(query, *trace.matches);
    return out;
}

std::string headLine(const OnePixel& traced) {
    const client::Trace& trace = traced.trace;
    const PixelRect rect = boundsOf(trace.pixels);
    const std::string what = trace.pixels.size() == 1 ? "pixel " + analysis::formatPixel(trace.pixels[0])
                                                      : fmt::format("region {}x{} at {}", rect.x1 - rect.x0, rect.y1 - rect.y0, analysis::formatPixel({rect.x0, rect.y0}));
    std::string line = fmt::format("{} of {}, {} spp, {} paths", what, printable(traced.scene()), trace.samplesPerPixel, trace.paths.pathCount());
    if (trace.matches) line += fmt::format(" that match, of {}", trace.matches->paths);
    if (trace.pixels.size() == 1) return line + fmt::format(", replay {}\n", name(trace.replays[0].verdict));
    const ReplayCounts replays = countReplays(trace.replays);
    return line + fmt::format(", {} of {} replays exact\n", replays.exact, replays.pixels);
}

}  // namespace emca::cli
