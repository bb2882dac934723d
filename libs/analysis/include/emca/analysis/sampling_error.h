#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emca/core/image.h"
#include "emca/core/result.h"

namespace emca::analysis {

/// How far a render may be from what it estimates, per pixel and channel, told from the spread of the pixel's samples.
/// With n samples of unbiased variance s^2 and mean m:
enum class SamplingError : std::uint8_t {
    variance = 0,       ///< s^2: of one sample, (W/(sr m^2))^2
    standardError = 1,  ///< sqrt(s^2 / n): of the pixel, W/(sr m^2)
    relativeError = 2,  ///< sqrt(s^2 / n) / (|m| + 0.01), without a unit; the constant is that of the relative metrics
};
inline constexpr std::size_t kSamplingErrorCount = 3;
std::string_view name(SamplingError error);  ///< "variance", "standard error", "relative error"

/// True if the image came with samples and variance: as a render, or as channels "samples" and "variance.R", "variance.G",
/// "variance.B" of a file that was saved from one.
bool hasVariance(const RenderedImage& image);

/// Channels R, G, B. NaN where a pixel has fewer than two samples, from which no variance can be told.
/// Errors: notSupported (there are no variances, or no pixel has two samples).
Result<Image> samplingErrorImage(const RenderedImage& image, SamplingError error);

}  // namespace emca::analysis
