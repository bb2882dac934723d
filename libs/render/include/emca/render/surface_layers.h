#pragma once

#include "emca/recorder/path_layers.h"
#include "emca/render/emitter.h"
#include "emca/render/interaction.h"

namespace emca::render {

/// What one thread's paths add to the path layers, in the types of this renderer.
class SurfaceTally : public PathTally {
  public:
    using PathTally::PathTally;

    /// \param throughput  of the camera path up to here
    void intersection(const SurfaceInteraction& at, Color throughput) {
        place(at.mesh, at.face, at.barycentrics.x, at.barycentrics.y, at.position);
        PathTally::throughput(throughput);
    }
    void nextEvent(const EmitterSample& light);

  private:
    /// Numbers by value, into a function of its own: in the integrator the compiler would load pairs of what was just
    /// written one by one, which waits until that has reached the cache.
    void place(std::int32_t mesh, std::int32_t face, float u, float v, const Vec3f& position);
};

}  // namespace emca::render
