#include "generalized_esd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "path_set_for_tests.h"
#include "student_t.h"

namespace emca::analysis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
using Values = std::vector<double>;
using Indices = std::vector<Index>;

OutlierReport esd(const Values& values, std::size_t maximum, double significance = 0.05, bool upperOnly = false) {
    const auto report = detectOutliers(values, {.method = OutlierMethod::generalizedEsd,
                                                .upperOnly = upperOnly,
                                                .maximum = maximum,
                                                .significance = significance});
    EXPECT_TRUE(report.ok());
    return report ? *report : OutlierReport{};
}

/// The 54 measurements of Rosner 1983, as the NIST/SEMATECH e-Handbook of Statistical Methods has them in 1.3.5.17.3.
const Values kRosner = {-0.25, 0.68, 0.94, 1.15, 1.20, 1.26, 1.26, 1.34, 1.38, 1.43, 1.49, 1.49, 1.55, 1.56,
                        1.58,  1.65, 1.69, 1.70, 1.76, 1.77, 1.81, 1.91, 1.94, 1.96, 1.99, 2.06, 2.09, 2.10,
                        2.14,  2.15, 2.23, 2.24, 2.26, 2.35, 2.37, 2.40, 2.47, 2.54, 2.62, 2.64, 2.90, 2.92,
                        2.92,  2.93, 3.21, 3.26, 3.30, 3.59, 3.68, 4.30, 4.64, 5.34, 5.42, 6.01};

TEST(StudentT, QuantilesOfTextbooks) {
    EXPECT_NEAR(studentTUpperQuantile(1, 0.025), 12.706, 5e-4);
    EXPECT_NEAR(studentTUpperQuantile(10, 0.05), 1.812, 5e-4);
    EXPECT_NEAR(studentTUpperQuantile(1e6, 0.025), 1.95997, 1e-5);
    EXPECT_NEAR(studentTUpperQuantile(2, 0.25), std::sqrt(2.0 / 3), 1e-14);  // closed form for two degrees of freedom
}

TEST(GeneralizedEsd, IsTheTableOfTheNistHandbook) {
    struct Row {
        double statistic, critical;
    };
    // The handbook cuts after the third decimal.
    constexpr Row kTable[] = {{3.118, 3.158}, {2.942, 3.151}, {3.179, 3.143}, {2.810, 3.136}, {2.815, 3.128},
                              {2.848, 3.120}, {2.279, 3.111}, {2.310, 3.103}, {2.101, 3.094}, {2.067, 3.085}};
    constexpr double kRemoved[] = {6.01, 5.42, 5.34, 4.64, -0.25, 4.30, 3.68, 3.59, 0.68, 3.30};
    const auto cut = [](double v) { return std::floor(v * 1000) / 1000; };
    const OutlierReport report = esd(kRosner, 10);
    ASSERT_EQ(report.steps.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_DOUBLE_EQ(cut(report.steps[i].statistic), kTable[i].statistic) << i;
        EXPECT_DOUBLE_EQ(cut(report.steps[i].critical), kTable[i].critical) << i;
        EXPECT_EQ(report.steps[i].value, kRemoved[i]);
        EXPECT_EQ(report.steps[i].significant(), i == 2) << "the first two are hidden by the others";
    }
    EXPECT_EQ(report.outliers, (Indices{51, 52, 53}));
    EXPECT_EQ(report.lower, -0.25);
    EXPECT_EQ(report.upper, 4.64);
    EXPECT_FALSE(report.maximumReached());
    EXPECT_TRUE(detectOutliers(kRosner, {.deviations = 3.2})->outliers.empty());
}

/// US EPA, "Statistical Analysis of Groundwater Monitoring Data at RCRA Facilities", 2009, example 12-4: naphthalene,
/// in full as published for R's EnvStats.
TEST(GeneralizedEsd, IsTheExampleOfTheEpa) {
    const Values naphthalene = {3.34, 5.39, 5.74, 6.88, 5.85, 5.59, 5.96, 1.47, 2.57, 5.39, 1.91, 1.74, 23.23,
                                1.82, 2.02, 6.12, 6.05, 5.18, 4.43, 1.00, 8.64, 5.34, 5.53, 4.42, 35.45};
    const OutlierReport report = esd(naphthalene, 2);
    ASSERT_EQ(report.steps.size(), 2u);
    EXPECT_NEAR(report.steps[0].mean, 6.44240, 5e-6);
    EXPECT_NEAR(report.steps[0].deviation, 7.379271, 5e-7);
    EXPECT_NEAR(report.steps[0].statistic, 3.930957, 5e-7);
    EXPECT_NEAR(report.steps[0].critical, 2.821681, 5e-7);
    EXPECT_NEAR(report.steps[1].statistic, 4.160223, 5e-7);
    EXPECT_NEAR(report.steps[1].critical, 2.801551, 5e-7);
    EXPECT_EQ(report.outliers, (Indices{12, 24}));
    EXPECT_TRUE(report.maximumReached());
}

