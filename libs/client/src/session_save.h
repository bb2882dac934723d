#pragma once

#include <string>

#include "emca/client/session.h"
#include "session_writer.h"

namespace emca::client {

/// saveSession() with a look at every step that changes the disk.
Result<void> saveSession(const std::filesystem::path& file, const Session& session, const RequestObserver& observer,
                         SessionWriter::Step step, std::uint64_t now, const std::string& software);

}  // namespace emca::client
