#include "emca/analysis/firefly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emca/analysis/tone_map.h"

namespace emca::analysis {
namespace {

/// Finite values around a pixel, without its own.
void collectNeighbours(const std::vector<float>& values, std::uint32_t width, std::uint32_t height, Pixel pixel,
                       int radius, std::vector<float>& neighbours) {
    neighbours.clear();
    const auto w = static_cast<int>(width), h = static_cast<int>(height);
    const auto px = static_cast<int>(pixel.x), py = static_cast<int>(pixel.y);
    for (int y = std::max(py - radius, 0); y <= std::min(py + radius, h - 1); ++y)
        for (int x = std::max(px - radius, 0); x <= std::min(px + radius, w - 1); ++x) {
            const float v = values[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
            if ((x != px || y != py) && std::isfinite(v)) neighbours.push_back(v);
        }
}

/// True if more than half of the values reach a limit, and so does their median: found without sorting.
bool mostReach(const std::vector<float>& values, float limit) {
    std::size_t count = 0;
    for (const float v : values)
        if (v >= limit && ++count > values.size() / 2) return true;
    return false;
}

float median(std::vector<float>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5f * (*middle + *std::max_element(values.begin(), middle));
}

/// Mean luminance without the brightest hundredth, which is where fireflies are.
float ordinaryMean(std::vector<float> values) {
    std::erase_if(values, [](float v) { return !std::isfinite(v); });
    if (values.empty()) return 0;
    const std::size_t kept = std::max<std::size_t>(values.size() - values.size() / 100, 1);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1), values.end());
    double sum = 0;
    for (std::size_t i = 0; i < kept; ++i) sum += static_cast<double>(std::max(values[i], 0.f));
    return static_cast<float>(sum / static_cast<double>(kept));
}

}  // namespace

std::vector<Firefly> findFireflies(const Image& image, const FireflyOptions& options) {
    std::vector<Firefly> found;
    if (image.width() < 2 || image.height() < 2 || image.channelCount() == 0) return found;
    const std::vector<float> values = scalars(image, {});
    // Never 0: in an all-black image a single lit pixel has a finite ratio.
    const float floor = std::max(options.floor * ordinaryMean(values), 1e-6f);
    const int radius = std::max(options.radius, 1);
    std::vector<float> neighbours;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) {
            const float value = values[std::size_t(y) * image.width() + x];
            // The median of many is at least 0 in a valid image, so dim pixels need no look at their neighbours.
            if (std::isfinite(value) && value < options.ratio * floor) continue;
            collectNeighbours(values, image.width(), image.height(), {x, y}, radius, neighbours);
            if (mostReach(neighbours, value / options.ratio)) continue;
            const float middle = median(neighbours);
            const float ratio =
                std::isfinite(value) ? value / (std::max(middle, 0.f) + floor) : std::numeric_limits<float>::infinity();
            if (ratio < options.ratio) continue;
            const auto company =
                std::count_if(neighbours.begin(), neighbours.end(), [=](float v) { return v > 0.25f * value; });
            const float most = std::max(options.company * static_cast<float>(neighbours.size()), 1.f);
            if (static_cast<float>(company) <= most) found.push_back({{x, y}, value, middle, ratio});
        }
    std::stable_sort(found.begin(), found.end(), [](const Firefly& a, const Firefly& b) { return a.ratio > b.ratio; });
    if (found.size() > options.maximum) found.resize(options.maximum);
    return found;
}

}  // namespace emca::analysis
