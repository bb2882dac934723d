#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "emca/core/result.h"

namespace emca::render {

/// The whole content of a file.
/// Errors: fileNotFound, fileUnreadable (a folder, no permission), tooLarge beyond `limit` bytes, outOfMemory.
Result<std::string> readFileBytes(const std::filesystem::path& path, std::uint64_t limit);

}  // namespace emca::render
