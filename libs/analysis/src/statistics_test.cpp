#include "emca/analysis/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace emca::analysis {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Values = std::vector<double>;

TEST(Summarize, KnownSet) {
    const Summary s = summarize(Values{2, 4, 4, 4, 5, 5, 7, 9});
    EXPECT_DOUBLE_EQ(s.mean, 5);
    EXPECT_DOUBLE_EQ(s.variance, 32.0 / 7);
    EXPECT_EQ(s.min, 2);
    EXPECT_EQ(s.max, 9);
    EXPECT_DOUBLE_EQ(s.standardError(), std::sqrt(32.0 / 7 / 8));
}

TEST(Summarize, CountsWhatIsNoNumberApart) {
    const Summary s = summarize(Values{kNaN, 1, kInf, -kInf, 3, kInf});
    EXPECT_EQ(s.count, 6u);
    EXPECT_EQ(s.finite, 2u);
    EXPECT_EQ(s.nan, 1u);
    EXPECT_EQ(s.positiveInfinite, 2u);
    EXPECT_EQ(s.negativeInfinite, 1u);
    EXPECT_EQ(s.mean, 2);
    EXPECT_EQ(s.variance, 2);
    EXPECT_EQ(summarize(Values{}).variance, 0);
    EXPECT_EQ(summarize(Values{7}).variance, 0);
}

TEST(Summarize, LargeMeanDoesNotEatTheVariance) {
    const Summary s = summarize(Values{1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16});
    EXPECT_DOUBLE_EQ(s.variance, 30);
}

TEST(Summarize, NormalSamples) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal(3, 2);
    Values values(100000);
    for (double& v : values) v = normal(random);
    const Summary s = summarize(values);
    // Within five standard errors of mean and variance.
    EXPECT_NEAR(s.mean, 3, 5 * 2 / std::sqrt(1e5));
    EXPECT_NEAR(s.variance, 4, 5 * 4 * std::sqrt(2 / 1e5));
    std::sort(values.begin(), values.end());
    EXPECT_NEAR(quantile(values, 0.8413447), 5, 0.05);
}

TEST(Quantile, InterpolatesOrderStatistics) {
    const Values v{1, 2, 3, 4};
    EXPECT_DOUBLE_EQ(quantile(v, 0), 1);
    EXPECT_DOUBLE_EQ(quantile(v, 1), 4);
    EXPECT_DOUBLE_EQ(quantile(v, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile(v, 0.25), 1.75);  // type 7
    EXPECT_DOUBLE_EQ(quantile(Values{7}, 0.3), 7);
    EXPECT_TRUE(std::isnan(quantile(Values{}, 0.5)));
    EXPECT_EQ(sortedFinite(Values{3, kNaN, 1, kInf, 2}), (Values{1, 2, 3}));
}

TEST(Histogram, CountsEveryValueOnce) {
    std::mt19937_64 random(2);
    Values values;
    for (int i = 0; i < 5000; ++i) values.push_back(std::exp(std::normal_distribution<double>(0, 3)(random)) - 0.01);
    values.insert(values.end(), {kNaN, kInf, -kInf, 0, 1, 100});
    for (const ValueRange range : {ValueRange{0, 100, false}, ValueRange{0.01, 100, true}}) {
        const Histogram h = histogram(values, range, 37);
        const std::uint64_t inside = std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t(0));
        EXPECT_EQ(inside + h.below + h.above + h.nan + h.positiveInfinite + h.negativeInfinite, values.size());
        EXPECT_EQ(h.nan, 1u);
        for (std::size_t b = 0; b < h.binCount(); ++b) {
            // Brute force, a hair apart from the edges.
            const auto in = [&](double v) { return v > h.lower(b) * (1 + 1e-12) && v < h.upper(b) * (1 - 1e-12); };
            EXPECT_LE(static_cast<std::uint64_t>(std::count_if(values.begin(), values.end(), in)), h.counts[b]);
        }
        EXPECT_DOUBLE_EQ(h.lower(0), range.min);
        EXPECT_DOUBLE_EQ(h.upper(36), range.max);
    }
    const Histogram ends = histogram(Values{0, 1, 2}, ValueRange{0, 2}, 2);
    EXPECT_EQ(ends.counts, (std::vector<std::uint64_t>{1, 2}));
    EXPECT_EQ(ends.largest(), 2u);
    EXPECT_EQ(histogram(Values{1}, ValueRange{0, 2}, 0).binCount(), 1u);
}

TEST(SuggestedBins, OneBinPerIntegerAndFreedmanDiaconis) {
    EXPECT_EQ(suggestedBins(Values{1, 2, 3}, ValueRange{-0.5, 9.5}, 100, true), 10u);
    EXPECT_EQ(suggestedBins(Values{}, ValueRange{}), 1u);
    Values uniform(1000);
    for (std::size_t i = 0; i < uniform.size(); ++i) uniform[i] = static_cast<double>(i) / 999;
    EXPECT_EQ(suggestedBins(uniform, ValueRange{0, 1}), 10u);  // n^(1/3) / (2 * 0.5)
    EXPECT_EQ(suggestedBins(uniform, ValueRange{0, 1}, 7), 7u);
    EXPECT_GT(suggestedBins(Values(100, 0.5), ValueRange{0, 1}), 1u);
}

TEST(RobustRange, OneOutlierDoesNotFlattenTheRest) {
    std::mt19937_64 random(3);
    Values values(64);
    for (double& v : values) v = std::uniform_real_distribution<double>(0, 1)(random);
    values[17] = 5000;
    const RobustRange r = robustRange(values);
    EXPECT_EQ(r.above, (std::vector<std::uint32_t>{17}));
    EXPECT_TRUE(r.below.empty());
    EXPECT_GT(r.range.max, 0.8);
    EXPECT_LT(r.range.max, 1.2);
    EXPECT_EQ(fullRange(values).above.size(), 0u);
    EXPECT_GT(fullRange(values).range.max, 5000);
}

