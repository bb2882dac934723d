#pragma once

#include <string>

#include "emca/client/session.h"
#include "json.h"

namespace emca::cli {

/// Whether a person who typed this means a session file rather than a renderer's address.
bool namesSession(const std::string& argument);

/// What a session holds, for scripts: docs/command-line.md. Without what the renderer said about itself.
Json summaryJson(const std::string& file, const client::OpenedSession& opened);
/// The same for people.
std::string summaryText(const std::string& file, const client::OpenedSession& opened);

}  // namespace emca::cli
