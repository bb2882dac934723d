#pragma once

#include <string>

#include "emca/client/connection.h"
#include "emca/client/session.h"
#include "emca/core/result.h"

namespace emca::cli {

/// The traced pixel of a session, as if a renderer had just replayed it: the newest trace that holds it, its paths alone,
/// and of these the ones for which `where` (if not empty) is true.
/// Errors: invalidArgument (the sentence names pixels that are there), those of queries.
Result<client::Trace> pixelOf(const client::Session& session, const std::string& file, Pixel pixel, const std::string& where);

}  // namespace emca::cli
