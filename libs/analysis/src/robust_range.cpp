#include <algorithm>
#include <cmath>

#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

/// Values on the scale of the axis, so that fences work alike on linear and logarithmic axes.
double onAxis(double value, bool log) { return log ? std::log10(value) : value; }
double offAxis(double value, bool log) { return log ? std::pow(10.0, value) : value; }

std::vector<double> usable(std::span<const double> values, bool log) {
    std::vector<double> sorted;
    sorted.reserve(values.size());
    for (const double v : values)
        if (std::isfinite(v) && (!log || v > 0)) sorted.push_back(onAxis(v, log));
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

/// Range over the sorted positions [first, last], with margins, in values.
ValueRange spanned(double first, double last, const RobustRangeOptions& options) {
    double low = first, high = last;
    const bool zeroLow = options.includeZero && !options.log && first >= 0;
    const bool zeroHigh = options.includeZero && !options.log && last <= 0;
    if (zeroLow) low = 0;
    if (zeroHigh) high = 0;
    if (low == high) {
        // All values equal: a range that shows them in the middle, at their own scale.
        const double half = options.log ? 0.5 : low == 0 ? 0.5 : std::abs(low) * 0.1;
        low -= half;
        high += half;
    }
    const double margin = options.margin * (high - low);
    if (!zeroLow || low < 0) low -= margin;
    if (!zeroHigh || high > 0) high += margin;
    return ValueRange{offAxis(low, options.log), offAxis(high, options.log), options.log}.repaired();
}

RobustRange classified(std::span<const double> values, const ValueRange& range) {
    RobustRange result;
    result.range = range;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        if (std::isnan(values[i]))
            result.nan.push_back(index);
        else if (values[i] < range.min)
            result.below.push_back(index);
        else if (values[i] > range.max)
            result.above.push_back(index);
    }
    return result;
}

}  // namespace

RobustRange robustRange(std::span<const double> values, const RobustRangeOptions& options) {
    const std::vector<double> sorted = usable(values, options.log);
    if (sorted.empty()) return classified(values, ValueRange{options.log ? 1e-3 : 0.0, 1, options.log});
    const std::size_t n = sorted.size();
    const double lowerQuartile = quantile(sorted, 0.25), upperQuartile = quantile(sorted, 0.75);
    double spread = upperQuartile - lowerQuartile;
    if (spread == 0) {
        // Most values are one value (the black paths of a pixel): the spread of those that differ says what is far.
        std::vector<double> other;
        std::copy_if(sorted.begin(), sorted.end(), std::back_inserter(other),
                     [&](double v) { return v != lowerQuartile; });
        for (double& v : other) v = std::abs(v - lowerQuartile);
        std::sort(other.begin(), other.end());
        spread = quantile(other, 0.5) / 2;
    }
    std::size_t first = 0, last = n - 1;
    if (spread > 0) {
        const double low = lowerQuartile - options.fence * spread, high = upperQuartile + options.fence * spread;
        first = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), low) - sorted.begin());
        last = static_cast<std::size_t>(std::upper_bound(sorted.begin(), sorted.end(), high) - sorted.begin()) - 1;
    }
    // At least one value may be beyond, else a single outlier among few would flatten them; of two or three none can be
    // called the outlier.
    const auto share = static_cast<std::size_t>(options.tail * static_cast<double>(n));
    const std::size_t most = n < 4 ? 0 : std::max<std::size_t>(share, 1);
    first = std::min(first, most);
    last = std::max(last, n - 1 - most);
    return classified(values, spanned(sorted[first], sorted[last], options));
}

RobustRange fullRange(std::span<const double> values, const RobustRangeOptions& options) {
    const std::vector<double> sorted = usable(values, options.log);
    if (sorted.empty()) return classified(values, ValueRange{options.log ? 1e-3 : 0.0, 1, options.log});
    return classified(values, spanned(sorted.front(), sorted.back(), options));
}

ValueRange percentileRange(std::span<const float> values, double lower, double upper, bool log) {
    constexpr std::size_t kPicked = 65536;
    const std::size_t step = std::max<std::size_t>(values.size() / kPicked, 1);
    std::vector<double> sorted;
    for (std::size_t i = 0; i < values.size(); i += step)
        if (std::isfinite(values[i]) && (!log || values[i] > 0)) sorted.push_back(static_cast<double>(values[i]));
    if (sorted.empty()) return log ? ValueRange{1e-3, 1, true} : ValueRange{};
    std::sort(sorted.begin(), sorted.end());
    return ValueRange{quantile(sorted, lower), quantile(sorted, upper), log}.repaired();
}

}  // namespace emca::analysis
