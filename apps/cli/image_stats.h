#pragma once

#include <string>

#include "emca/core/pixel.h"

namespace emca::cli {

/// `emca stats IMAGE`: reads the image and prints what it holds per channel.
/// \param rect  of these pixels; empty: of all. \return the exit code
enum class StatsFormat { text, json, csv };
int printImageStats(const std::string& file, PixelRect rect, StatsFormat format);

}  // namespace emca::cli
