#include "emca/analysis/parallel_axes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

ValueRange rangeOf(std::span<const double> values, const AxisScaleOptions& options) {
    if (options.categories > 0) return {-0.5, double(options.categories) - 0.5, false};
    RobustRangeOptions robust;
    robust.log = options.log;
    robust.includeZero = options.includeZero && !options.log;
    const ValueRange range = robustRange(values, robust).range;
    if (!options.integral || options.log || !(range.max - range.min < 1e15)) return range;
    return {std::floor(range.min + 0.5) - 0.5, std::floor(range.max + 0.5) + 0.5, false};
}

}  // namespace

AxisScale axisScale(std::span<const double> values, std::span<const std::uint8_t> known, const AxisScaleOptions& options) {
    AxisScale scale;
    std::vector<double> there;
    if (known.size() == values.size()) {
        there.reserve(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            if (known[i]) there.push_back(values[i]);
        scale.missing = static_cast<std::uint32_t>(values.size() - there.size());
        values = there;
    }
    scale.range = rangeOf(values, options);
    for (const double value : values) {
        switch (scale.place(value, true)) {
            case AxisPlace::above:
                scale.leastAbove = scale.above++ == 0 ? value : std::min(scale.leastAbove, value);
                break;
            case AxisPlace::below:
                scale.greatestBelow = scale.below++ == 0 ? value : std::max(scale.greatestBelow, value);
                break;
            case AxisPlace::nan: ++scale.nan; break;
            case AxisPlace::inside: case AxisPlace::missing: break;
        }
    }
    return scale;
}

double roundedWithin(double value, double tolerance) {
    if (!std::isfinite(value) || !(tolerance > 0)) return value;
    if (std::abs(value) <= tolerance) return 0;
    for (int digits = 0; digits < 17; ++digits) {
        std::array<char, 40> text{};
        const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits).ptr;
        double rounded = value;
        std::from_chars(text.data(), end, rounded);
        if (std::abs(rounded - value) <= tolerance) return rounded;
    }
    return value;
}

namespace {

/// Counts as differences along each column: a run of rows costs two additions however long it is.
class Runs {
  public:
    Runs(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), stride_((height + 2) | 1u), differences_(std::size_t(width) * stride_) {}

    void add(std::uint32_t left, std::uint32_t right, std::uint32_t times) {
        // 16 bits for the fraction of a row; heights are below 65536.
        const std::int64_t from = (std::int64_t(left) << 16) + 0x8000, to = (std::int64_t(right) << 16) + 0x8000;
        const std::int64_t step = (to - from) / std::int64_t(width_);
        std::int64_t y = from;
        std::uint32_t* column = differences_.data();
        for (std::uint32_t k = 0; k < width_; ++k, column += stride_) {
            const std::int64_t next = y + step;
            const auto enters = static_cast<std::uint32_t>(y >> 16), leaves = static_cast<std::uint32_t>(next >> 16);
            const bool down = leaves >= enters;
            column[down ? enters : leaves] += times;
            column[(down ? leaves : enters) + 1] -= times;
            y = next;
        }
    }

    LineDensity sum() const {
        LineDensity density{width_, height_, {}, 0};
        density.counts.resize(std::size_t(width_) * height_);
        for (std::uint32_t k = 0; k < width_; ++k) {
            std::uint32_t running = 0;
            for (std::uint32_t row = 0; row < height_; ++row) {
                running += differences_[std::size_t(k) * stride_ + row];
                density.counts[std::size_t(k) * height_ + row] = running;
                density.largest = std::max(density.largest, running);
            }
        }
        return density;
    }

  private:
    std::uint32_t width_, height_;
    std::size_t stride_;   ///< odd, so that neighbouring columns do not share lines of the cache
    std::vector<std::uint32_t> differences_;
};

}  // namespace

LineDensity lineDensity(std::span<const std::uint16_t> left, std::span<const std::uint16_t> right, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return {};
    height = std::min<std::uint32_t>(height, kNoRow);
    const std::size_t lines = std::min(left.size(), right.size());
    Runs runs(width, height);
    if (lines < std::size_t(height) * height / 8) {
        for (std::size_t i = 0; i < lines; ++i)
            if (left[i] < height && right[i] < height) runs.add(left[i], right[i], 1);
        return runs.sum();
    }
    // Lines with the same ends are one line, so often.
    std::vector<std::uint32_t> pairs(std::size_t(height) * height);
    for (std::size_t i = 0; i < lines; ++i)
        if (left[i] < height && right[i] < height) ++pairs[std::size_t(left[i]) * height + right[i]];
    for (std::uint32_t from = 0; from < height; ++from)
        for (std::uint32_t to = 0; to < height; ++to)
            if (const std::uint32_t times = pairs[std::size_t(from) * height + to]) runs.add(from, to, times);
    return runs.sum();
}

}  // namespace emca::analysis
