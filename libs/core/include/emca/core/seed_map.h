#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/pixel.h"

namespace emca {

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
    std::uint64_t seed(Pixel pixel, std::uint64_t sample) const;

  private:
    std::uint64_t masterSeed_ = 0;
    std::uint32_t width_ = 0;
    std::vector<std::uint32_t> stored_;
};

/// Bijective mixing of 64 bits. Source: Stafford's variant 13 of the MurmurHash3 finaliser, as in SplitMix64
/// (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

}  // namespace emca
