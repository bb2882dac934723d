#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/analysis/color_map.h"

namespace emca::analysis {

/// Moments and extremes of the finite values; others are counted apart.
struct Summary {
    std::size_t count = 0;             ///< all values
    std::size_t finite = 0;
    std::size_t nan = 0, positiveInfinite = 0, negativeInfinite = 0;
    double min = 0, max = 0;           ///< 0 if there is no finite value
    double mean = 0;
    double variance = 0;               ///< unbiased (divided by n - 1); 0 for fewer than two values
    double deviation() const;          ///< square root of variance
    double standardError() const;      ///< of the mean: deviation / sqrt(finite); 0 for fewer than two values
};
/// Welford's recurrence, so that a large mean does not eat the variance.
Summary summarize(std::span<const double> values);
Summary summarize(std::span<const float> values);

/// Quantile p in [0, 1] of sorted finite values by linear interpolation between order statistics (Hyndman and Fan 1996,
/// type 7). NaN if there are none.
double quantile(std::span<const double> sorted, double p);
/// The finite values in ascending order.
std::vector<double> sortedFinite(std::span<const double> values);

/// Bins of equal width on a linear or logarithmic range. The last bin includes the range's end.
struct Histogram {
    ValueRange range;
    std::vector<std::uint64_t> counts;
    std::uint64_t below = 0, above = 0;         ///< finite, outside the range (logarithmic: <= 0 is below)
    std::uint64_t nan = 0, positiveInfinite = 0, negativeInfinite = 0;

    std::size_t binCount() const { return counts.size(); }
    double lower(std::size_t bin) const;        ///< edges in values, also on logarithmic ranges
    double upper(std::size_t bin) const { return lower(bin + 1); }
    std::uint64_t largest() const;
};
/// \param bins  at least 1 (0 counts as 1). An invalid range is repaired first.
Histogram histogram(std::span<const double> values, const ValueRange& range, std::size_t bins);
Histogram histogram(std::span<const float> values, const ValueRange& range, std::size_t bins);
/// Freedman and Diaconis 1981, kept within [1, maximum]; for integers at most one bin per integer is useful, see `integral`.
std::size_t suggestedBins(std::span<const double> values, const ValueRange& range, std::size_t maximum = 100, bool integral = false);

/// Part of the values that a plot should span so that a few outliers do not flatten the rest, and who lies beyond.
struct RobustRange {
    ValueRange range;                           ///< valid, with a margin of `margin` at both ends
    std::vector<std::uint32_t> below, above;    ///< positions in the values, finite or infinite, outside the range
    std::vector<std::uint32_t> nan;
    bool complete() const { return below.empty() && above.empty() && nan.empty(); }
};
struct RobustRangeOptions {
    bool log = false;        ///< values <= 0 are below
    double fence = 6;        ///< values farther than this many interquartile ranges from the quartiles are beyond
    /// Also beyond at most: this share of the values, at either end. So a heavy tail is shown whole where the tail is the
    /// data, and one value in a hundred is not.
    double tail = 0.01;
    bool includeZero = false; ///< linear only: the range begins (or ends) at 0, as radiance does
    double margin = 0.04;    ///< of the range's length, added at both ends (not beyond an included 0)
};
/// Never empty, never invalid, whatever the values are; all equal values get a range around them.
RobustRange robustRange(std::span<const double> values, const RobustRangeOptions& options = {});
/// All finite values; logarithmic: all positive ones.
RobustRange fullRange(std::span<const double> values, const RobustRangeOptions& options = {});
/// For images: the values between two quantiles (of at most 65536 evenly picked values), repaired.
ValueRange percentileRange(std::span<const float> values, double lower = 0.005, double upper = 0.995, bool log = false);

/// How many points fall into each cell of a plot, for plots with so many points that points hide points.
struct DensityGrid {
    ValueRange x, y;
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> counts;          ///< row by row, the first row at y.min
    std::uint32_t largest = 0;
    std::uint64_t outside = 0;                  ///< outside the ranges or not finite
    std::uint32_t count(std::uint32_t column, std::uint32_t row) const { return counts[std::size_t(row) * width + column]; }
};
/// Points from which on plots show density.
inline constexpr std::size_t kDensityThreshold = 100000;
/// \param xs, ys  equally many
DensityGrid densityGrid(std::span<const double> xs, std::span<const double> ys, const ValueRange& x, const ValueRange& y,
                        std::uint32_t width, std::uint32_t height);

/// A mark of an axis or colour bar.
struct Tick {
    double value = 0;
    std::string label;      ///< short: "0.25", "1000", "1e-05"; empty for minor ticks
    bool major = true;
};
/// Ticks at round numbers inside the range, ascending: linear at 1, 2 or 5 times a power of ten; logarithmic at powers
/// of ten with minor ticks between, over a short range also at 2 and 5. Labels of one axis share their notation and are
/// all different.
/// \param majorCount  how many labels there is room for (2 to 100): there are never more, and from 5 on at least 2
std::vector<Tick> ticks(const ValueRange& range, int majorCount = 6);
/// Ticks of an axis of whole numbers (sample index, depth): never a fraction.
std::vector<Tick> integerTicks(const ValueRange& range, int majorCount = 6);

}  // namespace emca::analysis
