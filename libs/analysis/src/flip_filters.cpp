#include "flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace emca::analysis {
namespace {

/// Parameters of contrast sensitivity in degrees ([LDR] table 1): a sqrt(pi / b) exp(-pi^2 x^2 / b).
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kAchromaticSensitivity{1, 0.0047}, kRedGreenSensitivity{1, 0.0053}, kWideSensitivity{34.1, 0.04},
    kNarrowSensitivity{13.5, 0.025};
/// Width of a feature in degrees ([LDR] section 4.2).
constexpr double kFeatureWidth = 0.082;
/// Weights below this share of the largest one are left out: less than what floats round.
constexpr double kSmallest = 1e-9;

std::size_t threeDeviations(double sigma) { return static_cast<std::size_t>(std::ceil(3 * sigma)); }

double total(const std::vector<double>& half) {
    double sum = half[0];
    for (std::size_t k = 1; k < half.size(); ++k) sum += 2 * half[k];
    return sum;
}

HalfKernel scaled(const std::vector<double>& half, double factor) {
    HalfKernel kernel;
    for (const double v : half) kernel.push_back(static_cast<float>(v * factor));
    return kernel;
}

std::vector<double> gaussian(double sigma, std::size_t radius) {
    std::vector<double> half;
    for (std::size_t k = 0; k <= radius; ++k) {
        const double x = static_cast<double>(k) / sigma, v = std::exp(-x * x / 2);
        if (v > kSmallest) half.push_back(v);
    }
    return half;
}

double sigmaInPixels(const Sensitivity& s, double pixelsPerDegree) {
    return std::sqrt(s.b / 2) / std::numbers::pi * pixelsPerDegree;
}

/// A pixel and those at distance 1, 2, … on both sides of it: of a row, or of rows above and below.
struct Lines {
    const float* center;
    const float* const* before;
    const float* const* after;
};

/// out[x] = the sum of the weighted pixels around x. Blocks of some registers' width, so that sums stay in registers.
template <bool Odd>
void filter(const Lines& lines, const HalfKernel& kernel, std::size_t width, float* out) {
    constexpr std::size_t kBlock = 16;
    const std::size_t taps = kernel.size();
    for (std::size_t x = 0; x < width; x += kBlock) {
        const std::size_t first = std::min(x, width >= kBlock ? width - kBlock : 0);  // the last block overlaps
        const std::size_t count = std::min(kBlock, width);
        float sum[kBlock] = {};
        if (count == kBlock) {
            if constexpr (!Odd)
                for (std::size_t j = 0; j < kBlock; ++j) sum[j] = kernel[0] * lines.center[first + j];
            for (std::size_t k = 1; k < taps; ++k) {
                const float weight = kernel[k];
                const float *a = lines.after[k] + first, *b = lines.before[k] + first;
                for (std::size_t j = 0; j < kBlock; ++j) sum[j] += weight * (Odd ? a[j] - b[j] : a[j] + b[j]);
            }
        } else {
            for (std::size_t j = 0; j < count; ++j) {
                if constexpr (!Odd) sum[j] = kernel[0] * lines.center[j];
                for (std::size_t k = 1; k < taps; ++k)
                    sum[j] += kernel[k] *
                              (Odd ? lines.after[k][j] - lines.before[k][j] : lines.after[k][j] + lines.before[k][j]);
            }
        }
        std::copy(sum, sum + count, out + first);
    }
}

}  // namespace

FlipFilters::FlipFilters(double pixelsPerDegree) {
    // One radius for all, that of the widest Gaussian ([LDR] section 4.1.1).
    const std::size_t colorRadius = threeDeviations(sigmaInPixels(kWideSensitivity, pixelsPerDegree));
    const auto sensitivity = [&](const Sensitivity& s, double& weight) {
        const std::vector<double> half = gaussian(sigmaInPixels(s, pixelsPerDegree), colorRadius);
        const double sum = total(half);
        weight = s.a * std::sqrt(std::numbers::pi / s.b) * sum * sum;
        return scaled(half, 1 / sum);
    };
    double wide = 0, narrow = 0, alone = 0;
    achromatic = sensitivity(kAchromaticSensitivity, alone);
    redGreen = sensitivity(kRedGreenSensitivity, alone);
    blueYellowWide = sensitivity(kWideSensitivity, wide);
    blueYellowNarrow = sensitivity(kNarrowSensitivity, narrow);
    wideShare = static_cast<float>(wide / (wide + narrow));

    const double sigma = kFeatureWidth / 2 * pixelsPerDegree;
    const std::vector<double> half = gaussian(sigma, threeDeviations(sigma));
    smooth = scaled(half, 1 / total(half));
    // Positive weights add up to 1 and negative ones to -1, so that a step from black to white has the answer 1.
    std::vector<double> first, second;
    double sum = 0, positive = 0, negative = 0;
    for (std::size_t k = 0; k < half.size(); ++k) {
        const double x = static_cast<double>(k);
        first.push_back(x * half[k]);
        sum += first.back();
        second.push_back((x * x / (sigma * sigma) - 1) * half[k]);
        (second[k] > 0 ? positive : negative) += (k > 0 ? 2 : 1) * second[k];
    }
    edge = scaled(first, sum > 0 ? 1 / sum : 0);
    for (double& v : second) v /= v > 0 ? positive : -negative;
    point = scaled(second, 1);
    radius =
        std::max({achromatic.size(), redGreen.size(), blueYellowWide.size(), blueYellowNarrow.size(), smooth.size()}) -
        1;
}

