#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emca/recorder/surface_recorder.h"

namespace emca::detail {

/// Which refined faces of a mesh share an edge or a part of one; vertices at equal positions are one vertex.
class SurfaceNeighbours {
  public:
    /// None at all if the subdivision does not fit the mesh.
    SurfaceNeighbours(const SurfaceMeshView& mesh, const SurfaceSubdivision& subdivision, std::size_t faces);
    /// In no particular, but a fixed order; a face may be named more than once.
    std::span<const std::uint32_t> of(std::size_t face) const {
        return {list_.data() + begin_[face], list_.data() + begin_[face + 1]};
    }

  private:
    std::vector<std::uint64_t> begin_;
    std::vector<std::uint32_t> list_;
};

/// Gives every face without data (NaN in its first channel) the mean of its neighbours, from the border of the data
/// inwards; then lets the filled faces relax towards the mean of theirs, so that it does not show from where a value
/// came. Faces that are not connected to any data stay NaN.
void fillMeans(const SurfaceNeighbours& neighbours, std::span<float> values, std::uint32_t channels);

/// Whether fillDensities() has anything to do: the neighbours of a mesh cost more than all the rest of finish().
bool densitiesNeedFilling(std::span<const float> counts, std::span<const float> areas);

/// Spreads what was added to a face over neighbours where nothing arrived, as far as that can be chance; the total over
/// all faces stays the same.
///
/// \param sums    per face: what was added; on return what its density is to be computed from
/// \param counts  per face: number of samples, may be a fraction
/// \param areas   per face; those without area take no part
void fillDensities(const SurfaceNeighbours& neighbours, std::span<double> sums, std::span<const float> counts,
                   std::span<const float> areas);

}  // namespace emca::detail
