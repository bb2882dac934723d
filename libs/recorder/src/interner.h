#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "pages.h"

namespace emca::detail {

/// Strings of one thread, each once.
class Interner {
  public:
    /// Index of the text, new or known; kNoString if it is new and the budget has no room for it.
    std::uint32_t add(std::string_view text, Budget& budget) {
        Recent& recent = recent_[placeOf(text.data())];
        // The memory may hold another text by now, so the contents decide.
        if (recent.data == text.data() && recent.size == text.size() && recent.begin == beginOf(text) &&
            (text.size() <= sizeof(Ends) || strings_[recent.index] == text)) [[likely]]
            return recent.index;
        return addSlowly(recent, text, budget);
    }
    const std::vector<std::string>& strings() const { return strings_; }

  private:
    /// All of a text of up to 16 bytes, without a call: its first and its last 8 bytes, which may overlap.
    struct Ends {
        std::uint64_t first = 0, last = 0;
        friend bool operator==(const Ends&, const Ends&) = default;
    };
    static Ends beginOf(std::string_view text) {
        const auto read = [&](std::size_t from, auto kind) {
            decltype(kind) bytes;
            std::memcpy(&bytes, text.data() + from, sizeof bytes);
            return std::uint64_t(bytes);
        };
        const std::size_t n = text.size();
        if (n >= 16) return {read(0, std::uint64_t()), read(8, std::uint64_t())};
        if (n >= 8) return {read(0, std::uint64_t()), read(n - 8, std::uint64_t())};
        if (n >= 4) return {read(0, std::uint32_t()), read(n - 4, std::uint32_t())};
        if (n >= 2) return {read(0, std::uint16_t()), read(n - 2, std::uint16_t())};
        if (n == 1) return {read(0, std::uint8_t()), 0};
        return {};
    }
    /// Texts that came lately, by where they lie: a renderer says the same literals and names again and again.
    struct Recent {
        const char* data = nullptr;
        std::size_t size = 0;
        Ends begin;
        std::uint32_t index = 0;
    };
    /// Literals lie close together, so the bits of their addresses are mixed (Fibonacci hashing).
    static constexpr int kRecentBits = 6;
    static std::size_t placeOf(const char* text) {
        return (reinterpret_cast<std::uintptr_t>(text) * 0x9e3779b97f4a7c15ull) >> (64 - kRecentBits);
    }

    std::uint32_t addSlowly(Recent& recent, std::string_view text, Budget& budget);
    std::uint32_t find(std::string_view text, Budget& budget);
    void rehash(std::size_t slots);

    Recent recent_[std::size_t(1) << kRecentBits];
    std::vector<std::string> strings_;
    std::vector<std::uint32_t> slots_;  ///< open addressing; kNoString marks a free slot
    std::vector<std::uint64_t> hashes_;
};

}  // namespace emca::detail
