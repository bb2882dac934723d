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
        PathTally::intersection({at.mesh, at.face, at.position, at.barycentrics});
        PathTally::throughput(throughput);
    }
    void nextEvent(const EmitterSample& light);
};

}  // namespace emca::render
