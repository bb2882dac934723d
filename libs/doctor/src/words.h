#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace emca::doctor {

/// "1 pixel", "12 pixels".
inline std::string counted(std::uint64_t n, const std::string& one, const std::string& many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}
inline std::string counted(std::uint64_t n, const std::string& one) { return counted(n, one, one + "s"); }

}  // namespace emca::doctor
