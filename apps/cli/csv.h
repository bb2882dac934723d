#pragma once

#include <string>
#include <vector>

namespace emca::cli {

/// One line of comma-separated values (RFC 4180, with a line feed alone): fields with a comma, a quotation mark or a
/// line feed stand in quotation marks, which are doubled inside.
std::string csvLine(const std::vector<std::string>& fields);

}  // namespace emca::cli
