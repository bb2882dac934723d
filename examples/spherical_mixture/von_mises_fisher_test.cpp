#include "von_mises_fisher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mixture {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d unit(double x, double y, double z) { return normalize(Vec3d{x, y, z}); }

std::vector<WeightedDirection> draw(const std::vector<Lobe>& lobes, int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<WeightedDirection> directions;
    for (int i = 0; i < count; ++i) {
        double left = uniform(random);
        std::size_t k = 0;
        while (k + 1 < lobes.size() && left >= lobes[k].weight) left -= lobes[k++].weight;
        const double u = uniform(random), v = uniform(random);
        directions.push_back({sample(lobes[k], {u, v}), 1});
    }
    return directions;
}

/// Angle in radians.
double between(Vec3d a, Vec3d b) { return 2 * std::asin(std::min(1.0, length(a - b) / 2)); }

TEST(VonMisesFisher, IsNormalised) {
    // Over the cosine, by Simpson's rule where the density is; it is the same for every longitude.
    for (const double kappa : {0.0, 1e-9, 1e-4, 0.1, 1.0, 30.0, 1e3, 1e6}) {
        const double lack = std::min(2.0, kappa > 0 ? 60 / kappa : 2.0);   // exp(-60) is nothing
        constexpr int kSteps = 20000;
        double sum = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double factor = i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2;
            sum += factor * std::exp(logDensity(kappa, 1 - lack * i / kSteps));
        }
        EXPECT_NEAR(2 * kPi * sum * lack / kSteps / 3, 1, 1e-6) << kappa;
    }
}

TEST(VonMisesFisher, LimitsOfKappaAreStable) {
    EXPECT_DOUBLE_EQ(std::exp(logDensity(0, -1)), 1 / (4 * kPi));
    EXPECT_NEAR(std::exp(logDensity(1e-10, 1)), 1 / (4 * kPi), 1e-9);
    // Narrow: a Gaussian of variance 1 / kappa around the mean.
    for (const double kappa : {1e4, 1e8, 1e12}) {
        EXPECT_NEAR(std::exp(logDensity(kappa, 1)) / (kappa / (2 * kPi)), 1, 1e-12);
        EXPECT_TRUE(std::isfinite(logDensity(kappa, -1)));
        EXPECT_NEAR(1 - meanCosine(kappa), 1 / kappa, 1e-15);
        EXPECT_NEAR(coneOf(kappa, 1 - std::exp(-0.5)) * std::sqrt(kappa), 1, 1e-4);
    }
    EXPECT_EQ(meanCosine(0), 0);
    EXPECT_NEAR(meanCosine(1e-3) / (1e-3 / 3), 1, 1e-6);
    EXPECT_NEAR(coneOf(0, 0.5), kPi / 2, 1e-12);
}

TEST(VonMisesFisher, KappaOfInvertsMeanCosine) {
    for (double kappa = 1e-6; kappa < 1e6; kappa *= 1.7) EXPECT_NEAR(kappaOf(meanCosine(kappa), 1e9) / kappa, 1, kappa > 1e3 ? 1e-6 : 1e-8) << kappa;
    EXPECT_EQ(kappaOf(0, 100), 0);
    EXPECT_EQ(kappaOf(-1, 100), 0);
    EXPECT_EQ(kappaOf(std::nan(""), 100), 0);
    for (const double r : {0.99, 0.999999, 1.0, 1.5}) EXPECT_EQ(kappaOf(r, 100), 100);
}

