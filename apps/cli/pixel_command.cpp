#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "emca/imageio/imageio.h"
#include "path_json.h"
#include "path_table.h"
#include "settings_options.h"
#include "traced.h"

namespace emca::cli {
namespace {

struct PixelArguments {
    std::string address, x, y, against, where, limit = "32";
    SettingsArguments settings;
    bool json = false;
};

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

int runPixel(const PixelArguments& arguments) {
    const Result<Pixel> pixel = parsePixel(arguments.x, arguments.y);
    if (!pixel) return failUsage(pixel.error().message);
    const Result<Settings> settings = parseSettings(arguments.settings);
    if (!settings) return failUsage(settings.error().message);
    const Result<std::uint64_t> limit = parseWhole("--limit", arguments.limit, 0, 1u << 30);
    if (!limit) return failUsage(limit.error().message);

    if (!arguments.where.empty() && !parseQuery(arguments.where)) return Exit::usage;

    const auto connection = connect(arguments.address);
    if (!connection) return fail(connection.error());
    const Result<client::ServerInfo> info = (*connection)->info();
    if (!info) return fail(info.error());
    if (const Result<void> inside = checkInside(*pixel, *info); !inside) return fail(inside.error());

    client::TraceOptions options;
    apply(*settings, options);
    options.query = arguments.where;
    if (!arguments.against.empty()) {
        const Result<Color> color = colorIn(arguments.against, *info, *pixel);
        if (!color) return fail(color.error());
        options.against = client::VerdictAgainst::givenColors;
        options.colors = {*color};
    }
    const InterruptGuard interrupt;
    const Result<client::Trace> trace = traceWithProgress(**connection, "tracing", {{*pixel}, {}}, options, interrupt);
    if (interrupt.interrupted()) {
        fmt::print(stderr, "interrupted: the trace was cancelled\n");
        return Exit::interrupted;
    }
    if (!trace) return fail(trace.error());
    Json json = pixelJson(*trace);
    if (trace->matches) json["where"] = matchesJson(arguments.where, *trace->matches);
    fmt::print("{}", arguments.json ? dump(json) : pixelReport(*trace, info->scene, *limit));
    if (trace->matches) warnAboutMatches(*trace->matches, options.keep);
    return Exit::ok;
}

}  // namespace

void addPixelCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<PixelArguments>();
    CLI::App* command = app.add_subcommand("pixel", "Replays one pixel and shows every light path that made it");
    addAddressOption(*command, arguments->address);
    command->add_option("x", arguments->x, "column, from 0 at the left")->required()->type_name("X");
    command->add_option("y", arguments->y, "row, from 0 at the top")->required()->type_name("Y");
    addSettingsOptions(*command, arguments->settings);
    command->add_option("--against", arguments->against, "compare with this image instead of the renderer's latest")
        ->type_name("IMAGE");
    command->add_option("--where", arguments->where, "only paths for which a condition is true (docs/queries.md)")
        ->type_name("QUERY");
    command->add_option("--limit", arguments->limit, "show at most so many paths, the brightest (default 32, 0: all)")
        ->type_name("N");
    command->add_flag("--json", arguments->json, "everything that was recorded, for scripts");
    command->footer(
        "Examples:\n  emca pixel localhost:50013 117 64\n"
        "  emca pixel localhost:50013 117 64 --json | jq '.paths | max_by(.estimate[0])'\n"
        "  emca pixel localhost:50013 117 64 --where 'any(v.lobe == \"specular\") and luminance > 10'");
    command->callback([arguments, &run] { run = [arguments] { return runPixel(*arguments); }; });
}

}  // namespace emca::cli
