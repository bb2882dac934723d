#include "chunks.h"

#include <algorithm>

#include "emca/protocol/frame.h"

namespace emca {

namespace {

/// Where the next chunk begins.
class SceneCutter {
  public:
    SceneCutter(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t bytes)
        : meshes_(std::move(meshes)), chunkBytes_(bytes) {
        for (const Mesh& mesh : *meshes_) {
            vertices_ += mesh.positions.size();
            triangles_ += mesh.triangles.size();
        }
    }

    std::optional<protocol::Body> next() {
        if (finished_) return std::nullopt;
        protocol::SceneChunk chunk;
        chunk.meshCount = static_cast<std::uint32_t>(meshes_->size());
        chunk.vertexCount = vertices_;
        chunk.triangleCount = triangles_;
        std::size_t room = chunkBytes_;
        while (mesh_ < meshes_->size() && room > 0) chunk.parts.push_back(nextPart(room));
        chunk.last = finished_ = mesh_ == meshes_->size();
        return chunk;
    }

  private:
    /// As much of the current mesh as fits; at least one vertex or triangle, if there is one.
    protocol::MeshPart nextPart(std::size_t& room) {
        const Mesh& mesh = (*meshes_)[mesh_];
        protocol::MeshPart part;
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
    SharedArray<T> slice(const std::vector<T>& values, std::size_t& position, std::size_t& room) {
        const std::size_t count = std::min(values.size() - position, room / sizeof(T) + 1);
        SharedArray<T> result(meshes_, values.data() + position, count);
        position += count;
        take(room, count * sizeof(T));
        return result;
    }

    static void take(std::size_t& room, std::size_t bytes) { room -= std::min(room, bytes); }

    std::shared_ptr<const std::vector<Mesh>> meshes_;
    std::size_t chunkBytes_;
    std::uint64_t vertices_ = 0, triangles_ = 0;
    std::size_t mesh_ = 0, vertex_ = 0, triangle_ = 0;
    bool finished_ = false;
};

protocol::ImageRows rowsOf(const std::shared_ptr<const KeptImage>& kept, std::uint32_t first, std::uint32_t count) {
    const RenderedImage& image = kept->image;
    const std::size_t width = image.color.width();
    const std::size_t begin = first * width, pixels = count * width;
    const auto colors = [&](const Image& source) {
        // Three floats per pixel lie in memory as a Color does.
        static_assert(sizeof(Color) == 3 * sizeof(float));
        return SharedArray<Color>(kept, reinterpret_cast<const Color*>(source.data()) + begin, pixels);
    };
    protocol::ImageRows rows;
    rows.firstRow = first;
    rows.rowCount = count;
    rows.colors = colors(image.color);
    rows.samples = SharedArray<float>(kept, image.samples.data() + begin, pixels);
    if (!image.variance.empty()) rows.variance = colors(image.variance);
    rows.last = first + count == image.color.height();
    return rows;
}

}  // namespace

std::size_t chunkBytes(std::uint32_t asked) {
    if (asked == 0) return protocol::kChunkBytes;
    return std::clamp<std::size_t>(asked, 4u << 10, 64u << 20);
}

ClientPort::Source sceneChunks(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t bytes) {
    return [cutter = SceneCutter(std::move(meshes), bytes)]() mutable { return cutter.next(); };
}

ClientPort::Source imageRows(std::shared_ptr<const KeptImage> kept, std::size_t bytes) {
    const std::size_t rowBytes = kept->image.color.width() * (2 * sizeof(Color) + sizeof(float));
    const auto step = static_cast<std::uint32_t>(std::max<std::size_t>(1, bytes / std::max<std::size_t>(rowBytes, 1)));
    return [kept = std::move(kept), step, row = 0u]() mutable -> std::optional<protocol::Body> {
        const std::uint32_t height = kept->image.color.height();
        if (row >= height) return std::nullopt;
        const std::uint32_t count = std::min(step, height - row);
        auto rows = rowsOf(kept, row, count);
        row += count;
        return rows;
    };
}

}  // namespace emca
