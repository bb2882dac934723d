#include "emca/analysis/flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "emca/analysis/format.h"
#include "flip_color.h"
#include "flip_filters.h"

namespace emca::analysis {
namespace {

constexpr double kBrightness = 0.85;              // t of [HDR] section 3.1
constexpr double kLargestPixelsPerDegree = 1000;  // filters are then some 300 pixels long
constexpr std::uint32_t kLargestCount = 1000;
constexpr double kLargestExposure = 300;  // stops: more than floats have

Color colorOf(const Image& image, Pixel p) {
    if (image.channelCount() >= 3) return image.color(p);
    return Color(*image.at(p));
}

bool isNaN(Color c) { return std::isnan(c.r) || std::isnan(c.g) || std::isnan(c.b); }

/// Rows of an image as the screen shows them, in [0, 1].
PerceivedImage::Source shownRows(const Image& image, FlipRange range, double exposure) {
    if (range == FlipRange::low)
        return [&image](std::uint32_t y, std::span<Color> row) {
            const auto clipped = [](float v) { return v > 0 ? std::min(v, 1.f) : 0.f; };  // NaN: 0
            for (std::uint32_t x = 0; x < row.size(); ++x) {
                const Color c = colorOf(image, {x, y});
                row[x] = {clipped(c.r), clipped(c.g), clipped(c.b)};
            }
        };
    const auto scale = static_cast<float>(std::exp2(exposure));
    return [&image, scale](std::uint32_t y, std::span<Color> row) {
        for (std::uint32_t x = 0; x < row.size(); ++x) {
            const Color c = colorOf(image, {x, y}) * scale;
            row[x] = {acesToneMap(c.r), acesToneMap(c.g), acesToneMap(c.b)};
        }
    };
}

/// The feature difference ΔE_f in [0, 1] ([LDR] section 4.2.2, with the exponent q_f = 0.5).
float featureDifference(float edge, float point, float referenceEdge, float referencePoint) {
    const float difference = std::max(std::abs(edge - referenceEdge), std::abs(point - referencePoint));
    return std::sqrt(std::min(1.f, difference / std::numbers::sqrt2_v<float>));
}

/// LDR-FLIP of what the screen shows at one exposure; each pixel keeps its largest difference.
/// \param goOn  asked after each row; false: the result is worth nothing
bool compare(const Image& image, const Image& reference, const FlipFilters& filters, FlipRange range, double exposure,
             Image& error, const std::function<bool(std::uint32_t row)>& goOn) {
    PerceivedImage left(filters, image.width(), image.height(), shownRows(image, range, exposure));
    PerceivedImage right(filters, image.width(), image.height(), shownRows(reference, range, exposure));
    for (std::uint32_t y = 0; y < image.height(); ++y) {
        const PerceivedRow &a = left.row(y), &b = right.row(y);
        float* out = error.at({0, y});
        for (std::uint32_t x = 0; x < image.width(); ++x) {
            const float color = flipColorDifference(a.color[x], b.color[x]);
            if (color == 0) continue;
            // The final difference ([LDR] section 4.3): features raise a difference of colours.
            const float feature = featureDifference(a.edge[x], a.point[x], b.edge[x], b.point[x]);
            out[x] = std::max(out[x], std::pow(color, 1 - feature));
        }
        if (!goOn(y)) return false;
    }
    return true;
}

Result<void> check(const Image& image, const Image& reference, const FlipOptions& options) {
    if (image.width() != reference.width() || image.height() != reference.height())
        return Error{ErrorCode::invalidArgument,
                     "The image has " + std::to_string(image.width()) + " x " + std::to_string(image.height()) +
                         " pixels and its reference " + std::to_string(reference.width()) + " x " +
                         std::to_string(reference.height()) + "; only images of the same size can be compared."};
    if (!(options.pixelsPerDegree > 0 && options.pixelsPerDegree <= kLargestPixelsPerDegree))
        return Error{ErrorCode::invalidArgument, "FLIP was asked for a screen of " +
                                                     formatNumber(options.pixelsPerDegree) +
                                                     " pixels per degree; the number must be positive and at most " +
                                                     formatNumber(kLargestPixelsPerDegree) + "."};
    if (options.exposures) {
        const FlipExposures& e = *options.exposures;
        const auto inside = [](double v) { return std::abs(v) <= kLargestExposure; };
        if (!inside(e.start) || !inside(e.stop) || e.count < 1 || e.count > kLargestCount)
            return Error{ErrorCode::invalidArgument, "FLIP was asked for " + std::to_string(e.count) +
                                                         " exposures from " + formatNumber(e.start) + " to " +
                                                         formatNumber(e.stop) +
                                                         " stops; 1 to 1000 exposures within 300 stops are possible."};
    }
    return {};
}

}  // namespace

double flipPixelsPerDegree(double distance, double width, double pixels) {
    return distance * pixels / width * std::numbers::pi / 180;
}

FlipExposures automaticExposures(const Image& reference) {
    std::vector<float> luminances;
    for (std::uint32_t y = 0; y < reference.height(); ++y)
        for (std::uint32_t x = 0; x < reference.width(); ++x) {
            const float v = luminance(colorOf(reference, {x, y}));
            if (std::isfinite(v)) luminances.push_back(std::max(v, 0.f));
        }
    const auto positive = std::partition(luminances.begin(), luminances.end(), [](float v) { return !(v > 0); });
    if (positive == luminances.end()) return {};
    const auto median = [](auto first, auto last) {
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last);
        return static_cast<double>(*middle);
    };
    const double largest = static_cast<double>(*std::max_element(positive, luminances.end()));
    double middle = median(luminances.begin(), luminances.end());
    if (!(middle > 0)) {
        const auto lit = std::partition(luminances.begin(), luminances.end(), [](float v) { return !(v > 0); });
        middle = median(lit, luminances.end());
    }
    const double radiance = acesInverse(kBrightness);
    FlipExposures exposures;
    exposures.start = std::log2(radiance / largest);
    exposures.stop = std::log2(radiance / middle);
    const double stops = exposures.stop - exposures.start;
    exposures.count = stops > 0 ? std::max(2u, static_cast<std::uint32_t>(std::ceil(stops))) : 1;
    return exposures;
}

Result<FlipResult> flip(const Image& image, const Image& reference, const FlipOptions& options) {
    if (const Result<void> valid = check(image, reference, options); !valid) return valid.error();
    FlipResult result;
    result.error = Image(image.width(), image.height(), {"FLIP"});
    if (result.error.empty()) return result;
    const FlipFilters filters(options.pixelsPerDegree);
    const bool high = options.range == FlipRange::high;
    if (high) result.exposures = options.exposures ? *options.exposures : automaticExposures(reference);
    const std::uint32_t passes = high ? result.exposures.count : 1;
    for (std::uint32_t i = 0; i < passes; ++i) {
        const auto goOn = [&](std::uint32_t row) {
            return !options.progress || options.progress((i + (row + 1.0) / image.height()) / passes);
        };
        if (!compare(image, reference, filters, options.range, high ? result.exposures.at(i) : 0, result.error, goOn))
            return Error{ErrorCode::cancelled, "FLIP was cancelled."};
    }
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            if (isNaN(colorOf(image, {x, y})) != isNaN(colorOf(reference, {x, y})))
                *result.error.at({x, y}) = std::nanf("");
    return result;
}

}  // namespace emca::analysis
