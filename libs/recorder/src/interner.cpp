#include "interner.h"

#include <algorithm>
#include <functional>

#include "emca/core/path_set.h"

namespace emca::detail {
namespace {

/// Text longer than this is cut: a value is for a person to read.
constexpr std::size_t kLongestText = 64 * 1024;

}  // namespace

std::uint32_t Interner::addSlowly(Recent& recent, std::string_view text, Budget& budget) {
    const std::uint32_t index = find(text, budget);
    if (index != kNoString && !text.empty() && text.size() <= kLongestText)
        recent = {text.data(), text.size(), beginOf(text), index};
    return index;
}

std::uint32_t Interner::find(std::string_view text, Budget& budget) {
    text = text.substr(0, kLongestText);
    const std::uint64_t hash = std::hash<std::string_view>{}(text);
    if (strings_.size() * 2 >= slots_.size()) rehash(std::max<std::size_t>(64, slots_.size() * 2));
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t index = slots_[slot];
        if (index == kNoString) {
            if (!budget.take(text.size() + sizeof(std::string) + 16)) return kNoString;
            slots_[slot] = static_cast<std::uint32_t>(strings_.size());
            strings_.emplace_back(text);
            hashes_.push_back(hash);
            return slots_[slot];
        }
        if (hashes_[index] == hash && strings_[index] == text) return index;
    }
}

void Interner::rehash(std::size_t slots) {
    slots_.assign(slots, kNoString);
    for (std::uint32_t i = 0; i < strings_.size(); ++i) {
        std::size_t slot = hashes_[i] & (slots - 1);
        while (slots_[slot] != kNoString) slot = (slot + 1) & (slots - 1);
        slots_[slot] = i;
    }
}

}  // namespace emca::detail
