#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "emca/imageio/stored_image.h"

namespace emca::imageio {

/// Whether a file begins as JPEG files do.
bool isJpeg(const std::filesystem::path& file);

/// Reads a grey or RGB JPEG by libjpeg, as textures usually are: values as OpenImageIO gives them, without the quarter of
/// a second in which that is loaded. Nothing for what is unusual (CMYK, beyond the limits) and where anything is wrong with
/// the file: OpenImageIO then reads it, or says what is wrong.
std::optional<StoredImage> readJpeg(const std::filesystem::path& file, std::uintmax_t fileBytes, bool keepBytes);

}  // namespace emca::imageio
