#pragma once

#include <cstdint>
#include <filesystem>

#include "emca/core/image.h"
#include "emca/core/result.h"

namespace emca::imageio {

/// Largest image: pixels a side and 32-bit values in all.
inline constexpr std::uint32_t kMaximumSide = 65536;
inline constexpr std::uint64_t kMaximumValues = std::uint64_t(1) << 31;

/// Reads EXR, PFM, HDR, PNG and whatever else OpenImageIO knows, as 32-bit floats. Files of whole numbers (8, 16 bits)
/// are taken as sRGB and made linear, except alpha; half and float files are linear already, bit by bit. Channels keep
/// their names and order, except that R, G, B (and A) come first. The size is that of the display window; pixels
/// outside the data window are 0. Of files with several parts the first is read. Alpha stays as it is stored.
/// Errors: fileNotFound; fileUnreadable (no image, cut off, deep data, or a header that promises far more pixels than
/// the file's bytes can hold); tooLarge (beyond kMaximumSide or kMaximumValues); outOfMemory; notSupported (see
/// prepareFor()).
Result<Image> read(const std::filesystem::path& file);

/// Writes by the extension: .exr (32-bit float, all channels, losslessly compressed), .pfm (RGB, or one channel as
/// grey), .hdr (RGB with shared exponent: negative values and NaN become 0) and .png (RGB, 8 bits, sRGB-encoded and
/// clamped). Images with fewer than three channels become grey in .hdr and .png. Written to a temporary file beside it
/// and renamed, so that a crash leaves the old file whole.
/// Errors: fileUnwritable; notSupported (unknown extension; see prepareFor()); invalidArgument (no pixels, or EXR
/// channels without name or with the same one).
Result<void> write(const std::filesystem::path& file, const Image& image);

/// What write() would say about the name, the folder and its permissions, before an image is there: ask before a long
/// render. Leaves nothing behind. Errors: fileUnwritable, notSupported.
Result<void> checkWritable(const std::filesystem::path& file);

/// Says that a file is going to be read or written. Formats other than EXR and PFM need a library with a long tail, which
/// is loaded when it is first needed; after this call it is loaded beside the caller's other work. Where it is missing,
/// reading and writing them says notSupported. Any thread; returns at once.
void prepareFor(const std::filesystem::path& file);

/// Renders as one EXR: R, G, B, and the channels "samples" and "variance.R", "variance.G", "variance.B"; other
/// extensions get the colours alone.
Result<void> write(const std::filesystem::path& file, const RenderedImage& image);

}  // namespace emca::imageio
