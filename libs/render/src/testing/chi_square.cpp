#include "testing/chi_square.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace emca::render::testing {

namespace {

constexpr double kMinExpected = 5;  ///< below it the chi-square distribution is no good description of a bin
constexpr int kMaxDepth = 7;

double gauss4x4(const Rectangle& r, const std::function<double(Vec2d)>& f) {
    static constexpr std::array<double, 4> kNodes = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                                     0.8611363115940526};
    static constexpr std::array<double, 4> kWeights = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                                       0.3478548451374538};
    const double cx = 0.5 * (r.x0 + r.x1), hx = 0.5 * (r.x1 - r.x0);
    const double cy = 0.5 * (r.y0 + r.y1), hy = 0.5 * (r.y1 - r.y0);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            sum += kWeights[i] * kWeights[j] * f({cx + hx * kNodes[i], cy + hy * kNodes[j]});
        }
    }
    return sum * hx * hy;
}

double refine(const Rectangle& r, double coarse, double tolerance, int depth, const std::function<double(Vec2d)>& f) {
    const double xm = 0.5 * (r.x0 + r.x1), ym = 0.5 * (r.y0 + r.y1);
    const std::array<Rectangle, 4> parts = {
        {{r.x0, xm, r.y0, ym}, {xm, r.x1, r.y0, ym}, {r.x0, xm, ym, r.y1}, {xm, r.x1, ym, r.y1}}};
    std::array<double, 4> fine{};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += fine[i] = gauss4x4(parts[i], f);
    if (depth >= kMaxDepth || std::abs(sum - coarse) <= tolerance + 1e-4 * std::abs(sum)) return sum;
    double total = 0;
    for (std::size_t i = 0; i < 4; ++i) total += refine(parts[i], fine[i], 0.25 * tolerance, depth + 1, f);
    return total;
}

struct Bin {
    double expected = 0;
    double observed = 0;
};

/// Joins bins that expect too little, smallest first, until every bin expects enough.
std::vector<Bin> pooled(std::vector<Bin> bins) {
    std::sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.expected < b.expected; });
    std::vector<Bin> result;
    Bin pool;
    for (const Bin& bin : bins) {
        pool.expected += bin.expected;
        pool.observed += bin.observed;
        if (pool.expected >= kMinExpected) {
            result.push_back(pool);
            pool = {};
        }
    }
    if (!result.empty()) {
        result.back().expected += pool.expected;
        result.back().observed += pool.observed;
    }
    return result;
}

ChiSquareResult judge(std::vector<Bin> bins, const ChiSquareOptions& options) {
    ChiSquareResult result;
    result.threshold = 1.0 - std::pow(1.0 - options.significance, 1.0 / std::max(1, options.tests));
    double outside = 0;  // samples where the density says there are none at all
    for (const Bin& bin : bins) {
        result.integral += bin.expected / options.samples;
        if (bin.expected < 1e-3) outside += bin.observed;
    }
    double drawn = 0;
    for (const Bin& bin : bins) drawn += bin.observed;
    bins.push_back({std::max(0.0, 1.0 - result.integral) * options.samples, options.samples - drawn});

    const std::vector<Bin> kept = pooled(std::move(bins));
    for (const Bin& bin : kept) {
        const double difference = bin.observed - bin.expected;
        result.statistic += difference * difference / bin.expected;
    }
    result.degreesOfFreedom = static_cast<int>(kept.size()) - 1;
    const bool tooMuch = result.integral > 1.002;
    if (result.degreesOfFreedom > 0) {
        const boost::math::chi_squared_distribution<double> distribution(result.degreesOfFreedom);
        result.pValue = boost::math::cdf(boost::math::complement(distribution, result.statistic));
    } else {
        result.pValue = 1;  // all in one bin: only the integral and stray samples can speak
    }
    const bool stray = outside > 10 + 1e-3 * options.samples;
    result.accepted = result.pValue >= result.threshold && !tooMuch && !stray && std::isfinite(result.statistic);

    char text[320];
    std::snprintf(
        text, sizeof text,
        "chi-square %.5g with %d degrees of freedom: p = %.3g, %s %.3g; the density integrates to %.6f, %.6f of "
        "the samples were something, %.0f where the density is 0.",
        result.statistic, result.degreesOfFreedom, result.pValue,
        result.pValue >= result.threshold ? "not below" : "below", result.threshold, result.integral,
        drawn / options.samples, outside);
    result.text = text;
    return result;
}

}  // namespace

