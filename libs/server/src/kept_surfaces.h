#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "emca/core/surface_field.h"
#include "emca/protocol/messages.h"
#include "request.h"

namespace emca {

/// The surface layers of a finished render.
struct KeptSurface {
    std::uint64_t renderId = 0;
    protocol::Settings settings;                 ///< complete
    std::vector<std::uint32_t> triangleCounts;   ///< of the scene's meshes, before they were divided
    SurfaceField field;
};

/// The collections of the newest renders that had layers; whatever is traced or rendered without layers meanwhile, they
/// stay. Thread-safe.
class KeptSurfaces {
  public:
    explicit KeptSurfaces(std::size_t most);

    /// The oldest is forgotten.
    void add(std::shared_ptr<const KeptSurface> surface);
    std::shared_ptr<const KeptSurface> newest() const;   ///< null if none
    /// The one that a request names, or the newest that matches. Errors: invalidArgument, saying what there is.
    Result<std::shared_ptr<const KeptSurface>> find(const protocol::SurfaceRequest& asked) const;

  private:
    mutable std::mutex mutex_;
    std::deque<std::shared_ptr<const KeptSurface>> kept_;  // oldest first
    std::size_t most_;
};

/// How the layers of a field travel in lists.
std::vector<protocol::Layer> collectedLayers(const SurfaceField& field);

/// Positions of the named layers in the field, each once; of all of them if no name is given.
/// Errors: invalidArgument, listing the layers that there are.
Result<std::vector<std::size_t>> chooseLayers(const SurfaceField& field, const std::vector<std::string>& names);

/// A SurfaceResult for these layers, and SurfaceChunks of about `chunkBytes`.
ClientPort::Source surfaceChunks(std::shared_ptr<const KeptSurface> surface, std::vector<std::size_t> layers, std::size_t chunkBytes);

/// `"a", "b" and "c"`, for sentences; cut where it would become too long to read.
std::string quotedList(const std::vector<LayerDescription>& layers);

}  // namespace emca
