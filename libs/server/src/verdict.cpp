#include "verdict.h"

#include <array>
#include <cmath>
#include <map>

namespace emca {

namespace {

/// Double precision: thousands of samples, among them fireflies, must not look wrong because of our own rounding.
struct Sum {
    std::array<double, 3> estimates{}, splats{};
    bool any = false;
};

void add(std::array<double, 3>& sum, Color c) {
    sum[0] += static_cast<double>(c.r);
    sum[1] += static_cast<double>(c.g);
    sum[2] += static_cast<double>(c.b);
}

bool agrees(double recorded, double replayed) {
    if (std::isnan(recorded) || std::isnan(replayed)) return std::isnan(recorded) && std::isnan(replayed);
    if (std::isinf(recorded) || std::isinf(replayed)) return recorded == replayed;
    return std::abs(recorded - replayed) <= 1e-3 * std::max(std::abs(recorded), std::abs(replayed));
}

}  // namespace

std::vector<SumCheck> checkSums(const PathSet& paths, const std::vector<Pixel>& pixels, std::uint32_t samplesPerPixel,
                                const std::vector<Color>& replayed, bool complete) {
    std::vector<SumCheck> checks(pixels.size(), SumCheck::unknown);
    if (!complete || samplesPerPixel == 0) return checks;
    std::map<Pixel, Sum> sums;
    for (const Pixel pixel : pixels) sums[pixel];
    for (Index path = 0; path < paths.pathCount(); ++path) {
        if (const auto estimate = paths.estimate(path)) {
            if (const auto it = sums.find(paths.pixel(path)); it != sums.end()) {
                add(it->second.estimates, *estimate);
                it->second.any = true;
            }
        }
    }
    for (const Splat& splat : paths.columns().splats) {
        if (const auto it = sums.find(splat.pixel); it != sums.end()) {
            add(it->second.splats, splat.value);
            it->second.any = true;
        }
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Sum& sum = sums[pixels[i]];
        if (!sum.any) continue;
        const std::array<double, 3> wanted{static_cast<double>(replayed[i].r), static_cast<double>(replayed[i].g),
                                           static_cast<double>(replayed[i].b)};
        bool all = true;
        for (std::size_t c = 0; c < 3; ++c) all = all && agrees(sum.estimates[c] / samplesPerPixel + sum.splats[c], wanted[c]);
        checks[i] = all ? SumCheck::matches : SumCheck::differs;
    }
    return checks;
}

SumCheck checkSums(const PathSet& paths, Pixel pixel, std::uint32_t samplesPerPixel, Color replayed, bool complete) {
    return checkSums(paths, std::vector<Pixel>{pixel}, samplesPerPixel, {replayed}, complete).front();
}

}  // namespace emca