double integrate(const Rectangle& domain, const std::function<double(Vec2d)>& f) {
    return refine(domain, gauss4x4(domain, f), 1e-7, 0, f);
}

double integrateDirections(double thetaMin, double thetaMax, const std::function<double(Vec3f)>& f) {
    double sum = 0;
    constexpr int kSteps = 16;  // narrow lobes are found only in small enough rectangles
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < 2 * kSteps; ++j) {
            const double step = (thetaMax - thetaMin) / kSteps, turn = std::numbers::pi / kSteps;
            sum += integrate({thetaMin + i * step, thetaMin + (i + 1) * step, j * turn, (j + 1) * turn},
                             [&f](Vec2d p) { return f(directionOf(p.x, p.y)) * std::sin(p.x); });
        }
    }
    return sum;
}

Vec3f directionOf(double theta, double phi) {
    return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
            static_cast<float>(std::cos(theta))};
}

ChiSquareResult testPoints(const Rectangle& domain, const std::function<std::optional<Vec2d>(TestRandom&)>& sample,
                           const std::function<double(Vec2d)>& pdf, const ChiSquareOptions& options) {
    const double xStep = (domain.x1 - domain.x0) / options.xBins, yStep = (domain.y1 - domain.y0) / options.yBins;
    std::vector<Bin> bins(static_cast<std::size_t>(options.xBins) * static_cast<std::size_t>(options.yBins));
    for (int i = 0; i < options.xBins; ++i) {
        for (int j = 0; j < options.yBins; ++j) {
            const Rectangle cell{domain.x0 + i * xStep, domain.x0 + (i + 1) * xStep, domain.y0 + j * yStep,
                                 domain.y0 + (j + 1) * yStep};
            bins[static_cast<std::size_t>(i * options.yBins + j)].expected =
                options.samples * std::max(0.0, integrate(cell, pdf));
        }
    }
    TestRandom random(options.seed);
    for (int n = 0; n < options.samples; ++n) {
        const std::optional<Vec2d> point = sample(random);
        if (!point ||
            !(point->x >= domain.x0 && point->x <= domain.x1 && point->y >= domain.y0 && point->y <= domain.y1))
            continue;
        const int i = std::min(static_cast<int>((point->x - domain.x0) / xStep), options.xBins - 1);
        const int j = std::min(static_cast<int>((point->y - domain.y0) / yStep), options.yBins - 1);
        bins[static_cast<std::size_t>(i * options.yBins + j)].observed += 1;
    }
    return judge(std::move(bins), options);
}

ChiSquareResult testDirections(const std::function<std::optional<Vec3f>(TestRandom&)>& sample,
                               const std::function<double(Vec3f)>& pdf, const ChiSquareOptions& options) {
    // Over theta rather than its cosine, as lobes along the axis would hide in a sliver of the first bin.
    const Rectangle sphere{0, std::numbers::pi, 0, 2 * std::numbers::pi};
    return testPoints(
        sphere,
        [&sample](TestRandom& random) -> std::optional<Vec2d> {
            const std::optional<Vec3f> direction = sample(random);
            if (!direction) return std::nullopt;
            double phi = std::atan2(static_cast<double>(direction->y), static_cast<double>(direction->x));
            if (phi < 0) phi += 2 * std::numbers::pi;
            const double across = std::hypot(static_cast<double>(direction->x), static_cast<double>(direction->y));
            return Vec2d{std::atan2(across, static_cast<double>(direction->z)), phi};
        },
        [&pdf](Vec2d p) { return pdf(directionOf(p.x, p.y)) * std::sin(p.x); }, options);
}

}  // namespace emca::render::testing
