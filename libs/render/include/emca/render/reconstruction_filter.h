#pragma once

#include <cstdint>

#include "emca/core/vector.h"
#include "emca/render/distribution.h"

namespace emca::render {

enum class FilterKind : std::uint8_t { box, tent, gaussian };

/// "box", "tent" or "gaussian".
const char* name(FilterKind kind);

/// Reconstruction filter, honoured by importance sampling: the place of a sample relative to the centre of its pixel
/// has the filter as its density, and a pixel is the plain mean of its own samples (Ernst, Stamminger and Greiner,
/// "Filter Importance Sampling", 2006). A pixel then depends on no neighbour, as its replay must not.
class ReconstructionFilter {
  public:
    ReconstructionFilter() : ReconstructionFilter(FilterKind::box, 0.5f) {}
    static ReconstructionFilter box(float radius = 0.5f) { return {FilterKind::box, radius}; }
    static ReconstructionFilter tent(float radius = 1.f) { return {FilterKind::tent, radius}; }
    /// Truncated at four standard deviations and lowered by its value there, as Mitsuba's.
    static ReconstructionFilter gaussian(float standardDeviation = 0.5f);

    FilterKind kind() const { return kind_; }
    float radius() const { return radius_; }  ///< pixels; zero beyond, per axis

    /// Offset from the pixel's centre, in pixels. \param u in [0, 1)^2
    Vec2f sample(Vec2f u) const { return {sample(u.x), sample(u.y)}; }
    /// Density of offsets, per square pixel.
    float pdf(Vec2f offset) const { return pdf(offset.x) * pdf(offset.y); }

  private:
    ReconstructionFilter(FilterKind kind, float radius) : kind_(kind), radius_(radius) {}
    float sample(float u) const { return kind_ == FilterKind::box ? radius_ * (2.f * u - 1.f) : sampleShaped(u); }
    float sampleShaped(float u) const;
    float pdf(float offset) const;

    FilterKind kind_;
    float radius_;
    float standardDeviation_ = 0;
    float normalisation_ = 1;      ///< gaussian: 1 / integral
    Distribution1D bins_;          ///< gaussian: share of each of many equal pieces of [-radius, radius]
};

}  // namespace emca::render
