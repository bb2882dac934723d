#include "emca/protocol/cut.h"

#include <algorithm>
#include <utility>

namespace emca::protocol {

namespace {

void take(std::size_t& room, std::size_t bytes) { room -= std::min(room, bytes); }

}  // namespace

SceneCutter::SceneCutter(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t bytes)
    : meshes_(std::move(meshes)), chunkBytes_(bytes) {
    for (const Mesh& mesh : *meshes_) {
        vertices_ += mesh.positions.size();
        triangles_ += mesh.triangles.size();
    }
}

std::optional<SceneChunk> SceneCutter::next() {
    if (finished_) return std::nullopt;
    SceneChunk chunk;
    chunk.meshCount = static_cast<std::uint32_t>(meshes_->size());
    chunk.vertexCount = vertices_;
    chunk.triangleCount = triangles_;
    std::size_t room = chunkBytes_;
    while (mesh_ < meshes_->size() && room > 0) chunk.parts.push_back(nextPart(room));
    chunk.last = finished_ = mesh_ == meshes_->size();
    return chunk;
}

/// As much of the current mesh as fits; at least one vertex or triangle, if there is one.
MeshPart SceneCutter::nextPart(std::size_t& room) {
    const Mesh& mesh = (*meshes_)[mesh_];
    MeshPart part;
    part.mesh = static_cast<std::uint32_t>(mesh_);
    part.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
    part.triangleCount = static_cast<std::uint32_t>(mesh.triangles.size());
    part.firstVertex = static_cast<std::uint32_t>(vertex_);
    part.firstTriangle = static_cast<std::uint32_t>(triangle_);
    if (vertex_ == 0 && triangle_ == 0) {
        part.name = mesh.name;
        part.material = mesh.material;
        part.diffuse = mesh.diffuse;
        part.emission = mesh.emission;
    }
    take(room, part.name.size() + part.material.size() + 128);
    part.positions = slice(mesh.positions, vertex_, room);
    if (vertex_ == mesh.positions.size()) part.triangles = slice(mesh.triangles, triangle_, room);
    if (vertex_ == mesh.positions.size() && triangle_ == mesh.triangles.size()) {
        ++mesh_;
        vertex_ = triangle_ = 0;
    }
    return part;
}

template <typename T>
SharedArray<T> SceneCutter::slice(const std::vector<T>& values, std::size_t& position, std::size_t& room) {
    const std::size_t count = std::min(values.size() - position, room / sizeof(T) + 1);
    SharedArray<T> result(meshes_, values.data() + position, count);
    position += count;
    take(room, count * sizeof(T));
    return result;
}

SurfaceCutter::SurfaceCutter(std::shared_ptr<const SurfaceField> field, std::vector<std::uint32_t> triangleCounts,
                             std::vector<std::size_t> layers, std::size_t bytes)
    : field_(std::move(field)), triangleCounts_(std::move(triangleCounts)), layers_(std::move(layers)), chunkBytes_(bytes) {
    arrays_.push_back(field_->points);
    for (const std::size_t layer : layers_) arrays_.push_back(field_->layers[layer].values);
}

SurfaceResult SurfaceCutter::announcement(std::uint64_t renderId) const {
    SurfaceResult result;
    result.renderId = renderId;
    for (const std::size_t i : layers_) {
        const SurfaceLayerData& layer = field_->layers[i];
        result.layers.push_back({layer.description, layer.samples, layer.total});
    }
    result.counts = field_->counts;
    result.meshCount = static_cast<std::uint32_t>(field_->meshes.size());
    result.faceCount = field_->faceCount();
    for (const SurfaceMesh& mesh : field_->meshes) result.topologyBytes += mesh.subdivision.bits.size();
    return result;
}

std::optional<SurfaceChunk> SurfaceCutter::next() {
    if (finished_) return std::nullopt;
    SurfaceChunk chunk;
    std::size_t room = chunkBytes_;
    while (mesh_ < field_->meshes.size() && room > 0) chunk.meshes.push_back(nextMeshPart(room));
    const bool meshesSent = mesh_ == field_->meshes.size();
    while (meshesSent && array_ < arrays_.size() && room > 0) chunk.arrays.push_back(nextArrayPart(room));
    chunk.last = finished_ = meshesSent && array_ == arrays_.size();
    return chunk;
}

SurfaceMeshPart SurfaceCutter::nextMeshPart(std::size_t& room) {
    const SurfaceMesh& mesh = field_->meshes[mesh_];
    const auto& bits = mesh.subdivision.bits;
    take(room, 64);
    const std::size_t count = std::min(bits.size() - position_, room + 1);
    SurfaceMeshPart part;
    part.mesh = static_cast<std::uint32_t>(mesh_);
    part.triangleCount = triangleCounts_[mesh_];
    part.faceCount = mesh.faceCount;
    part.byteCount = static_cast<std::uint32_t>(bits.size());
    part.firstByte = static_cast<std::uint32_t>(position_);
    part.bits = SharedArray<std::uint8_t>(field_, bits.data() + position_, count);
    take(room, count);
    advance(count, bits.size(), mesh_);
    return part;
}

SurfaceArrayPart SurfaceCutter::nextArrayPart(std::size_t& room) {
    const SharedArray<float>& values = arrays_[array_];
    take(room, 64);
    const std::size_t count = std::min(values.size() - position_, room / sizeof(float) + 1);
    SurfaceArrayPart part;
    part.array = static_cast<std::uint32_t>(array_);
    part.first = position_;
    part.values = SharedArray<float>(field_, values.data() + position_, count);
    take(room, count * sizeof(float));
    advance(count, values.size(), array_);
    return part;
}

void SurfaceCutter::advance(std::size_t count, std::size_t whole, std::size_t& list) {
    position_ += count;
    if (position_ < whole) return;
    position_ = 0;
    ++list;
}

}  // namespace emca::protocol
