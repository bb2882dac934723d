#include "traced.h"

#include <fmt/format.h>

#include "arguments.h"
#include "progress_bar.h"

namespace emca::cli {

Result<PixelRect> parseRect(const std::string& text) {
    const std::vector<std::string> words = splitList(text);
    const Error wrong{ErrorCode::invalidArgument,
                      fmt::format("--rect is \"{}\"; expected X0,Y0,X1,Y1: the first column and row, and those after the last.", text)};
    if (words.size() != 4) return wrong;
    std::uint32_t numbers[4];
    for (std::size_t i = 0; i < 4; ++i) {
        const auto number = parseWhole("--rect", words[i], 0, 0xffffffffu);
        if (!number) return wrong;
        numbers[i] = static_cast<std::uint32_t>(*number);
    }
    const PixelRect rect{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (rect.empty()) return Error{ErrorCode::invalidArgument, fmt::format("--rect {} holds no pixel: X1 and Y1 are beyond the last.", text)};
    return rect;
}

Result<PixelRect> regionOf(const std::string& text, const client::ServerInfo& info) {
    if (text.empty()) return PixelRect{0, 0, info.width, info.height};
    const Result<PixelRect> rect = parseRect(text);
    if (!rect) return rect.error();
    if (rect->x1 <= info.width && rect->y1 <= info.height) return *rect;
    return Error{ErrorCode::pixelOutOfRange,
                 fmt::format("The rectangle {} reaches beyond the image of {} x {} pixels.", text, info.width, info.height)};
}

Result<void> checkInside(Pixel pixel, const client::ServerInfo& info) {
    if (pixel.x < info.width && pixel.y < info.height) return {};
    return Error{
        ErrorCode::pixelOutOfRange,
        fmt::format("Pixel ({}, {}) is outside the image of {} x {} pixels; X goes from 0 to {}, Y from 0 to {}.",
                    pixel.x, pixel.y, info.width, info.height, info.width - 1, info.height - 1)};
}

Result<client::Trace> traceWithProgress(client::Connection& connection, const std::string& title, const Region& region,
                                        const client::TraceOptions& options, const InterruptGuard& interrupt) {
    ProgressBar bar(title);
    client::RequestObserver observer;
    observer.progress = [&bar](double fraction) { bar.update(fraction); };
    observer.cancel = interrupt.flag();
    return region.pixels.empty() ? connection.traceRect(region.rect, options, observer)
                                 : connection.tracePixels(region.pixels, options, observer);
}

std::optional<query::Query> parseQuery(const std::string& text) {
    query::QueryError where;
    auto parsed = query::Query::parse(text, &where);
    if (parsed) return std::move(parsed).value();
    fmt::print(stderr, "error: {}\n{}\n", parsed.error().message, query::pointAt(text, where.where));
    return std::nullopt;
}

Json matchesJson(const std::string& query, const MatchCounts& matches) {
    Json out;
    out["query"] = query;
    out["paths"] = matches.paths;
    out["matched"] = matches.matched;
    out["unknown"] = matches.unknown;
    out["omitted"] = matches.omitted;
    out["missing"] = matches.missing;
    return out;
}

void warnAboutMatches(const MatchCounts& matches, KeepMatches keep) {
    for (const std::string& name : matches.missing)
        fmt::print(stderr, "warning: the query reads \"{}\", but no path has it\n", name);
    if (keep == KeepMatches::all && matches.omitted > 0)
        fmt::print(stderr, "warning: {} of {} matching paths did not fit into the server's budget\n", matches.omitted, matches.matched);
}

}  // namespace emca::cli
