#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emca/client/connection.h"
#include "emca/query/query.h"
#include "interrupt.h"
#include "json.h"

// Traces as commands ask for them: pixels or rectangles, with a query, a bar of progress and Ctrl-C.
namespace emca::cli {

/// Some pixels, or a rectangle if there are none.
struct Region {
    std::vector<Pixel> pixels;
    PixelRect rect;
};

/// "X0,Y0,X1,Y1": columns from X0 to before X1, rows from Y0 to before Y1. Errors: invalidArgument.
Result<PixelRect> parseRect(const std::string& text);
/// The rectangle that a person named, or the whole image. Errors: invalidArgument, pixelOutOfRange (beyond the image).
Result<PixelRect> regionOf(const std::string& text, const client::ServerInfo& info);
/// Errors: pixelOutOfRange.
Result<void> checkInside(Pixel pixel, const client::ServerInfo& info);

Result<client::Trace> traceWithProgress(client::Connection& connection, const std::string& title, const Region& region,
                                        const client::TraceOptions& options, const InterruptGuard& interrupt);

/// Parses a query before anybody renders for it; says on standard error what is wrong, and points at it.
/// \return nothing if it is wrong: end with Exit::usage
std::optional<query::Query> parseQuery(const std::string& text);

/// What a query found, for scripts: {"query", "paths", "matched", "unknown", "omitted", "missing"}.
Json matchesJson(const std::string& query, const MatchCounts& matches);
/// Warns on standard error of names that no path had, and of matches that did not fit.
void warnAboutMatches(const MatchCounts& matches, KeepMatches keep);

}  // namespace emca::cli
