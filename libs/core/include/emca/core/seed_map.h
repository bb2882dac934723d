#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/pixel.h"

namespace emca {

/// 2^64 over the golden ratio: the increment of SplitMix64 (Steele, Lea, Flood 2014).
inline constexpr std::uint64_t kGolden64 = 0x9e3779b97f4a7c15ull;

/// Bijective mixing of 64 bits. Source: Stafford's variant 13 of the MurmurHash3 finaliser, as in SplitMix64.
constexpr std::uint64_t mix64(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

/// Gives each (pixel, sample) its seed, so that a pixel can be rendered again alone and bit by bit the same
/// (thesis, section 4.4). A seed depends on the pixel, the sample index and the master seed, never on the number of
/// samples: more samples per pixel extend the paths and change none.
///
/// The hashed map needs no storage; a stored map holds 4 bytes a pixel, as the thesis' does, for renderers whose
/// seeds come from elsewhere.
class SeedMap {
  public:
    /// Hashed.
    explicit SeedMap(std::uint64_t masterSeed = 0) : masterSeed_(masterSeed) {}
    /// Stored: one seed per pixel, row by row; `seeds.size()` must be a multiple of `width`.
    SeedMap(std::uint32_t width, std::vector<std::uint32_t> seeds, std::uint64_t masterSeed = 0);

    /// Seed of a whole pixel.
    std::uint64_t seed(Pixel pixel) const;
    /// Seed of one sample of a pixel.
    std::uint64_t seed(Pixel pixel, std::uint64_t sample) const { return seedOfSample(seed(pixel), sample); }
    /// The same from the pixel's seed, for those who take its samples one after the other.
    static constexpr std::uint64_t seedOfSample(std::uint64_t pixelSeed, std::uint64_t sample) {
        return mix64(pixelSeed + (sample + 1) * kGolden64);
    }

  private:
    std::uint64_t masterSeed_ = 0;
    std::uint32_t width_ = 0;
    std::vector<std::uint32_t> stored_;
};

}  // namespace emca