/// Two decimals, as Rosner's table of percentage points has them (n = 25, i = 1 to 5 and 10).
TEST(GeneralizedEsd, CriticalValuesAreRosnersTable) {
    constexpr std::size_t kStep[] = {1, 2, 3, 4, 5, 10};
    constexpr double kFive[] = {2.82, 2.80, 2.78, 2.76, 2.73, 2.59}, kOne[] = {3.14, 3.11, 3.09, 3.06, 3.03, 2.85};
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(esdCritical(25, kStep[k], 0.05, false), kFive[k], 0.00501) << kStep[k];
        EXPECT_NEAR(esdCritical(25, kStep[k], 0.01, false), kOne[k], 0.00501) << kStep[k];
    }
    // One-sided at half the significance is two-sided.
    EXPECT_EQ(esdCritical(25, 3, 0.025, true), esdCritical(25, 3, 0.05, false));
}

struct Plain {
    std::vector<Index> order;
    Values statistics;
};

/// Everything again at each step, as the paper writes it.
Plain plainSteps(const Values& values, std::size_t r) {
    std::vector<Index> left;
    for (Index i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i])) left.push_back(i);
    Plain plain;
    for (std::size_t step = 0; step < r; ++step) {
        long double sum = 0, squares = 0;
        for (const Index i : left) sum += values[i];
        const long double mean = sum / static_cast<long double>(left.size());
        for (const Index i : left) squares += (values[i] - mean) * (values[i] - mean);
        const auto farthest = std::max_element(left.begin(), left.end(), [&](Index a, Index b) {
            return std::abs(values[a] - mean) < std::abs(values[b] - mean);
        });
        plain.order.push_back(*farthest);
        plain.statistics.push_back(static_cast<double>(std::abs(values[*farthest] - mean) /
                                                       std::sqrt(squares / static_cast<long double>(left.size() - 1))));
        left.erase(farthest);
    }
    return plain;
}

TEST(GeneralizedEsd, EqualsComputingEverythingAgain) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal(5, 2);
    for (int trial = 0; trial < 60; ++trial) {
        const std::size_t n = 3 + random() % 300;
        Values values(n);
        for (double& v : values) v = normal(random);
        // Fireflies up to a million times the rest, at either end, and a few values that are no numbers.
        for (std::size_t k = 0; k < n / 20; ++k)
            values[random() % n] =
                std::exp2(static_cast<double>(random() % 40) - 10) * (random() % 3 == 0 ? -1 : 1) * normal(random);
        if (trial % 3 == 0) values[random() % n] = kNaN;
        const std::size_t finite = static_cast<std::size_t>(
            std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
        const std::size_t r = 1 + random() % 40;
        const OutlierReport report = esd(values, r, 0.05);
        const std::size_t steps = std::min(r, (finite - 1) / 2);
        ASSERT_EQ(report.steps.size(), steps);
        const Plain plain = plainSteps(values, steps);
        std::size_t found = 0;
        for (std::size_t i = 0; i < steps; ++i) {
            EXPECT_EQ(report.steps[i].index, plain.order[i]) << trial << " " << i;
            EXPECT_NEAR(report.steps[i].statistic, plain.statistics[i], 1e-10 * plain.statistics[i]);
            if (plain.statistics[i] > esdCritical(finite, i + 1, 0.05, false)) found = i + 1;
        }
        Indices expected(plain.order.begin(), plain.order.begin() + static_cast<std::ptrdiff_t>(found));
        for (Index i = 0; i < n; ++i)
            if (!std::isfinite(values[i])) expected.push_back(i);
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(report.outliers, expected);
    }
}

