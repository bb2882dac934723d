#pragma once

#include <cstdint>
#include <memory>

#include "lajolla_headers.h"

namespace emca::lajolla {

/// lajolla's random numbers, started anew for every sample of every pixel. Belongs to one thread.
class Random {
  public:
    Random();
    ~Random();
    Random(const Random&) = delete;
    Random& operator=(const Random&) = delete;

    void seed(std::uint64_t seed);
    /// In [0, 1).
    Real next();
    /// What integrators of lajolla take.
    pcg32_state& state() { return *state_; }

  private:
    std::unique_ptr<pcg32_state> state_;
};

}  // namespace emca::lajolla
