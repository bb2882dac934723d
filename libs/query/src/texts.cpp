#include "texts.h"

namespace emca::query::detail {

Texts::Texts(const PathSet& paths) {
    ofString_.reserve(paths.columns().strings.size());
    for (const std::string& string : paths.columns().strings) ofString_.push_back(add(string));
}

std::uint32_t Texts::add(std::string_view text) {
    const auto [it, isNew] = numbers_.try_emplace(std::string(text), static_cast<std::uint32_t>(texts_.size()));
    if (isNew) texts_.emplace_back(text);
    return it->second;
}

}  // namespace emca::query::detail
