#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "emca/client/connection.h"
#include "json.h"

namespace emca::cli {

/// What a person typed who asks about the paths of one pixel.
struct OnePixelArguments {
    std::string address, x, y, where;
    SettingsArguments settings;
};

struct OnePixel {
    client::ServerInfo info;
    client::Trace trace;
};

/// Replays a pixel and records `columns`. Says on standard error what went wrong, and what the query found wanting.
/// \return Exit::ok, or how to end: nothing is in `out` then
int traceOnePixel(const OnePixelArguments& arguments, std::vector<std::string> columns, OnePixel& out);

/// {"pixel", "scene", "spp", "seed", "integrator", "sampler", "verdict"} and, if there was a query, "where".
Json headJson(const OnePixel& traced, const std::string& query);
/// The same as a line for people.
std::string headLine(const OnePixel& traced);

}  // namespace emca::cli
