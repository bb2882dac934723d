#include "emca_sampler.h"

namespace emca::mitsuba06 {

namespace {

/// SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014): a counter, mixed.
std::uint64_t nextBits(std::uint64_t& state) { return mix64(state += kGolden64); }

/// In [0, 1).
mts::Float nextNumber(std::uint64_t& state) {
    if constexpr (sizeof(mts::Float) == sizeof(float))
        return static_cast<mts::Float>(static_cast<float>(nextBits(state) >> 40) * 0x1p-24f);
    else
        return static_cast<mts::Float>(static_cast<double>(nextBits(state) >> 11) * 0x1p-53);
}

}  // namespace

EmcaSampler::EmcaSampler(const mts::Properties& properties)
    : mts::Sampler(properties), seeds_(static_cast<std::uint64_t>(properties.getLong("seed", 0))) {
    m_sampleCount = properties.getSize("sampleCount", 4);
    m_dimension1DArray = m_dimension2DArray = 0;
    setSampleIndex(0);
}

mts::ref<mts::Sampler> EmcaSampler::clone() {
    mts::Properties properties(getProperties());
    mts::ref<EmcaSampler> copy = new EmcaSampler(properties);
    for (const std::size_t size : m_req1D) copy->request1DArray(size);
    for (const std::size_t size : m_req2D) copy->request2DArray(size);
    copy->pixel_ = pixel_;
    copy->setSampleIndex(m_sampleIndex);
    return copy.get();
}

void EmcaSampler::generate(const mts::Point2i& pixel) {
    pixel_ = {static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y)};
    fillArrays();
    setSampleIndex(0);
}

void EmcaSampler::fillArrays() {
    for (std::size_t sample = 0; sample < m_sampleCount && !(m_req1D.empty() && m_req2D.empty()); ++sample) {
        std::uint64_t state = ~seeds_.seed(pixel_, sample);  // not the sequence that next1D() gives
        for (std::size_t i = 0; i < m_req1D.size(); ++i) {
            for (std::size_t k = 0; k < m_req1D[i]; ++k)
                m_sampleArrays1D[i][sample * m_req1D[i] + k] = nextNumber(state);
        }
        for (std::size_t i = 0; i < m_req2D.size(); ++i) {
            for (std::size_t k = 0; k < m_req2D[i]; ++k) {
                const mts::Float x = nextNumber(state), y = nextNumber(state);
                m_sampleArrays2D[i][sample * m_req2D[i] + k] = mts::Point2(x, y);
            }
        }
    }
}

void EmcaSampler::advance() { setSampleIndex(m_sampleIndex + 1); }

void EmcaSampler::setSampleIndex(std::size_t index) {
    mts::Sampler::setSampleIndex(index);
    state_ = seeds_.seed(pixel_, index);
}

mts::Float EmcaSampler::next1D() { return nextNumber(state_); }

mts::Point2 EmcaSampler::next2D() {
    const mts::Float x = nextNumber(state_), y = nextNumber(state_);
    return {x, y};
}

std::string EmcaSampler::toString() const { return "EmcaSampler[sampleCount = " + std::to_string(m_sampleCount) + "]"; }

using mts::Class;
MTS_IMPLEMENT_CLASS(EmcaSampler, false, Sampler)

}  // namespace emca::mitsuba06
