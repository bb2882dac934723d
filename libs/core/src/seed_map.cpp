#include "emca/core/seed_map.h"

#include <cassert>

namespace emca {

SeedMap::SeedMap(std::uint32_t width, std::vector<std::uint32_t> seeds, std::uint64_t masterSeed)
    : masterSeed_(masterSeed), width_(width), stored_(std::move(seeds)) {
    assert(width > 0 && stored_.size() % width == 0);
}

std::uint64_t SeedMap::seed(Pixel pixel) const {
    const std::uint64_t place = (std::uint64_t(pixel.y) << 32) | pixel.x;
    std::uint64_t own = place;
    if (!stored_.empty()) {
        const std::size_t index = std::size_t(pixel.y) * width_ + pixel.x;
        assert(pixel.x < width_ && index < stored_.size());
        own = stored_[index];
    }
    return mix64(mix64(masterSeed_ + kGolden64) + own * kGolden64 + kGolden64);
}

}  // namespace emca
