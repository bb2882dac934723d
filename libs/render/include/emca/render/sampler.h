#pragma once

#include <cstdint>

#include "emca/core/pixel.h"
#include "emca/core/seed_map.h"
#include "emca/core/vector.h"
#include "emca/render/low_discrepancy.h"

namespace emca::render {

enum class SamplerKind : std::uint8_t {
    independent,  ///< uniform random numbers, one counter-based stream per (pixel, sample)
    sobol,        ///< Owen-scrambled Sobol points, scrambled and shuffled anew in every pixel and dimension
};

/// "independent" or "sobol".
const char* name(SamplerKind kind);

/// The random numbers of one path, addressed by (pixel, sample index, dimension): any number can be had again without
/// those before it, and more samples per pixel extend the set and change none. A dimension is one call, of next1D or
/// next2D. A plain value for one thread; no virtual call and no table per number.
class Sampler {
  public:
    Sampler(SamplerKind kind, std::uint64_t masterSeed)
        : seeds_(masterSeed), pixelSeed_(seeds_.seed(pixel_)), kind_(kind) {}

    /// Begins a sample at dimension 0.
    void start(Pixel pixel, std::uint32_t sample) {
        if (pixel != pixel_) {
            pixel_ = pixel;
            pixelSeed_ = seeds_.seed(pixel);
        }
        stream_ = kind_ == SamplerKind::sobol ? pixelSeed_ : SeedMap::seedOfSample(pixelSeed_, sample);
        sample_ = sample;
        dimension_ = 0;
    }

    /// Jumps, so that the same decision always reads the same dimension, whatever was skipped before it.
    void setDimension(std::uint32_t dimension) { dimension_ = dimension; }

    /// In [0, 1 - 2^-24].
    float next1D() {
        const std::uint64_t bits = nextBits();
        if (kind_ == SamplerKind::independent) return unitFloat(static_cast<std::uint32_t>(bits >> 32));
        const std::uint32_t index = owenScramble(sample_, static_cast<std::uint32_t>(bits));
        return unitFloat(scrambledSobol0(index, static_cast<std::uint32_t>(bits >> 32)));
    }

    /// Both in [0, 1 - 2^-24].
    Vec2f next2D() {
        const std::uint64_t bits = nextBits();
        if (kind_ == SamplerKind::independent) {
            return {unitFloat(static_cast<std::uint32_t>(bits >> 32)), unitFloat(static_cast<std::uint32_t>(bits))};
        }
        const std::uint32_t index = owenScramble(sample_, static_cast<std::uint32_t>(bits));
        const auto second = static_cast<std::uint32_t>(mix64(bits) >> 32);
        return {unitFloat(scrambledSobol0(index, static_cast<std::uint32_t>(bits >> 32))),
                unitFloat(scrambledSobol1(index, second))};
    }

  private:
    /// SplitMix64 with the dimension as its counter (Steele, Lea, Flood 2014).
    std::uint64_t nextBits() { return mix64(stream_ + ++dimension_ * kGolden64); }

    SeedMap seeds_;
    Pixel pixel_;
    std::uint64_t pixelSeed_;      ///< of pixel_
    std::uint64_t stream_ = 0;     ///< of this sample (independent) or of this pixel (sobol)
    std::uint64_t dimension_ = 0;
    std::uint32_t sample_ = 0;
    SamplerKind kind_;
};

}  // namespace emca::render
