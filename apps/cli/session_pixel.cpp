#include "session_pixel.h"

#include <fmt/format.h>

#include <algorithm>

#include "emca/analysis/format.h"
#include "emca/query/query.h"

namespace emca::cli {
namespace {

/// The paths of the pixel at place `i` of a trace of many.
client::Trace onlyPixel(const client::Trace& trace, std::size_t i) {
    client::Trace out = trace;
    const Pixel pixel = trace.pixels[i];
    out.pixels = {pixel};
    out.replays = {trace.replays.at(i)};
    out.matches.reset();  // they were about all pixels
    if (trace.pixels.size() == 1) return out;
    std::vector<Index> paths;
    for (Index p = 0; p < trace.paths.pathCount(); ++p)
        if (trace.paths.pixel(p) == pixel) paths.push_back(p);
    out.paths = trace.paths.subset(paths);
    return out;
}

std::string pixelsOf(const client::Session& session) {
    std::string text;
    std::size_t count = 0;
    for (const auto& trace : session.traces)
        for (const Pixel pixel : trace->pixels) {
            if (count < 8) text += (count > 0 ? ", " : "") + analysis::formatPixel(pixel);
            ++count;
        }
    if (count == 0) return "it holds no traced pixel";
    return fmt::format("it holds {}{}", text, count > 8 ? fmt::format(" and {} more", count - 8) : "");
}

/// A condition on paths that are here already.
Result<void> select(const std::string& where, client::Trace& trace) {
    const Result<query::Query> query = query::Query::parse(where);
    if (!query) return query.error();
    const Result<query::Matches> matches = query->select(trace.paths);
    if (!matches) return matches.error();
    MatchCounts counts;
    counts.paths = trace.paths.pathCount();
    counts.matched = matches->paths.size();
    counts.unknown = matches->unknown;
    counts.missing = matches->missing;
    trace.paths = trace.paths.subset(matches->paths);
    trace.matches = counts;
    return {};
}

}  // namespace

Result<client::Trace> pixelOf(const client::Session& session, const std::string& file, Pixel pixel, const std::string& where) {
    for (const auto& trace : session.traces) {
        const auto found = std::find(trace->pixels.begin(), trace->pixels.end(), pixel);
        if (found == trace->pixels.end()) continue;
        client::Trace one = onlyPixel(*trace, static_cast<std::size_t>(found - trace->pixels.begin()));
        if (!where.empty())
            if (const Result<void> selected = select(where, one); !selected) return selected.error();
        return one;
    }
    return Error{ErrorCode::invalidArgument,
                 fmt::format("Pixel {} was not traced in {}; {}.", analysis::formatPixel(pixel), file, pixelsOf(session))};
}

}  // namespace emca::cli
