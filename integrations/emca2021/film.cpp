#include "film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace emca::bridge {

float roundedToHalf(float value) {
    if (value == 0 || !std::isfinite(value)) return value;
    constexpr int kDigits = 10, kSmallest = -14;  // of the fraction; exponent of the smallest normal number
    const int exponent = std::max(std::ilogb(value), kSmallest);
    const float unit = std::ldexp(1.f, exponent - kDigits);
    const float rounded = std::nearbyint(value / unit) * unit;  // both exact: powers of two
    return std::fabs(rounded) > 65504.f ? std::copysign(std::numeric_limits<float>::infinity(), value) : rounded;
}

bool isHalf(const Image& image) {
    return std::all_of(image.data(), image.data() + image.size(), [](float v) {
        return !std::isfinite(v) || std::bit_cast<std::uint32_t>(roundedToHalf(v)) == std::bit_cast<std::uint32_t>(v);
    });
}

Color pixelValue(const PublishedPixel& pixel, std::uint32_t samplesPerPixel, bool half) {
    double red = 0, green = 0, blue = 0;
    for (const PublishedPath& path : pixel.paths) {
        if (!path.estimate) continue;
        red += double(path.estimate->r), green += double(path.estimate->g), blue += double(path.estimate->b);
    }
    const Color mean(static_cast<float>(red / samplesPerPixel), static_cast<float>(green / samplesPerPixel), static_cast<float>(blue / samplesPerPixel));
    return half ? Color(roundedToHalf(mean.r), roundedToHalf(mean.g), roundedToHalf(mean.b)) : mean;
}

}  // namespace emca::bridge
