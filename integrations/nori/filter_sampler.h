#pragma once

#include <vector>

#include "nori_headers.h"

namespace emca::nori_adapter {

/// Places on the film with the density of a reconstruction filter, so that a pixel is the mean of its own samples and can be
/// replayed alone. Source: Ernst, Stamminger, Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray
/// Tracing 2006. Immutable.
class FilterSampler {
  public:
    explicit FilterSampler(const nori::ReconstructionFilter& filter);

    /// Pixels from the pixel's centre.
    struct Offset {
        float offset = 0;
        float weight = 1;  ///< filter over density; its mean is 1. Negative in negative lobes.
    };
    /// Along one axis; both are alike. \param u  in [0, 1)
    Offset sample(float u) const;

  private:
    float radius_ = 0;
    std::vector<float> cumulative_;  ///< of |filter| over equal steps, the last is 1
    std::vector<float> weights_;     ///< per step
};

}  // namespace emca::nori_adapter
