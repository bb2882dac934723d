#include "emca/analysis/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace emca::analysis {
namespace {

template <typename T>
Summary summarizeAny(std::span<const T> values) {
    Summary s;
    s.count = values.size();
    double sumOfSquares = 0;
    for (const T v : values) {
        const auto value = static_cast<double>(v);
        if (std::isnan(value)) {
            ++s.nan;
        } else if (std::isinf(value)) {
            ++(value > 0 ? s.positiveInfinite : s.negativeInfinite);
        } else {
            s.min = s.finite == 0 ? value : std::min(s.min, value);
            s.max = s.finite == 0 ? value : std::max(s.max, value);
            ++s.finite;
            const double delta = value - s.mean;
            s.mean += delta / static_cast<double>(s.finite);
            sumOfSquares += delta * (value - s.mean);
        }
    }
    if (s.finite > 1) s.variance = sumOfSquares / static_cast<double>(s.finite - 1);
    return s;
}

template <typename T>
Histogram histogramAny(std::span<const T> values, const ValueRange& range, std::size_t bins) {
    Histogram h;
    h.range = range.repaired();
    h.counts.assign(std::max<std::size_t>(bins, 1), 0);
    const auto count = static_cast<double>(h.counts.size());
    for (const T v : values) {
        const auto value = static_cast<double>(v);
        if (std::isnan(value)) {
            ++h.nan;
        } else if (std::isinf(value)) {
            ++(value > 0 ? h.positiveInfinite : h.negativeInfinite);
        } else if (value < h.range.min) {
            ++h.below;
        } else if (value > h.range.max) {
            ++h.above;
        } else {
            const double bin = h.range.position(value) * count;
            ++h.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, count - 1))];
        }
    }
    return h;
}

}  // namespace

double Summary::deviation() const { return std::sqrt(variance); }
double Summary::standardError() const { return finite < 2 ? 0 : std::sqrt(variance / static_cast<double>(finite)); }

Summary summarize(std::span<const double> values) { return summarizeAny(values); }
Summary summarize(std::span<const float> values) { return summarizeAny(values); }

std::vector<double> sortedFinite(std::span<const double> values) {
    std::vector<double> sorted;
    sorted.reserve(values.size());
    std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

double quantile(std::span<const double> sorted, double p) {
    if (sorted.empty() || std::isnan(p)) return std::numeric_limits<double>::quiet_NaN();
    const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto i = static_cast<std::size_t>(at);
    if (i + 1 >= sorted.size()) return sorted.back();
    return std::lerp(sorted[i], sorted[i + 1], at - static_cast<double>(i));
}

double Histogram::lower(std::size_t bin) const {
    return range.value(static_cast<double>(bin) / static_cast<double>(counts.size()));
}

std::uint64_t Histogram::largest() const {
    return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
}

Histogram histogram(std::span<const double> values, const ValueRange& range, std::size_t bins) {
    return histogramAny(values, range, bins);
}
Histogram histogram(std::span<const float> values, const ValueRange& range, std::size_t bins) {
    return histogramAny(values, range, bins);
}

std::size_t suggestedBins(std::span<const double> values, const ValueRange& range, std::size_t maximum, bool integral) {
    const ValueRange valid = range.repaired();
    maximum = std::max<std::size_t>(maximum, 1);
    if (integral && !valid.log) {
        const double integers = std::floor(valid.max) - std::ceil(valid.min) + 1;
        if (integers <= static_cast<double>(maximum)) return static_cast<std::size_t>(std::max(integers, 1.0));
    }
    // Freedman and Diaconis' width 2 IQR / n^(1/3), in positions so that logarithmic ranges work alike.
    std::vector<double> positions;
    for (const double v : values) {
        const double t = valid.position(v);
        if (t >= 0 && t <= 1) positions.push_back(t);
    }
    if (positions.size() < 2) return 1;
    std::sort(positions.begin(), positions.end());
    const double spread = quantile(positions, 0.75) - quantile(positions, 0.25);
    const double n = static_cast<double>(positions.size());
    // No spread: at least half of the values are one value. Sturges' count still shows the rest.
    const double bins = spread > 0 ? std::cbrt(n) / (2 * spread) : std::log2(n) + 1;
    return static_cast<std::size_t>(std::clamp(std::ceil(bins), 1.0, static_cast<double>(maximum)));
}

DensityGrid densityGrid(std::span<const double> xs, std::span<const double> ys, const ValueRange& x,
                        const ValueRange& y, std::uint32_t width, std::uint32_t height) {
    assert(xs.size() == ys.size());
    DensityGrid grid{x.repaired(), y.repaired(), std::max(width, 1u), std::max(height, 1u), {}, 0, 0};
    grid.counts.assign(std::size_t(grid.width) * grid.height, 0);
    for (std::size_t i = 0; i < std::min(xs.size(), ys.size()); ++i) {
        const double u = grid.x.position(xs[i]), v = grid.y.position(ys[i]);
        if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) {
            ++grid.outside;
            continue;
        }
        const auto column = std::min(static_cast<std::uint32_t>(u * grid.width), grid.width - 1);
        const auto row = std::min(static_cast<std::uint32_t>(v * grid.height), grid.height - 1);
        grid.largest = std::max(grid.largest, ++grid.counts[std::size_t(row) * grid.width + column]);
    }
    return grid;
}

}  // namespace emca::analysis
