#include "image/image_content.h"

#include <algorithm>
#include <cmath>

#include "emca/analysis/flip.h"

namespace emca::explorer {
namespace {

constexpr std::size_t kQuickPixels = 1u << 18;   ///< some milliseconds, whatever is computed besides FLIP

std::size_t pixelCount(const Image& image) { return std::size_t(image.width()) * image.height(); }

std::size_t incomparablePixels(const Image& difference) {
    const std::size_t channels = difference.channelCount();
    std::size_t count = 0;
    for (std::size_t i = 0; i < difference.size(); i += channels)
        count += std::any_of(difference.data() + i, difference.data() + i + channels, [](float v) { return !std::isfinite(v); });
    return count;
}

Result<Image> difference(const ContentWish& wish, ContentProgress& progress) {
    const Image &image = wish.image->color, &reference = wish.reference->color;
    if (analysis::isPerChannel(*wish.metric)) return analysis::differenceImage(image, reference, *wish.metric);
    analysis::FlipOptions options;
    options.range = *wish.metric == analysis::ImageMetric::ldrFlip ? analysis::FlipRange::low : analysis::FlipRange::high;
    options.progress = [&progress](double fraction) {
        progress.fraction = fraction;
        return !progress.cancelled;
    };
    auto result = analysis::flip(image, reference, options);
    if (!result) return result.error();
    return std::move(result->error);
}

}  // namespace

bool ContentWish::isSlow() const {
    if (!image || isImage()) return false;
    const std::size_t pixels = pixelCount(image->color);
    return metric && !analysis::isPerChannel(*metric) ? pixels > kQuickPixels / 32 : pixels > kQuickPixels;
}

Result<ImageContent> computeContent(const ContentWish& wish, ContentProgress& progress) {
    ImageContent content;
    if (!wish.image) return content;
    if (wish.isImage()) {
        content.values = std::shared_ptr<const Image>(wish.image, &wish.image->color);
        return content;
    }
    auto numbers = wish.metric ? difference(wish, progress) : analysis::samplingErrorImage(*wish.image, *wish.error);
    if (!numbers) return numbers.error();
    if (wish.metric) content.incomparable = incomparablePixels(*numbers);
    content.mean = analysis::meanOf(*numbers);
    content.values = std::make_shared<const Image>(std::move(*numbers));
    return content;
}

}  // namespace emca::explorer
