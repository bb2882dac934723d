#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/analysis/statistics.h"
#include "emca/analysis/tone_map.h"
#include "emca/core/image.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"

namespace emca::analysis {

/// How an image differs from a reference. d = image - reference, per pixel and channel. The small constants keep dark
/// pixels from dominating and are those of tev, so that numbers can be compared. FLIP is one number per pixel that depends
/// on its surroundings, see flip.h.
enum class ImageMetric : std::uint8_t {
    error = 0,             ///< d, signed
    absoluteError = 1,     ///< |d|
    squaredError = 2,      ///< d^2
    relativeAbsoluteError = 3,  ///< |d| / (|reference| + 0.01)
    relativeSquaredError = 4,   ///< d^2 / (reference^2 + 0.01)
    symmetricAbsoluteError = 5, ///< SMAPE: 2 |d| / (|image| + |reference| + 0.02)
    ldrFlip = 6,                ///< of what a screen shows at exposure 0: in [0, 1]
    hdrFlip = 7,                ///< the largest over the exposures that the reference has: in [0, 1]
};
inline constexpr std::size_t kImageMetricCount = 8;
/// True if a value of a channel differs by itself, so that apply() answers for it.
constexpr bool isPerChannel(ImageMetric metric) { return metric < ImageMetric::ldrFlip; }
std::string_view name(ImageMetric metric);  ///< "error", "absolute error", …
std::optional<ImageMetric> imageMetricByName(std::string_view name);

/// Of metrics that are per channel; of others NaN.
double apply(ImageMetric metric, double image, double reference);

/// The metric of the first three channels (one, if either image is grey) as an image with channels R, G, B (or Y; or FLIP,
/// with its default screen). Where both have the same infinity or both are NaN the difference is 0.
/// Errors: invalidArgument (sizes differ; the sentence names both).
Result<Image> differenceImage(const Image& image, const Image& reference, ImageMetric metric = ImageMetric::error);

/// Mean of a metric over all finite entries of a difference image.
double meanOf(const Image& difference);

/// Counts and moments of one channel in a region.
struct ChannelStatistics {
    std::string channel;
    Summary summary;
    std::size_t negative = 0;
    double median = 0;         ///< of the finite values; 0 if there is none
};
/// Per channel, and "luminance" last if there are at least three.
/// \param rect  clipped to the image; empty: the whole image
std::vector<ChannelStatistics> imageStatistics(const Image& image, PixelRect rect = {});
/// Of these pixels; those outside the image count for nothing.
std::vector<ChannelStatistics> imageStatistics(const Image& image, std::span<const Pixel> pixels);

/// What makes a pixel no radiance: its worst channel says.
enum class PixelFault : std::uint8_t { nan = 0, infinite = 1, negative = 2 };
struct FaultyPixel {
    Pixel pixel;
    PixelFault fault = PixelFault::nan;
    friend bool operator==(const FaultyPixel&, const FaultyPixel&) = default;
};
struct FaultRules {
    std::uint32_t channels = 0xffffffff;   ///< the first so many are looked at
    bool negative = true;                  ///< a negative channel is a fault; not so of differences, normals, positions
};
struct FaultCounts {
    std::size_t nan = 0, infinite = 0, negative = 0;   ///< pixels, each once
    std::size_t all() const { return nan + infinite + negative; }
};
/// Pixels with at least one NaN, infinite or negative channel, in reading order, at most `maximum`.
std::vector<FaultyPixel> faultyPixels(const Image& image, std::size_t maximum = 1000, const FaultRules& rules = {});
FaultCounts countFaults(const Image& image, const FaultRules& rules = {});
/// The first one after a pixel in reading order, beginning again at the top; `after` itself if it is the only one. Takes
/// no list, so that an image may have any number of them. \param after  nothing: from the top
std::optional<FaultyPixel> nextFault(const Image& image, std::optional<Pixel> after, const FaultRules& rules = {});

/// Values of a region as one series, for histograms and ranges.
/// \param rect  clipped to the image; empty: the whole image
std::vector<float> regionValues(const Image& image, ChannelChoice channel, PixelRect rect = {});
/// \param pixels  those outside the image are left out
std::vector<float> regionValues(const Image& image, ChannelChoice channel, std::span<const Pixel> pixels);

}  // namespace emca::analysis
