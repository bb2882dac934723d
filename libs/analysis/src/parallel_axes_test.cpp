#include "emca/analysis/parallel_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace emca::analysis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(AxisScale, WhatTheRangeDoesNotHoldIsCountedAtItsPlace) {
    std::vector<double> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = double(i % 50) / 10;
    std::vector<std::uint8_t> known(values.size(), 1);
    values[3] = 1e6;
    values[4] = 2e6;
    values[5] = kInfinity;
    values[6] = -kInfinity;
    values[7] = kNaN;
    known[8] = known[9] = 0;
    values[8] = 1e9;   // whatever stands there was not recorded
    const AxisScale scale = axisScale(values, known);
    EXPECT_LT(scale.range.max, 10) << "one value in a thousand must not flatten the rest";
    EXPECT_EQ(scale.above, 3u);
    EXPECT_EQ(scale.leastAbove, 1e6);
    EXPECT_EQ(scale.below, 1u);
    EXPECT_EQ(scale.greatestBelow, -kInfinity);
    EXPECT_EQ(scale.nan, 1u);
    EXPECT_EQ(scale.missing, 2u);
    EXPECT_EQ(scale.place(4.9, true), AxisPlace::inside);
    EXPECT_EQ(scale.place(1e6, true), AxisPlace::above);
    EXPECT_EQ(scale.place(kNaN, true), AxisPlace::nan);
    EXPECT_EQ(scale.place(kNaN, false), AxisPlace::missing);

    AxisScaleOptions log;
    log.log = true;
    values[10] = 0;
    const AxisScale decades = axisScale(values, known, log);
    EXPECT_TRUE(decades.range.log);
    EXPECT_EQ(decades.place(0, true), AxisPlace::below) << "0 has no logarithm";
    EXPECT_EQ(decades.greatestBelow, 0);
}

TEST(AxisScale, WholeNumbersAndCategoriesHaveEqualRoom) {
    const std::vector<double> depths{1, 2, 2, 3, 8};
    AxisScaleOptions whole;
    whole.integral = true;
    const AxisScale scale = axisScale(depths, {}, whole);
    EXPECT_EQ(scale.range.min, 0.5);
    EXPECT_EQ(scale.range.max - scale.range.min, std::round(scale.range.max - scale.range.min));
    AxisScaleOptions categories;
    categories.categories = 4;
    EXPECT_EQ(axisScale(std::vector<double>{0, 0, 0}, {}, categories).range, (ValueRange{-0.5, 3.5, false}));
    for (const AxisScaleOptions& options : {AxisScaleOptions{}, whole, AxisScaleOptions{true}})
        for (const std::vector<double>& nothing : {std::vector<double>{}, std::vector<double>{kNaN}, std::vector<double>{kInfinity, -kInfinity}})
            EXPECT_TRUE(axisScale(nothing, {}, options).range.isValid());
}

TEST(RoundedWithin, FewestDigitsWithinTheTolerance) {
    EXPECT_EQ(roundedWithin(0.123456, 0.01), 0.12);
    EXPECT_EQ(roundedWithin(0.123456, 0.03), 0.1);
    EXPECT_EQ(roundedWithin(1234.6, 100), 1200);
    EXPECT_EQ(roundedWithin(1234.6, 300), 1000);
    EXPECT_EQ(roundedWithin(-7.89e-9, 1e-10), -7.9e-9);
    EXPECT_EQ(roundedWithin(0.004, 0.01), 0);
    EXPECT_EQ(roundedWithin(9.96, 0.05), 10);
    EXPECT_EQ(roundedWithin(kInfinity, 1), kInfinity);
    EXPECT_EQ(roundedWithin(0.1234, 0), 0.1234);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const double value = uniform(random) * std::pow(10, 8 * uniform(random)), tolerance = std::abs(value) * std::pow(10, -4 * std::abs(uniform(random)));
        EXPECT_LE(std::abs(roundedWithin(value, tolerance) - value), tolerance) << value;
    }
}

/// Each line on its own, in exact arithmetic: rows from where it enters a column to where it leaves it.
std::vector<std::uint32_t> bruteForce(const std::vector<std::uint16_t>& left, const std::vector<std::uint16_t>& right, std::uint32_t width,
                                      std::uint32_t height) {
    std::vector<std::uint32_t> counts(std::size_t(width) * height);
    for (std::size_t i = 0; i < left.size(); ++i) {
        if (left[i] >= height || right[i] >= height) continue;
        for (std::uint32_t k = 0; k < width; ++k) {
            const auto at = [&](std::uint32_t column) {
                return int(std::floor(left[i] + 0.5 + (double(right[i]) - left[i]) * column / width));
            };
            for (int row = std::min(at(k), at(k + 1)); row <= std::max(at(k), at(k + 1)); ++row) ++counts[std::size_t(k) * height + std::size_t(row)];
        }
    }
    return counts;
}

TEST(LineDensity, IsTheSumOfLinesDrawnOneByOne) {
    // A width that is a power of two: steps are exact in binary, so that both round alike.
    constexpr std::uint32_t kWidth = 64, kHeight = 45;
    std::mt19937 random(9);
    for (const std::size_t count : {1u, 30u, 5000u}) {   // fewer and more lines than pairs of ends
        std::vector<std::uint16_t> left(count), right(count);
        for (std::size_t i = 0; i < count; ++i) {
            left[i] = i % 17 == 3 ? kNoRow : std::uint16_t(random() % kHeight);
            right[i] = std::uint16_t(random() % kHeight);
        }
        const LineDensity density = lineDensity(left, right, kWidth, kHeight);
        EXPECT_EQ(density.counts, bruteForce(left, right, kWidth, kHeight)) << count << " lines";
        EXPECT_EQ(density.largest, *std::max_element(density.counts.begin(), density.counts.end()));
    }
}

TEST(LineDensity, LinesAreConnectedAndEndAtTheirRows) {
    for (const std::uint32_t width : {1u, 3u, 70u}) {
        for (const auto& [from, to] : {std::pair{0, 199}, {199, 0}, {100, 101}, {50, 50}}) {
            const LineDensity d = lineDensity(std::vector<std::uint16_t>{std::uint16_t(from)}, std::vector<std::uint16_t>{std::uint16_t(to)}, width, 200);
            EXPECT_EQ(d.count(0, std::uint32_t(from)), 1u);
            EXPECT_EQ(d.largest, 1u);
            for (std::uint32_t k = 0; k + 1 < width; ++k) {
                bool touches = false;
                for (std::uint32_t row = 0; row < 200; ++row) touches |= d.count(k, row) && d.count(k + 1, row);
                EXPECT_TRUE(touches) << "column " << k << " of " << width;
            }
            bool arrives = false;   // within a row: steps are rounded
            for (int row = to - 1; row <= to + 1; ++row)
                if (row >= 0 && row < 200) arrives |= d.count(width - 1, std::uint32_t(row)) > 0;
            EXPECT_TRUE(arrives) << from << " to " << to;
        }
    }
    EXPECT_TRUE(lineDensity({}, {}, 0, 10).counts.empty());
}

}  // namespace
}  // namespace emca::analysis
