#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emca/client/connection.h"
#include "emca/protocol/messages.h"

namespace emca::client {

/// Puts a scene together from its chunks. Memory grows with what arrives, never with what is announced.
class SceneAssembler {
  public:
    /// Errors: protocolViolation (chunks that do not fit together).
    Result<void> add(const protocol::SceneChunk& chunk);
    bool complete() const { return complete_; }
    double fraction() const;   ///< by triangles, in [0, 1]
    std::vector<Mesh> take() { return std::move(meshes_); }
    /// Of a scene that will not be complete: its first meshes, as far as they are.
    std::vector<Mesh> takeWholeMeshes();

  private:
    Result<void> addPart(const protocol::MeshPart& part);
    Result<void> checkWhole();
    std::vector<Mesh> meshes_;
    std::uint32_t vertexCount_ = 0, triangleCount_ = 0;   // of the last mesh
    std::uint64_t triangles_ = 0, allTriangles_ = 0;
    bool complete_ = false;
};

/// Puts an image together from its rows.
class ImageAssembler {
  public:
    Result<void> begin(const protocol::RenderResult& result);
    Result<void> add(const protocol::ImageRows& rows);
    bool complete() const { return complete_; }
    Render take() { return std::move(render_); }

  private:
    Render render_;
    std::uint32_t width_ = 0, height_ = 0, nextRow_ = 0;
    bool begun_ = false, complete_ = false;
};

}  // namespace emca::client
