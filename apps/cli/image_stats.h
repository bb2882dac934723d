#pragma once

#include <string>

namespace emca::cli {

/// `emca stats IMAGE`: reads the image and prints what it holds per channel. \return the exit code
enum class StatsFormat { text, json, csv };
int printImageStats(const std::string& file, StatsFormat format);

}  // namespace emca::cli
