#pragma once

#include <pcg32.h>

#include "nori_headers.h"

namespace emca::nori_adapter {

/// Independent random numbers that begin anew with each sample of each pixel: what replaying a pixel alone needs. Tells the
/// observer of its thread what it draws.
class SeededSampler final : public nori::Sampler {
  public:
    explicit SeededSampler(std::size_t samples) { m_sampleCount = samples; }

    void seed(std::uint64_t seed) { random_.seed(seed, 1); }

    std::unique_ptr<nori::Sampler> clone() const override { return std::make_unique<SeededSampler>(*this); }
    void prepare(const nori::ImageBlock&) override {}
    void generate() override {}
    void advance() override {}
    float next1D() override;
    nori::Point2f next2D() override;
    std::string toString() const override { return "SeededSampler[]"; }

  private:
    pcg32 random_;
};

}  // namespace emca::nori_adapter
