#pragma once

#include <array>
#include <cstddef>

#include "bsdfs/microfacets.h"

namespace emca::render {

/// Share of the light from one direction that a rough dielectric boundary lets through, in any direction, by one
/// scattering event: the transmission albedo of the microfacet model. Tabulated once per material.
class RoughTransmittance {
  public:
    /// \param facets  isotropic
    /// \param eta     n(far side) / n(side of the light)
    RoughTransmittance(const Microfacets& facets, float eta);

    /// \param cosTheta  in [0, 1]
    float operator()(float cosTheta) const;
    /// Share of uniform diffuse light: 2 int_0^1 T(cos) cos dcos.
    float diffuse() const { return diffuse_; }

  private:
    static constexpr std::size_t kSteps = 128;
    std::array<float, kSteps + 1> table_;  ///< at cos theta = (i / kSteps)^2, since it rises steeply from grazing
    float diffuse_ = 0;
};

}  // namespace emca::render
