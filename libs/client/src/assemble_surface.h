#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/surface_field.h"
#include "emca/protocol/messages.h"

namespace emca::client {

/// Puts surface layers together from their announcement and chunks. Memory grows with what arrives, never with what is
/// announced.
class SurfaceAssembler {
  public:
    // Errors: protocolViolation (messages that do not fit together, or sizes beyond the limits of protocol/frame.h).
    Result<void> begin(const protocol::SurfaceResult& result);
    Result<void> add(const protocol::SurfaceChunk& chunk);
    bool complete() const { return complete_; }
    double fraction() const;   ///< in [0, 1]

    /// The whole field, which obeys every rule of emca::validate().
    /// \param triangleCounts  of the scene's meshes, where they are known
    /// Errors: protocolViolation.
    Result<SurfaceField> take(const std::optional<std::vector<std::uint32_t>>& triangleCounts);

  private:
    Result<void> addPart(const protocol::SurfaceMeshPart& part);
    Result<void> addMesh(const protocol::SurfaceMeshPart& part);
    Result<void> addPart(const protocol::SurfaceArrayPart& part);
    Result<void> checkMesh() const;
    bool meshesAreWhole() const;
    std::uint64_t floatsOf(std::size_t array) const;

    SurfaceField field_;
    std::vector<std::uint32_t> triangleCounts_;           // per mesh so far, as the server says
    std::vector<std::vector<float>> arrays_;              // the points, then the layers; one more than is whole
    std::uint64_t faceCount_ = 0, topologyBytes_ = 0;     // announced
    std::uint32_t meshCount_ = 0, byteCount_ = 0;         // announced; of the last mesh
    std::uint64_t bytes_ = 0;                             // of subdivisions and arrays, so far
    bool begun_ = false, complete_ = false;
};

}  // namespace emca::client
