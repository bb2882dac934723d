#include "emca/render/reconstruction_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace emca::render {

namespace {

constexpr double kRadiusInDeviations = 4;  // as Mitsuba's
constexpr std::size_t kBins = 1024;

/// Gaussian of deviation 1, lowered by its value at the radius, and its integral from the left end to x.
double loweredGaussian(double x) {
    constexpr double kRadius = kRadiusInDeviations;
    return std::max(0.0, std::exp(-0.5 * x * x) - std::exp(-0.5 * kRadius * kRadius));
}

double loweredIntegral(double x) {
    constexpr double kRadius = kRadiusInDeviations;
    const double root = std::sqrt(0.5);
    const double gaussian = std::sqrt(std::acos(-1.0) / 2) * (std::erf(x * root) + std::erf(kRadius * root));
    return gaussian - std::exp(-0.5 * kRadius * kRadius) * (x + kRadius);
}

}  // namespace

const char* name(FilterKind kind) {
    switch (kind) {
        case FilterKind::tent: return "tent";
        case FilterKind::gaussian: return "gaussian";
        case FilterKind::box: break;
    }
    return "box";
}

ReconstructionFilter ReconstructionFilter::gaussian(float standardDeviation) {
    ReconstructionFilter filter(FilterKind::gaussian, static_cast<float>(kRadiusInDeviations) * standardDeviation);
    filter.standardDeviation_ = standardDeviation;
    filter.normalisation_ = static_cast<float>(1 / (loweredIntegral(kRadiusInDeviations) * double(standardDeviation)));
    std::vector<float> shares;
    double before = 0;
    for (std::size_t i = 1; i <= kBins; ++i) {
        const double integral = loweredIntegral(kRadiusInDeviations * (2 * static_cast<double>(i) / kBins - 1));
        shares.push_back(static_cast<float>(integral - before));
        before = integral;
    }
    filter.bins_ = Distribution1D(shares);
    return filter;
}

float ReconstructionFilter::sampleShaped(float u) const {
    switch (kind_) {
        case FilterKind::tent:
            return radius_ * (u < 0.5f ? std::sqrt(2.f * u) - 1.f : 1.f - std::sqrt(2.f * (1.f - u)));
        case FilterKind::gaussian: {
            const Distribution1D::Choice bin = bins_.sample(u);
            return radius_ * (2.f * (static_cast<float>(bin.index) + bin.remainder) / kBins - 1.f);
        }
        case FilterKind::box: break;
    }
    return radius_ * (2.f * u - 1.f);
}

float ReconstructionFilter::pdf(float offset) const {
    if (std::abs(offset) > radius_) return 0.f;
    switch (kind_) {
        case FilterKind::tent: return (1.f - std::abs(offset) / radius_) / radius_;
        case FilterKind::gaussian: {
            const double x = double(offset) / double(standardDeviation_);
            return static_cast<float>(loweredGaussian(x)) * normalisation_;
        }
        case FilterKind::box: break;
    }
    return 0.5f / radius_;
}

}  // namespace emca::render