PerceivedImage::PerceivedImage(const FlipFilters& filters, std::uint32_t width, std::uint32_t height, Source source)
    : filters_(filters),
      width_(width),
      height_(height),
      slots_(2 * filters.radius + 1),
      source_(std::move(source)),
      colors_(width),
      lines_(slots_ * kPlaneCount * width),
      before_(filters.radius + 1),
      after_(filters.radius + 1) {
    for (auto& channel : padded_) channel.resize(width + 2 * filters.radius);
    for (auto& channel : columns_) channel.resize(width);
    row_.color.resize(width);
    row_.edge.resize(width);
    row_.point.resize(width);
}

float* PerceivedImage::line(Plane plane, std::size_t y) {
    return &lines_[((y % slots_) * kPlaneCount + plane) * width_];
}

void PerceivedImage::load(std::uint32_t y) {
    source_(y, colors_);
    const std::size_t radius = filters_.radius;
    // Y, Cx and Cz of [LDR] equations 1 and 2 without their constants, which linear filters pass unchanged.
    for (std::size_t x = 0; x < width_; ++x) {
        const RelativeXyz xyz = toRelativeXyz(colors_[x]);
        padded_[0][radius + x] = xyz.y;
        padded_[1][radius + x] = xyz.x - xyz.y;
        padded_[2][radius + x] = xyz.y - xyz.z;
    }
    for (auto& channel : padded_) {
        std::fill_n(channel.begin(), radius, channel[radius]);
        std::fill_n(channel.end() - static_cast<std::ptrdiff_t>(radius), radius, channel[radius + width_ - 1]);
    }
    const auto filtered = [&](std::size_t channel, const HalfKernel& kernel, Plane plane, bool odd) {
        const float* center = padded_[channel].data() + radius;
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            before_[k] = center - k;
            after_[k] = center + k;
        }
        (odd ? filter<true> : filter<false>)({center, before_.data(), after_.data()}, kernel, width_, line(plane, y));
    };
    filtered(0, filters_.achromatic, kAchromatic, false);
    filtered(1, filters_.redGreen, kRedGreen, false);
    filtered(2, filters_.blueYellowWide, kWide, false);
    filtered(2, filters_.blueYellowNarrow, kNarrow, false);
    filtered(0, filters_.smooth, kSmooth, false);
    filtered(0, filters_.edge, kEdge, true);
    filtered(0, filters_.point, kPoint, false);
}

void PerceivedImage::column(Plane plane, const HalfKernel& kernel, std::uint32_t y, bool odd, std::vector<float>& out) {
    for (std::size_t k = 0; k < kernel.size(); ++k) {
        before_[k] = line(plane, y >= k ? y - k : 0);
        after_[k] = line(plane, std::min<std::size_t>(y + k, height_ - 1));
    }
    (odd ? filter<true> : filter<false>)({line(plane, y), before_.data(), after_.data()}, kernel, width_, out.data());
}

const PerceivedRow& PerceivedImage::row(std::uint32_t y) {
    const std::size_t last = std::min<std::size_t>(y + filters_.radius, height_ - 1);
    while (loaded_ <= last) load(loaded_++);

    auto& [achromatic, redGreen, wide, narrow, first, second] = columns_;
    column(kAchromatic, filters_.achromatic, y, false, achromatic);
    column(kRedGreen, filters_.redGreen, y, false, redGreen);
    column(kWide, filters_.blueYellowWide, y, false, wide);
    column(kNarrow, filters_.blueYellowNarrow, y, false, narrow);
    for (std::size_t x = 0; x < width_; ++x) {
        const float luma = achromatic[x], blueYellow = narrow[x] + filters_.wideShare * (wide[x] - narrow[x]);
        const Color seen = fromRelativeXyz({redGreen[x] + luma, luma, luma - blueYellow});
        row_.color[x] =
            toHuntLab({std::clamp(seen.r, 0.f, 1.f), std::clamp(seen.g, 0.f, 1.f), std::clamp(seen.b, 0.f, 1.f)});
    }
    const auto length = [&](std::vector<float>& out) {
        for (std::size_t x = 0; x < width_; ++x) out[x] = std::sqrt(first[x] * first[x] + second[x] * second[x]);
    };
    column(kEdge, filters_.smooth, y, false, first);
    column(kSmooth, filters_.edge, y, true, second);
    length(row_.edge);
    column(kPoint, filters_.smooth, y, false, first);
    column(kSmooth, filters_.point, y, false, second);
    length(row_.point);
    return row_;
}

}  // namespace emca::analysis
