#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "emca/core/path_set.h"

namespace emca::query::detail {

/// Gives equal texts equal numbers: strings of a set (whose table may hold a text twice) and those of the query.
class Texts {
  public:
    explicit Texts(const PathSet& paths);
    static constexpr std::uint32_t kNone = kNoString;

    std::uint32_t ofString(std::uint32_t string) const { return string < ofString_.size() ? ofString_[string] : kNone; }
    std::uint32_t add(std::string_view text);
    std::string_view text(std::uint32_t number) const { return texts_[number]; }
    std::size_t size() const { return texts_.size(); }

  private:
    std::vector<std::uint32_t> ofString_;
    std::vector<std::string> texts_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace emca::query::detail
