#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emca/analysis/color_map.h"

/// Axes beside each other with a line for each path (parallel coordinates): where values lie, and how many lines pass
/// where. Source: Inselberg, "The plane with parallel coordinates", The Visual Computer 1(2), 1985.
namespace emca::analysis {

/// Where a value is along an axis. What the range does not hold has places of its own at the ends.
enum class AxisPlace : std::uint8_t {
    inside,
    above,    ///< larger than the range, +infinity
    below,    ///< smaller than the range, -infinity; on logarithmic axes 0 and negative values
    nan,
    missing,  ///< nothing was recorded
};

/// How values lie on an axis. Never invalid, whatever the values are.
struct AxisScale {
    ValueRange range;
    std::uint32_t above = 0, below = 0, nan = 0, missing = 0;   ///< how many values are there
    double leastAbove = 0, greatestBelow = 0;                   ///< nearest ones beyond the range; only if there are any

    AxisPlace place(double value, bool known) const {
        if (!known) return AxisPlace::missing;
        if (value != value) return AxisPlace::nan;
        return value > range.max ? AxisPlace::above : value < range.min ? AxisPlace::below : AxisPlace::inside;
    }
};
struct AxisScaleOptions {
    bool log = false;
    bool integral = false;        ///< whole numbers: each has room of the same height
    std::uint32_t categories = 0; ///< values are places in a list of so many: the axis shows them all
    bool includeZero = false;     ///< linear only
};
/// Robust: a few values far away do not flatten the rest (robustRange).
/// \param known  1 per value that there is; as many as values, or empty: all
AxisScale axisScale(std::span<const double> values, std::span<const std::uint8_t> known, const AxisScaleOptions& options = {});

/// The number with the fewest digits that is not farther than `tolerance` from `value`: what a person meant who pointed
/// at it. `value` itself if it is not finite or the tolerance is not positive.
double roundedWithin(double value, double tolerance);

/// How many lines between two axes pass each cell of a picture.
struct LineDensity {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> counts;   ///< column by column, each from the first row on
    std::uint32_t largest = 0;
    std::uint32_t count(std::uint32_t column, std::uint32_t row) const { return counts[std::size_t(column) * height + row]; }
};
/// Lines from a row at the left edge to a row at the right edge, connected: in each column a line passes every row from
/// the one where it enters to the one where it leaves. Ends are taken as the middle of their row, so that the cost is
/// bounded by height² · width whatever the number of lines (after Novotny and Hauser, "Outlier-Preserving Focus+Context
/// Visualization in Parallel Coordinates", IEEE TVCG 12(5), 2006, section 3).
/// \param left, right  rows in [0, height), equally many; larger ones (kNoRow) have no line
inline constexpr std::uint16_t kNoRow = 0xffff;
LineDensity lineDensity(std::span<const std::uint16_t> left, std::span<const std::uint16_t> right, std::uint32_t width, std::uint32_t height);

}  // namespace emca::analysis
