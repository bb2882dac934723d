#include "emca/analysis/image_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "emca/analysis/flip.h"

namespace emca::analysis {
namespace {

constexpr std::array<std::string_view, kImageMetricCount> kNames = {"error",
                                                                    "absolute error",
                                                                    "squared error",
                                                                    "relative absolute error",
                                                                    "relative squared error",
                                                                    "symmetric absolute error",
                                                                    "LDR-FLIP",
                                                                    "HDR-FLIP"};

PixelRect clipped(const Image& image, PixelRect rect) {
    if (rect.empty()) return {0, 0, image.width(), image.height()};
    return {rect.x0, rect.y0, std::min(rect.x1, image.width()), std::min(rect.y1, image.height())};
}

/// Calls visit(pixel) for the pixels of a region in reading order.
template <typename Visit>
void forEachPixel(const PixelRect& rect, const Visit& visit) {
    for (std::uint32_t y = rect.y0; y < rect.y1; ++y)
        for (std::uint32_t x = rect.x0; x < rect.x1; ++x) visit(Pixel{x, y});
}

bool isSame(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

std::string_view name(ImageMetric metric) {
    const auto i = static_cast<std::size_t>(metric);
    return i < kNames.size() ? kNames[i] : "unknown";
}

std::optional<ImageMetric> imageMetricByName(std::string_view name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) return std::nullopt;
    return static_cast<ImageMetric>(found - kNames.begin());
}

double apply(ImageMetric metric, double image, double reference) {
    const double d = image - reference;
    switch (metric) {
        case ImageMetric::error:
            return d;
        case ImageMetric::absoluteError:
            return std::abs(d);
        case ImageMetric::squaredError:
            return d * d;
        case ImageMetric::relativeAbsoluteError:
            return std::abs(d) / (std::abs(reference) + 0.01);
        case ImageMetric::relativeSquaredError:
            return d * d / (reference * reference + 0.01);
        case ImageMetric::symmetricAbsoluteError:
            return 2 * std::abs(d) / (std::abs(image) + std::abs(reference) + 0.02);
        case ImageMetric::ldrFlip:
        case ImageMetric::hdrFlip:
            break;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

Result<Image> differenceImage(const Image& image, const Image& reference, ImageMetric metric) {
    if (!isPerChannel(metric)) {
        auto result = flip(image, reference, {.range = metric == ImageMetric::ldrFlip ? FlipRange::low : FlipRange::high});
        if (!result) return result.error();
        return std::move(result->error);
    }
    if (image.width() != reference.width() || image.height() != reference.height())
        return Error{ErrorCode::invalidArgument,
                     "The image has " + std::to_string(image.width()) + " x " + std::to_string(image.height()) +
                         " pixels and its reference " + std::to_string(reference.width()) + " x " +
                         std::to_string(reference.height()) + "; only images of the same size can be compared."};
    const bool grey = image.channelCount() < 3 || reference.channelCount() < 3;
    const std::vector<std::string> channels =
        grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    Image difference(image.width(), image.height(), channels);
    const auto at = [metric](float a, float b) {
        if (isSame(a, b)) return 0.f;
        return static_cast<float>(apply(metric, static_cast<double>(a), static_cast<double>(b)));
    };
    forEachPixel(clipped(image, {}), [&](Pixel p) {
        if (grey) {
            *difference.at(p) = at(scalar(image, p, {}), scalar(reference, p, {}));
        } else {
            const Color a = image.color(p), b = reference.color(p);
            difference.setColor(p, {at(a.r, b.r), at(a.g, b.g), at(a.b, b.b)});
        }
    });
    return difference;
}

double meanOf(const Image& difference) {
    return summarize(std::span<const float>(difference.data(), difference.size())).mean;
}

std::vector<float> regionValues(const Image& image, ChannelChoice channel, PixelRect rect) {
    const PixelRect region = clipped(image, rect);
    std::vector<float> values;
    values.reserve(region.count());
    forEachPixel(region, [&](Pixel p) { values.push_back(scalar(image, p, channel)); });
    return values;
}

std::vector<float> regionValues(const Image& image, ChannelChoice channel, std::span<const Pixel> pixels) {
    std::vector<float> values;
    values.reserve(pixels.size());
    for (const Pixel p : pixels)
        if (image.contains(p)) values.push_back(scalar(image, p, channel));
    return values;
}

namespace {

/// By selection instead of sorting: a region may be a whole image. Type 7 of Hyndman and Fan, as quantile().
double medianOfFinite(std::vector<float>& values) {
    const auto end = std::partition(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
    const auto count = end - values.begin();
    if (count == 0) return 0;
    const auto middle = values.begin() + count / 2;
    std::nth_element(values.begin(), middle, end);
    if (count % 2 == 1) return static_cast<double>(*middle);
    return std::midpoint(static_cast<double>(*std::max_element(values.begin(), middle)), static_cast<double>(*middle));
}

/// \param valuesOf  the values of a channel of the region
template <typename Values>
std::vector<ChannelStatistics> statisticsOf(const Image& image, const Values& valuesOf) {
    std::vector<ChannelStatistics> result;
    const auto add = [&](const std::string& channel, int index) {
        std::vector<float> values = valuesOf(ChannelChoice{index});
        const auto negative = std::count_if(values.begin(), values.end(), [](float v) { return v < 0; });
        const Summary summary = summarize(std::span<const float>(values));
        result.push_back({channel, summary, static_cast<std::size_t>(negative), medianOfFinite(values)});
    };
    for (std::uint32_t c = 0; c < image.channelCount(); ++c) add(image.channels()[c], static_cast<int>(c));
    if (image.channelCount() >= 3) add("luminance", ChannelChoice::kLuminance);
    return result;
}

}  // namespace

std::vector<ChannelStatistics> imageStatistics(const Image& image, PixelRect rect) {
    return statisticsOf(image, [&](ChannelChoice channel) { return regionValues(image, channel, rect); });
}

std::vector<ChannelStatistics> imageStatistics(const Image& image, std::span<const Pixel> pixels) {
    return statisticsOf(image, [&](ChannelChoice channel) { return regionValues(image, channel, pixels); });
}

namespace {

std::optional<PixelFault> faultOf(std::span<const float> values, const FaultRules& rules) {
    const auto any = [&](auto test) { return std::any_of(values.begin(), values.end(), test); };
    if (!any([&](float v) { return !std::isfinite(v) || (rules.negative && v < 0); })) return {};
    if (any([](float v) { return std::isnan(v); })) return PixelFault::nan;
    return any([](float v) { return std::isinf(v); }) ? PixelFault::infinite : PixelFault::negative;
}

/// Calls found(pixel) for faulty pixels in reading order from number `first` to before `last`, until it says false.
template <typename Found>
void visitFaults(const Image& image, const FaultRules& rules, std::size_t first, std::size_t last, const Found& found) {
    const std::size_t stride = image.channelCount(), channels = std::min<std::size_t>(stride, rules.channels);
    for (std::size_t i = first; i < last; ++i) {
        const auto fault = faultOf({image.data() + i * stride, channels}, rules);
        if (fault && !found(FaultyPixel{{static_cast<std::uint32_t>(i % image.width()), static_cast<std::uint32_t>(i / image.width())}, *fault})) return;
    }
}

std::size_t pixelCount(const Image& image) { return std::size_t(image.width()) * image.height(); }

}  // namespace

std::vector<FaultyPixel> faultyPixels(const Image& image, std::size_t maximum, const FaultRules& rules) {
    std::vector<FaultyPixel> result;
    if (maximum == 0) return result;
    visitFaults(image, rules, 0, pixelCount(image), [&](const FaultyPixel& pixel) {
        result.push_back(pixel);
        return result.size() < maximum;
    });
    return result;
}

FaultCounts countFaults(const Image& image, const FaultRules& rules) {
    FaultCounts counts;
    visitFaults(image, rules, 0, pixelCount(image), [&](const FaultyPixel& pixel) {
        ++(pixel.fault == PixelFault::nan ? counts.nan : pixel.fault == PixelFault::infinite ? counts.infinite : counts.negative);
        return true;
    });
    return counts;
}

std::optional<FaultyPixel> nextFault(const Image& image, std::optional<Pixel> after, const FaultRules& rules) {
    const std::size_t count = pixelCount(image);
    const std::size_t begin = after ? std::min(count, std::size_t(after->y) * image.width() + after->x + 1) : 0;
    std::optional<FaultyPixel> result;
    const auto take = [&](const FaultyPixel& pixel) {
        result = pixel;
        return false;
    };
    visitFaults(image, rules, begin, count, take);
    if (!result) visitFaults(image, rules, 0, begin, take);
    return result;
}

}  // namespace emca::analysis
