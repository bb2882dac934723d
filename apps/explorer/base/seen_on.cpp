#include "base/seen_on.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace emca::explorer {
namespace {

/// Contrast after WCAG 2.1: (Y + 0.05) of the lighter over that of the darker one.
constexpr double kContrast = 2.2, kFlare = 0.05;

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double encoded(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
double luminance(const std::array<double, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

}  // namespace

analysis::Color8 seenOn(analysis::Color8 color, const QColor& ground) {
    std::array<double, 3> c{linear(color.r / 255.0), linear(color.g / 255.0), linear(color.b / 255.0)};
    const double y = luminance(c), back = luminance({linear(ground.redF()), linear(ground.greenF()), linear(ground.blueF())});
    if (std::max(y, back) + kFlare >= kContrast * (std::min(y, back) + kFlare)) return color;
    if (back < 0.2) {
        const double wanted = kContrast * (back + kFlare) - kFlare, white = (wanted - y) / (1 - y);
        for (double& v : c) v += white * (1 - v);
    } else {
        const double wanted = (back + kFlare) / kContrast - kFlare;
        for (double& v : c) v *= wanted / y;
    }
    const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded(v), 0.0, 1.0))); };
    return {byte(c[0]), byte(c[1]), byte(c[2]), color.a};
}

}  // namespace emca::explorer