TEST(VonMisesFisher, SamplesHaveTheirDistribution) {
    // The inverse of the distribution of the cosine makes equal bins: chi-square with 31 degrees of freedom, 99.9 % quantile 61.1.
    for (const double kappa : {0.0, 0.5, 20.0, 1e5}) {
        const Lobe lobe{unit(1, -2, 0.5), kappa, 1};
        constexpr int kBins = 32, kCount = 32000;
        int cosines[kBins] = {}, angles[kBins] = {};
        const Vec3d s = normalize(cross(lobe.mean, {0, 0, 1})), t = cross(lobe.mean, s);
        for (const WeightedDirection& item : draw({lobe}, kCount, 5)) {
            EXPECT_NEAR(length(item.direction), 1, 1e-12);
            const double angle = between(item.direction, lobe.mean);
            int bin = 0;
            while (bin + 1 < kBins && angle > coneOf(kappa, double(bin + 1) / kBins)) ++bin;
            ++cosines[bin];
            const double phi = std::atan2(dot(item.direction, t), dot(item.direction, s)) / (2 * kPi) + 0.5;
            ++angles[std::min(kBins - 1, static_cast<int>(phi * kBins))];
        }
        for (const int* counts : {cosines, angles}) {
            double chi = 0;
            for (int i = 0; i < kBins; ++i) chi += std::pow(counts[i] - kCount / kBins, 2) / (kCount / kBins);
            EXPECT_LT(chi, 61.1) << kappa;
        }
    }
}

TEST(Fit, OneLobeIsTheMaximumOfTheLikelihood) {
    for (const double kappa : {0.5, 8.0, 2000.0}) {
        const Lobe truth{unit(-1, 1, 3), kappa, 1};
        constexpr int kCount = 20000;
        FitOptions options;
        options.components = 1;
        options.largestKappa = 1e7;
        const Fit found = fit(draw({truth}, kCount, 11), options);
        ASSERT_EQ(found.lobes.size(), 1u);
        EXPECT_TRUE(found.converged);
        // Asymptotic errors (Mardia and Jupp, "Directional Statistics", section 10.3): var(kappa) = 1 / (n A'(kappa)), and the mean
        // direction deviates by 1 / sqrt(n kappa A) in each of two directions. Four of them.
        const double a = meanCosine(kappa), slope = kappa > 20 ? 1 / (kappa * kappa) : 1 - a * a - 2 * a / kappa;
        EXPECT_NEAR(found.lobes[0].kappa, kappa, 4 / std::sqrt(kCount * slope)) << kappa;
        EXPECT_LT(between(found.lobes[0].mean, truth.mean), 4 * std::sqrt(2 / (kCount * kappa * a))) << kappa;
        EXPECT_DOUBLE_EQ(found.lobes[0].weight, 1);
    }
}

TEST(Fit, FindsAKnownMixture) {
    const std::vector<Lobe> truth{{unit(0, 0, 1), 40, 0.5}, {unit(1, 0.2, 0), 200, 0.3}, {unit(-1, -1, -0.2), 5, 0.2}};
    constexpr int kCount = 30000;
    FitOptions options;
    options.components = 3;
    const Fit found = fit(draw(truth, kCount, 3), options);
    ASSERT_EQ(found.lobes.size(), 3u);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double n = kCount * truth[k].weight;
        // The lobes hardly overlap: errors are those of a count, of kappa (kappa / sqrt(n)) and of a mean direction.
        EXPECT_NEAR(found.lobes[k].weight, truth[k].weight, 4 * std::sqrt(truth[k].weight * (1 - truth[k].weight) / kCount) + 0.004) << k;
        EXPECT_NEAR(found.lobes[k].kappa / truth[k].kappa, 1, 5 / std::sqrt(n)) << k;
        EXPECT_LT(between(found.lobes[k].mean, truth[k].mean), 5 / std::sqrt(n * truth[k].kappa)) << k;
        sum += found.lobes[k].weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    // Nothing that was drawn is explained better by the truth than by the most likely mixture.
    double likelihood = 0;
    for (const WeightedDirection& item : draw(truth, kCount, 3)) likelihood += std::log(density(truth, item.direction)) / kCount;
    EXPECT_GE(found.logLikelihood, likelihood);
    EXPECT_NEAR(found.logLikelihood, likelihood, 20.0 / kCount);
}

