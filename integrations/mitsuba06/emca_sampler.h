#pragma once

#include <cstdint>

#include <mitsuba/render/sampler.h>

#include "emca/core/seed_map.h"
#include "mitsuba_headers.h"

namespace emca::mitsuba06 {

/// "emcasampler": independent random numbers whose sequence depends on the pixel, the sample's index and the seed
/// alone, so that any sample of any pixel can be drawn again, by any thread. More samples per pixel extend the sequence
/// of samples and change none.
///
/// Properties: sampleCount (integer, 4), seed (integer, 0).
class EmcaSampler final : public mts::Sampler {
  public:
    explicit EmcaSampler(const mts::Properties& properties);

    mts::ref<mts::Sampler> clone() override;
    void generate(const mts::Point2i& pixel) override;
    void advance() override;
    void setSampleIndex(std::size_t index) override;
    mts::Float next1D() override;
    mts::Point2 next2D() override;
    std::string toString() const override;

    const mts::Class* getClass() const override;
    static mts::Class* m_theClass;

  private:
    void fillArrays();

    SeedMap seeds_;
    Pixel pixel_;
    std::uint64_t state_ = 0;
};

}  // namespace emca::mitsuba06
