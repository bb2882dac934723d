#pragma once

#include <cstdint>
#include <filesystem>

#include "emca/core/image.h"
#include "emca/core/result.h"

namespace emca::imageio {

// Portable float map: "PF" and three channels or "Pf" and one, size, scale (negative: little endian), then rows from
// the bottom. Source: Debevec's description of the format. Our own, because the library's scales its values, which
// changes the bits of NaN.

/// Whether a file begins as one.
bool isPfm(const std::filesystem::path& file);
/// Errors: fileUnreadable, tooLarge.
Result<Image> readPfm(const std::filesystem::path& file, std::uintmax_t fileBytes);
/// Bits as they are. Errors: fileUnwritable.
Result<void> writePfm(const std::filesystem::path& file, const Image& image);

}  // namespace emca::imageio
