#pragma once

#include "emca/client/connection.h"
#include "emca/core/path_set.h"
#include "json.h"

namespace emca::cli {

/// The answer of `emca pixel --json` (docs/command-line.md has every member). \param trace  of one pixel
Json pixelJson(const client::Trace& trace);

/// All paths, in their order.
Json pathsJson(const PathSet& paths);

}  // namespace emca::cli
