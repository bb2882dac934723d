#include "emca/analysis/outliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "path_set_for_tests.h"

namespace emca::analysis {
namespace {

using testing_support::makePathSet;
using testing_support::TestPath;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
using Values = std::vector<double>;
using Indices = std::vector<Index>;

TEST(Outliers, EqualBruteForceOnNormalSamples) {
    std::mt19937_64 random(1);
    Values values(5000);
    for (double& v : values) v = std::normal_distribution<double>(1, 0.5)(random);
    for (const double m : {1.0, 2.0, 3.0}) {
        double sum = 0, squares = 0;
        for (const double v : values) sum += v;
        const double mean = sum / 5000;
        for (const double v : values) squares += (v - mean) * (v - mean);
        const double sigma = std::sqrt(squares / 4999);
        Indices expected;
        for (Index i = 0; i < values.size(); ++i)
            if (std::abs(values[i] - mean) > m * sigma) expected.push_back(i);
        const auto report = detectOutliers(values, {.deviations = m});
        ASSERT_TRUE(report.ok());
        EXPECT_EQ(report->outliers, expected);
        // Five standard deviations of the binomial count around the normal distribution's tails.
        const double p = std::erfc(m / std::sqrt(2.0));
        EXPECT_NEAR(static_cast<double>(expected.size()), 5000 * p, 5 * std::sqrt(5000 * p));
    }
}

TEST(Outliers, NonFiniteAlwaysAndNeverInTheMean) {
    const auto report = detectOutliers(Values{1, kNaN, 1.1, kInf, 0.9, -kInf, 1});
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->outliers, (Indices{1, 3, 5}));
    EXPECT_EQ(report->notFinite, 3u);
    EXPECT_EQ(report->considered, 4u);
    EXPECT_DOUBLE_EQ(report->mean, 1);
    EXPECT_TRUE(detectOutliers(Values{})->outliers.empty());
    EXPECT_EQ(detectOutliers(Values{kNaN})->outliers, (Indices{0}));
}

TEST(Outliers, EqualValuesAreNone) {
    EXPECT_TRUE(detectOutliers(Values(10, 0.1))->outliers.empty());
    EXPECT_TRUE(detectOutliers(Values{0.5})->outliers.empty());
}

TEST(Outliers, UpperOnlyLeavesLowValues) {
    Values values(100, 1.0);
    values[3] = 50;
    values[7] = -50;
    EXPECT_EQ(detectOutliers(values)->outliers, (Indices{3, 7}));
    EXPECT_EQ(detectOutliers(values, {.upperOnly = true})->outliers, (Indices{3}));
}

TEST(Outliers, ArePositionsInThePathSetAndPathsWithoutEstimateAreSkipped) {
    std::vector<TestPath> paths;
    for (int i = 0; i < 40; ++i) {
        TestPath path;
        path.sample = 1000 + 3 * i;  // neither from 0 nor without gaps
        if (i % 4 != 0) path.estimate = Color(i == 21 ? 500.f : 0.5f + 0.001f * static_cast<float>(i));
        if (i == 30) path.estimate = Color(0.5f, std::numeric_limits<float>::quiet_NaN(), 0.5f);
        paths.push_back(path);
    }
    const PathSet set = makePathSet(paths);
    const auto report = detectOutliers(set);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->outliers, (Indices{21, 30}));
    EXPECT_EQ(report->withoutValue, 10u);
    EXPECT_EQ(detectOutliers(set, {.quantity = PathQuantity::red})->outliers, (Indices{21}));
    EXPECT_TRUE(detectOutliers(PathSet())->outliers.empty());
}

TEST(Outliers, RefuseNonsense) {
    for (const double m : {0.0, -1.0, kNaN, kInf}) {
        const auto report = detectOutliers(Values{1, 2}, {.deviations = m});
        ASSERT_FALSE(report.ok());
        EXPECT_EQ(report.error().code, ErrorCode::invalidArgument);
    }
}

/// Each pixel as if it had been traced alone.
TEST(OutliersPerPixel, AreThoseOfEachPixelAlone) {
    std::mt19937_64 random(3);
    std::vector<PathSet> alone;
    for (std::uint32_t pixel = 0; pixel < 6; ++pixel) {
        std::vector<TestPath> all;
        for (std::int64_t sample = 0; sample < 40; ++sample) {
            TestPath path;
            path.sample = sample;
            // Pixels of very different brightness: together their fireflies hide.
            const float bright = std::pow(30.f, static_cast<float>(pixel));
            path.estimate = Color(bright * (1 + 0.1f * static_cast<float>(std::normal_distribution<double>()(random))));
            if (sample == 7 + pixel) path.estimate = Color(bright * 5);
            if (pixel == 4 && sample == 3) path.estimate = Color(std::numeric_limits<float>::quiet_NaN());
            if (pixel == 2 && sample == 5) path.estimate.reset();
            all.push_back(path);
        }
        alone.push_back(makePathSet(all, {pixel % 3, pixel / 3}));
    }
    const PathSet paths = PathSet::merged(alone);
    for (const OutlierMethod method : {OutlierMethod::meanDeviation, OutlierMethod::generalizedEsd}) {
        const OutlierOptions options{.method = method};
        const auto found = detectOutliersPerPixel(paths, options);
        ASSERT_TRUE(found.ok());
        ASSERT_EQ(found->size(), 6u);
        for (std::size_t i = 0; i < 6; ++i) {
            const OutlierReport& report = (*found)[i].report;
            const auto expected = detectOutliers(alone[i], options);
            ASSERT_TRUE(expected.ok());
            EXPECT_EQ((*found)[i].pixel, alone[i].pixel(0));
            ASSERT_EQ(report.outliers.size(), expected->outliers.size());
            EXPECT_GE(report.outliers.size(), 1u) << "its firefly";
            for (std::size_t k = 0; k < report.outliers.size(); ++k) EXPECT_EQ(report.outliers[k], 40 * i + expected->outliers[k]);
            for (std::size_t k = 0; k < report.steps.size(); ++k) EXPECT_EQ(report.steps[k].index, 40 * i + expected->steps[k].index);
            EXPECT_EQ(report.mean, expected->mean);
            EXPECT_EQ(report.upper, expected->upper);
            EXPECT_EQ(report.withoutValue, expected->withoutValue);
            EXPECT_EQ(report.notFinite, expected->notFinite);
        }
    }
    EXPECT_TRUE(detectOutliersPerPixel(PathSet())->empty());
    EXPECT_FALSE(detectOutliersPerPixel(PathSet(), {.deviations = -1}).ok());
}

}  // namespace
}  // namespace emca::analysis
