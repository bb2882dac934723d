#include "emca/analysis/sampling_error.h"

#include <array>
#include <cmath>
#include <limits>

namespace emca::analysis {
namespace {

constexpr float kDarkest = 0.01f;  // keeps black pixels from dominating, as in the relative metrics
constexpr std::array<std::string_view, kSamplingErrorCount> kNames = {"variance", "standard error", "relative error"};

/// Where the numbers of a pixel lie: in images of their own, or in further channels of the colours.
struct Source {
    const Image* samples = nullptr;
    const Image* variance = nullptr;
    int count = -1, channels[3] = {-1, -1, -1};
    explicit operator bool() const { return samples && count >= 0 && channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0; }
};

bool sameSize(const Image& a, const Image& b) { return a.width() == b.width() && a.height() == b.height(); }

Source sourceOf(const RenderedImage& image) {
    if (!image.variance.empty() && !image.samples.empty()) {
        if (image.variance.channelCount() < 3 || !sameSize(image.variance, image.color) || !sameSize(image.samples, image.color)) return {};
        return {&image.samples, &image.variance, 0, {0, 1, 2}};
    }
    const Image& all = image.color;
    return {&all, &all, all.channelIndex("samples"),
            {all.channelIndex("variance.R"), all.channelIndex("variance.G"), all.channelIndex("variance.B")}};
}

float errorOf(SamplingError error, float variance, float samples, float mean) {
    if (error == SamplingError::variance) return variance;
    const float standard = std::sqrt(variance / samples);
    return error == SamplingError::standardError ? standard : standard / (std::abs(mean) + kDarkest);
}

}  // namespace

std::string_view name(SamplingError error) {
    const auto i = static_cast<std::size_t>(error);
    return i < kNames.size() ? kNames[i] : "unknown";
}

bool hasVariance(const RenderedImage& image) {
    return !image.color.empty() && image.color.channelCount() >= 3 && sourceOf(image);
}

Result<Image> samplingErrorImage(const RenderedImage& image, SamplingError error) {
    if (!hasVariance(image))
        return Error{ErrorCode::notSupported,
                     "The " + std::string(name(error)) + " of this image is not known: it came without samples and variance "
                     "per pixel. Renders have them, and EXR files that were saved from renders."};
    const Source source = sourceOf(image);
    Image result(image.color.width(), image.color.height());
    bool any = false;
    for (std::uint32_t y = 0; y < result.height(); ++y)
        for (std::uint32_t x = 0; x < result.width(); ++x) {
            const Pixel p{x, y};
            const float samples = source.samples->at(p)[source.count];
            const bool known = samples >= 2;
            any = any || known;
            const float* mean = image.color.at(p);
            const float* variance = source.variance->at(p);
            float* out = result.at(p);
            for (int c = 0; c < 3; ++c)
                out[c] = known ? errorOf(error, variance[source.channels[c]], samples, mean[c])
                               : std::numeric_limits<float>::quiet_NaN();
        }
    if (!any)
        return Error{ErrorCode::notSupported, "The " + std::string(name(error)) +
                                                  " is not known: no pixel has two samples. Render with more samples per pixel."};
    return result;
}

}  // namespace emca::analysis