/// The test's promise: alpha is how often normal samples have an outlier (Rosner: very close from 25 values on).
TEST(GeneralizedEsd, FindsNothingInNormalSamplesButWithProbabilityAlpha) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    constexpr int kTrials = 4000;
    int both = 0, upper = 0;
    Values values(60);
    for (int i = 0; i < kTrials; ++i) {
        for (double& v : values) v = normal(random);
        both += !esd(values, 5).outliers.empty();
        upper += !esd(values, 5, 0.05, true).outliers.empty();
    }
    // Five standard deviations of a binomial count.
    const double tolerance = 5 * std::sqrt(kTrials * 0.05 * 0.95);
    EXPECT_NEAR(both, kTrials * 0.05, tolerance);
    EXPECT_NEAR(upper, kTrials * 0.05, tolerance);
}

TEST(GeneralizedEsd, FindsOutliersThatHideEachOther) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(1, 0.1);
    Values values(65536);
    for (double& v : values) v = normal(random);
    Indices planted;
    for (Index i = 0; i < 300; ++i) {
        values[i * 200 + 7] = 1e6 + i;
        planted.push_back(i * 200 + 7);
    }
    EXPECT_EQ(esd(values, 400).outliers, planted);
    EXPECT_TRUE(esd(values, 100).maximumReached());
}

TEST(GeneralizedEsd, UpperOnlyLeavesLowValues) {
    Values values = kRosner;
    for (double& v : values) v = -v;
    EXPECT_EQ(esd(values, 10).outliers.size(), 3u);
    EXPECT_TRUE(esd(values, 10, 0.05, true).outliers.empty());
    EXPECT_EQ(esd(kRosner, 10, 0.05, true).outliers, (Indices{51, 52, 53}));
}

TEST(GeneralizedEsd, NonFiniteAlwaysAndTooFewValuesNever) {
    Values values = kRosner;
    values.insert(values.begin(), {kNaN, kInf, -kInf});
    const OutlierReport report = esd(values, 10);
    EXPECT_EQ(report.outliers, (Indices{0, 1, 2, 54, 55, 56}));
    EXPECT_EQ(report.notFinite, 3u);
    EXPECT_EQ(report.considered, 54u);
    EXPECT_EQ(report.steps[0].index, 56u);
    EXPECT_FALSE(report.maximumReached());
    EXPECT_TRUE(esd({}, 10).outliers.empty());
    EXPECT_EQ(esd({kNaN}, 10).outliers, (Indices{0}));
    EXPECT_TRUE(esd({1, 100}, 10).steps.empty());
    EXPECT_EQ(esd({1, 2, 100}, 10).steps.size(), 1u);
    EXPECT_TRUE(esd({1, 2, 4}, 10).outliers.empty());
}

TEST(GeneralizedEsd, EqualValuesAreNone) {
    EXPECT_TRUE(esd(Values(10, 0.1), 4).steps.empty());
    Values values(100, 0.1);
    values[40] = 50;
    const OutlierReport report = esd(values, 30);
    EXPECT_EQ(report.outliers, (Indices{40}));
    EXPECT_EQ(report.steps.size(), 1u) << "the rest is all equal";
    EXPECT_EQ(report.lower, 0.1);
    EXPECT_EQ(report.upper, 0.1);
}

TEST(GeneralizedEsd, NamesPositionsInThePathSet) {
    using testing_support::TestPath;
    std::vector<TestPath> paths;
    for (int i = 0; i < 40; ++i) {
        TestPath path;
        path.sample = i;
        if (i % 4 != 0) path.estimate = Color(i == 21 ? 500.f : 0.5f + 0.001f * static_cast<float>(i));
        paths.push_back(path);
    }
    const auto report = detectOutliers(testing_support::makePathSet(paths), {.method = OutlierMethod::generalizedEsd});
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->outliers, (Indices{21}));
    EXPECT_EQ(report->steps[0].index, 21u);
    EXPECT_EQ(report->withoutValue, 10u);
}

TEST(GeneralizedEsd, RefusesNonsense) {
    for (const double alpha : {0.0, -1.0, 1.0, kNaN}) {
        const auto report =
            detectOutliers(Values{1, 2}, {.method = OutlierMethod::generalizedEsd, .significance = alpha});
        ASSERT_FALSE(report.ok());
        EXPECT_EQ(report.error().code, ErrorCode::invalidArgument);
    }
    EXPECT_FALSE(detectOutliers(Values{1, 2}, {.method = OutlierMethod::generalizedEsd, .maximum = 0}).ok());
}

}  // namespace
}  // namespace emca::analysis