TEST(RobustRange, OutlierAmongBlackPaths) {
    Values values(256, 0.0);  // most paths of the pixel bring nothing
    for (std::size_t i = 0; i < 40; ++i) values[i * 5] = 0.1 + 0.01 * static_cast<double>(i);
    values[3] = 1e6;
    const RobustRange r = robustRange(values, {.includeZero = true});
    EXPECT_EQ(r.above, (std::vector<std::uint32_t>{3}));
    EXPECT_EQ(r.range.min, 0);
    EXPECT_LT(r.range.max, 2);
}

TEST(RobustRange, WellBehavedValuesAreAllInside) {
    std::mt19937_64 random(4);
    Values normal(1000), uniform(1000);
    for (double& v : normal) v = std::normal_distribution<double>(10, 1)(random);
    for (double& v : uniform) v = std::uniform_real_distribution<double>(-1, 1)(random);
    EXPECT_TRUE(robustRange(normal).complete());
    EXPECT_TRUE(robustRange(uniform).complete());
    EXPECT_TRUE(robustRange(Values{1, 2, 1000}).complete());  // of three, none is the outlier
}

TEST(RobustRange, AtMostTheTailIsLeftOut) {
    std::mt19937_64 random(5);
    Values heavy(10000);
    for (double& v : heavy) v = std::exp(std::normal_distribution<double>(0, 4)(random));
    const RobustRange r = robustRange(heavy);
    EXPECT_LE(r.above.size(), 100u);
    EXPECT_LE(r.below.size(), 100u);
    EXPECT_TRUE(robustRange(heavy, {.log = true}).complete());  // a straight normal distribution on this axis
}

TEST(RobustRange, ListsAreExactlyTheValuesOutside) {
    std::mt19937_64 random(6);
    for (int round = 0; round < 200; ++round) {
        Values values(random() % 40);
        for (double& v : values) {
            const auto kind = random() % 12;
            v = kind == 0   ? kNaN
                : kind == 1 ? kInf
                : kind == 2 ? -kInf
                : kind == 3 ? 0
                            : std::cauchy_distribution<double>(0, 1)(random);
        }
        for (const bool log : {false, true})
            for (const RobustRange& r : {robustRange(values, {.log = log}), fullRange(values, {.log = log})}) {
                ASSERT_TRUE(r.range.isValid());
                EXPECT_EQ(r.range.log, log);
                std::vector<std::uint32_t> below, above, nan;
                for (std::uint32_t i = 0; i < values.size(); ++i) {
                    if (values[i] < r.range.min) below.push_back(i);
                    if (values[i] > r.range.max) above.push_back(i);
                    if (std::isnan(values[i])) nan.push_back(i);
                }
                EXPECT_EQ(r.below, below);
                EXPECT_EQ(r.above, above);
                EXPECT_EQ(r.nan, nan);
            }
    }
}

TEST(RobustRange, EqualValuesAndNone) {
    EXPECT_TRUE(robustRange(Values{}).range.isValid());
    EXPECT_TRUE(robustRange(Values{kNaN, kInf}).range.isValid());
    const RobustRange r = robustRange(Values(5, 3.0));
    EXPECT_LT(r.range.min, 3);
    EXPECT_GT(r.range.max, 3);
    EXPECT_EQ(robustRange(Values(5, 0.0), {.includeZero = true}).range.isValid(), true);
}

TEST(PercentileRange, IgnoresNaNAndTails) {
    std::vector<float> values(1001);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    values.push_back(std::numeric_limits<float>::quiet_NaN());
    values.push_back(std::numeric_limits<float>::infinity());
    const ValueRange r = percentileRange(values, 0.1, 0.9);
    EXPECT_DOUBLE_EQ(r.min, 100);
    EXPECT_DOUBLE_EQ(r.max, 900);
    EXPECT_TRUE(percentileRange(std::vector<float>{}, 0, 1, true).isValid());
    EXPECT_TRUE(percentileRange(std::vector<float>(9, 0.f), 0, 1).isValid());
}

TEST(DensityGrid, CountsEqualBruteForce) {
    std::mt19937_64 random(7);
    Values xs, ys;
    for (int i = 0; i < 3000; ++i) {
        xs.push_back(std::normal_distribution<double>(0, 1)(random));
        ys.push_back(std::exp(std::normal_distribution<double>(0, 2)(random)));
    }
    xs.push_back(kNaN);
    ys.push_back(1);
    const DensityGrid grid = densityGrid(xs, ys, {-2, 2}, {0.01, 100, true}, 8, 5);
    std::uint64_t inside = 0;
    for (std::uint32_t row = 0; row < 5; ++row)
        for (std::uint32_t column = 0; column < 8; ++column) {
            std::uint32_t expected = 0;
            for (std::size_t i = 0; i < xs.size(); ++i) {
                const double left = -2 + 0.5 * column, low = 0.01 * std::pow(1e4, row / 5.0);
                expected += xs[i] >= left && xs[i] < left + 0.5 && ys[i] >= low && ys[i] < low * std::pow(1e4, 0.2);
            }
            EXPECT_EQ(grid.count(column, row), expected);
            EXPECT_LE(grid.count(column, row), grid.largest);
            inside += grid.count(column, row);
        }
    EXPECT_EQ(inside + grid.outside, xs.size());
}

}  // namespace
}  // namespace emca::analysis
