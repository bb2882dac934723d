#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "emca/core/result.h"

namespace emca::imageio {

/// An image as its file stores it: for textures, which keep bytes as bytes. Pixels are interleaved, rows from the top,
/// the data window alone.
struct StoredImage {
    std::uint32_t width = 0, height = 0;  ///< of the stored pixels
    std::vector<std::string> channels;    ///< one name for each value of a pixel
    int alphaChannel = -1;                ///< index of opacity, or -1; colours are not multiplied with it
    bool wholeNumbers = false;            ///< sRGB by convention, except opacity; others are linear
    std::vector<std::uint8_t> bytes;      ///< of files with 8 bits a value, which mean byte / 255
    std::vector<float> floats;            ///< of all others; whole numbers are scaled to [0, 1]

    /// The display window, counted from the first stored pixel. As the file says: it may be far larger than any memory.
    struct Frame {
        std::int64_t x = 0, y = 0, width = 0, height = 0;
    } frame;
};

/// Reads what read() reads. Order of the channels: layer by layer, those without a layer first; in a layer R, G, B, Y,
/// A, Z in this order, then others by name. Any thread.
/// Errors: as read().
Result<StoredImage> readStored(const std::filesystem::path& file);

}  // namespace emca::imageio
