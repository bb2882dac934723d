#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace emca::explorer {

/// Numbers places of a grid in the order in which they come: open addressing, 12 bytes per slot, for millions of them.
class PlaceTable {
  public:
    static constexpr int kBits = 21;   ///< per coordinate
    static constexpr std::int64_t kLargest = (std::int64_t(1) << kBits) - 2;

    explicit PlaceTable(std::size_t expected) {
        std::size_t slots = 64;
        while (slots < 2 * expected) slots *= 2;
        keys_.assign(slots, kFree);
        numbers_.resize(slots);
    }
    /// Coordinates in [0, kLargest].
    static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
        return std::uint64_t(x) << (2 * kBits) | std::uint64_t(y) << kBits | std::uint64_t(z);
    }
    std::uint32_t count() const { return count_; }
    /// The number of a place, and whether it is a new one.
    std::pair<std::uint32_t, bool> number(std::uint64_t key) {
        if (2 * std::size_t(count_) >= keys_.size()) grow();
        const std::size_t slot = find(key);
        if (keys_[slot] == key) return {numbers_[slot], false};
        keys_[slot] = key;
        numbers_[slot] = count_;
        return {count_++, true};
    }

  private:
    static constexpr std::uint64_t kFree = ~std::uint64_t(0);
    std::size_t find(std::uint64_t key) const {
        // The upper bits of a product depend on all bits of the key (Knuth, multiplicative hashing).
        std::size_t slot = static_cast<std::size_t>((key ^ key >> 29) * 0x9e3779b97f4a7c15ull >> 20) & (keys_.size() - 1);
        while (keys_[slot] != kFree && keys_[slot] != key) slot = (slot + 1) & (keys_.size() - 1);
        return slot;
    }
    void grow() {
        std::vector<std::uint64_t> keys(2 * keys_.size(), kFree);
        std::vector<std::uint32_t> numbers(keys.size());
        keys_.swap(keys);
        numbers_.swap(numbers);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == kFree) continue;
            const std::size_t slot = find(keys[i]);
            keys_[slot] = keys[i];
            numbers_[slot] = numbers[i];
        }
    }
    std::vector<std::uint64_t> keys_;
    std::vector<std::uint32_t> numbers_;
    std::uint32_t count_ = 0;
};

}  // namespace emca::explorer
