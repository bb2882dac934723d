#pragma once

#include <cstdint>
#include <filesystem>

#include "emca/core/result.h"

namespace emca::imageio {

/// Whether a header may be believed enough to get memory for it.
/// Errors: fileUnreadable (nothing, or far more than `fileBytes` can hold), tooLarge.
Result<void> checkSize(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                       std::int64_t channels, std::uintmax_t fileBytes);

}  // namespace emca::imageio
