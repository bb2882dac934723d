#pragma once

#include <compare>
#include <cstdint>

namespace emca {

/// A pixel by column and row. (0, 0) is the top-left corner.
struct Pixel {
    std::uint32_t x = 0;  ///< column, in [0, image width)
    std::uint32_t y = 0;  ///< row, in [0, image height), growing downwards
    friend constexpr bool operator==(Pixel, Pixel) = default;
    /// Reading order: by row, then by column.
    friend constexpr std::strong_ordering operator<=>(Pixel a, Pixel b) {
        return a.y != b.y ? a.y <=> b.y : a.x <=> b.x;
    }
};

/// Pixels with x in [x0, x1) and y in [y0, y1).
struct PixelRect {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    friend constexpr bool operator==(const PixelRect&, const PixelRect&) = default;
    constexpr bool empty() const { return x1 <= x0 || y1 <= y0; }
    constexpr std::uint64_t count() const { return empty() ? 0 : std::uint64_t(x1 - x0) * (y1 - y0); }
    constexpr bool contains(Pixel p) const { return p.x >= x0 && p.x < x1 && p.y >= y0 && p.y < y1; }
};

}  // namespace emca
