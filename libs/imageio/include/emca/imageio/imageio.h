#pragma once

#include <filesystem>

#include "emca/core/image.h"
#include "emca/core/result.h"

namespace emca::imageio {

/// Reads EXR, PFM, HDR, PNG and whatever else OpenImageIO knows, as 32-bit floats. 8- and 16-bit files are taken as
/// sRGB and made linear. Channels keep their names and order, except that R, G, B come first.
/// Errors: fileNotFound, fileUnreadable, tooLarge (beyond 65536 pixels a side or 2^31 values).
Result<Image> read(const std::filesystem::path& file);

/// Writes by the extension: .exr (32-bit float, all channels), .pfm and .hdr (RGB), .png (RGB, sRGB-encoded and
/// clamped). Written to a temporary file beside it and renamed, so that a crash leaves the old file whole.
/// Errors: fileUnwritable, notSupported (unknown extension).
Result<void> write(const std::filesystem::path& file, const Image& image);

/// Renders as one EXR: R, G, B, and the channels "samples" and "variance.R/G/B".
Result<void> write(const std::filesystem::path& file, const RenderedImage& image);

}  // namespace emca::imageio
