#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/surface_field.h"
#include "emca/protocol/messages.h"

/// Large things in pieces, for the wire and for files. Nothing is copied: pieces look into what they are cut from and
/// keep it alive.
namespace emca::protocol {

/// Meshes as SceneChunks; an empty scene is one empty chunk.
class SceneCutter {
  public:
    /// \param bytes  wanted size of a chunk
    SceneCutter(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t bytes);
    /// The next chunk, nothing after the last.
    std::optional<SceneChunk> next();

  private:
    MeshPart nextPart(std::size_t& room);
    template <typename T>
    SharedArray<T> slice(const std::vector<T>& values, std::size_t& position, std::size_t& room);

    std::shared_ptr<const std::vector<Mesh>> meshes_;
    std::size_t chunkBytes_;
    std::uint64_t vertices_ = 0, triangles_ = 0;
    std::size_t mesh_ = 0, vertex_ = 0, triangle_ = 0;
    bool finished_ = false;
};

/// Surface layers as an announcement and SurfaceChunks.
class SurfaceCutter {
  public:
    /// \param triangleCounts  of the scene's meshes, before they were divided: one for each of the field
    /// \param layers          positions of the layers wanted, of the field's
    SurfaceCutter(std::shared_ptr<const SurfaceField> field, std::vector<std::uint32_t> triangleCounts,
                  std::vector<std::size_t> layers, std::size_t bytes);
    SurfaceResult announcement(std::uint64_t renderId) const;
    std::optional<SurfaceChunk> next();

  private:
    SurfaceMeshPart nextMeshPart(std::size_t& room);
    SurfaceArrayPart nextArrayPart(std::size_t& room);
    void advance(std::size_t count, std::size_t whole, std::size_t& list);

    std::shared_ptr<const SurfaceField> field_;
    std::vector<std::uint32_t> triangleCounts_;
    std::vector<std::size_t> layers_;
    std::vector<SharedArray<float>> arrays_;
    std::size_t chunkBytes_;
    std::size_t mesh_ = 0, array_ = 0, position_ = 0;
    bool finished_ = false;
};

}  // namespace emca::protocol