TEST(Fit, WeightsCountAsRepetitions) {
    const auto drawn = draw({{unit(0, 1, 0), 12, 0.7}, {unit(1, 0, 0), 60, 0.3}}, 400, 9);
    std::vector<WeightedDirection> weighted = drawn, repeated;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        weighted[i].weight = 0.25 * double(1 + i % 3);
        for (std::size_t n = 0; n <= i % 3; ++n) repeated.push_back(drawn[i]);
    }
    FitOptions options;
    options.components = 2;
    options.tolerance = 1e-12;
    options.iterations = 2000;
    const Fit a = fit(weighted, options), b = fit(repeated, options);
    ASSERT_EQ(a.lobes.size(), 2u);
    ASSERT_EQ(b.lobes.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(a.lobes[k].weight, b.lobes[k].weight, 1e-5);
        EXPECT_NEAR(a.lobes[k].kappa, b.lobes[k].kappa, 1e-3 * b.lobes[k].kappa);
        EXPECT_LT(between(a.lobes[k].mean, b.lobes[k].mean), 1e-4);
    }
}

TEST(Fit, MixturesAreNormalised) {
    const Fit found = fit(draw({{unit(0, 0, 1), 3, 0.6}, {unit(1, 0, 0), 25, 0.4}}, 2000, 4), {});
    ASSERT_FALSE(found.lobes.empty());
    double sum = 0;
    constexpr int kRows = 400;
    for (int y = 0; y < kRows; ++y) {
        const double theta = kPi * (y + 0.5) / kRows;
        for (int x = 0; x < 2 * kRows; ++x) {
            const double phi = kPi * (x + 0.5) / kRows;
            sum += density(found.lobes, {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}) *
                   std::sin(theta) * kPi / kRows * kPi / kRows;
        }
    }
    EXPECT_NEAR(sum, 1, 2e-3);
}

TEST(Fit, WhatHasNoShapeDoesNoHarm) {
    EXPECT_TRUE(fit({}, {}).lobes.empty());
    const double nan = std::nan("");
    const std::vector<WeightedDirection> bad{{{nan, 0, 0}, 1}, {{0, 0, 1}, nan}, {{0, 0, 1}, 0}, {{0, 0, 1}, -1}, {{0, 0, 0}, 1}};
    EXPECT_TRUE(fit(bad, {}).lobes.empty());

    // One direction again and again: one lobe, as narrow as allowed.
    const std::vector<WeightedDirection> same(100, {unit(1, 2, 3), 1});
    FitOptions options;
    options.largestKappa = 5000;
    const Fit narrow = fit(same, options);
    ASSERT_EQ(narrow.lobes.size(), 1u);
    EXPECT_EQ(narrow.lobes[0].kappa, 5000);
    EXPECT_LT(between(narrow.lobes[0].mean, unit(1, 2, 3)), 1e-7);

    // Opposite directions have no mean.
    const std::vector<WeightedDirection> opposite{{{0, 0, 1}, 1}, {{0, 0, -1}, 1}};
    options.components = 1;
    const Fit flat = fit(opposite, options);
    ASSERT_EQ(flat.lobes.size(), 1u);
    EXPECT_NEAR(flat.lobes[0].kappa, 0, 1e-9);

    // A prior keeps three directions from being a certainty.
    const auto few = draw({{unit(0, 0, 1), 1000, 1}}, 3, 2);
    options.priorSamples = 1;
    EXPECT_LT(fit(few, options).lobes.at(0).kappa, 10);
    options.cancelled = [] { return true; };
    EXPECT_TRUE(fit(few, options).lobes.empty());
}

TEST(Fit, IsTheSameEveryTime) {
    const auto drawn = draw({{unit(0, 0, 1), 3, 0.6}, {unit(1, 0, 0), 25, 0.4}}, 500, 8);
    EXPECT_EQ(fit(drawn, {}).lobes, fit(drawn, {}).lobes);
}

}  // namespace
}  // namespace mixture
