#include "emca/core/pixel_sums.h"

namespace emca {

std::vector<SampleRange> samplePasses(std::uint32_t samplesPerPixel, bool collectsLayers) {
    if (!collectsLayers || samplesPerPixel == 0) return {{0, samplesPerPixel}};
    std::vector<SampleRange> all{{0, 1}};
    while (all.back().last < samplesPerPixel) {
        const std::uint32_t first = all.back().last;
        all.push_back({first, 4 * std::uint64_t(first) < samplesPerPixel ? 2 * first : samplesPerPixel});
    }
    return all;
}

}  // namespace emca
