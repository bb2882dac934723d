#include "kept_surfaces.h"

#include <algorithm>

#include "image_store.h"

namespace emca {

namespace {

/// Cuts a field into chunks; arrays are looked at, never copied.
class SurfaceCutter {
  public:
    SurfaceCutter(std::shared_ptr<const KeptSurface> surface, std::vector<std::size_t> layers, std::size_t bytes)
        : surface_(std::move(surface)), layers_(std::move(layers)), chunkBytes_(bytes) {
        arrays_.push_back(field().points);
        for (const std::size_t layer : layers_) arrays_.push_back(field().layers[layer].values);
    }

    std::optional<protocol::Body> next() {
        if (!announced_) {
            announced_ = true;
            return announcement();
        }
        if (finished_) return std::nullopt;
        protocol::SurfaceChunk chunk;
        std::size_t room = chunkBytes_;
        while (mesh_ < field().meshes.size() && room > 0) chunk.meshes.push_back(nextMeshPart(room));
        const bool meshesSent = mesh_ == field().meshes.size();
        while (meshesSent && array_ < arrays_.size() && room > 0) chunk.arrays.push_back(nextArrayPart(room));
        chunk.last = finished_ = meshesSent && array_ == arrays_.size();
        return chunk;
    }

  private:
    const SurfaceField& field() const { return surface_->field; }

    protocol::SurfaceResult announcement() const {
        protocol::SurfaceResult result;
        result.renderId = surface_->renderId;
        const auto all = collectedLayers(field());
        for (const std::size_t layer : layers_) result.layers.push_back(all[layer]);
        result.counts = field().counts;
        result.meshCount = static_cast<std::uint32_t>(field().meshes.size());
        result.faceCount = field().faceCount();
        for (const SurfaceMesh& mesh : field().meshes) result.topologyBytes += mesh.subdivision.bits.size();
        return result;
    }

    protocol::SurfaceMeshPart nextMeshPart(std::size_t& room) {
        const SurfaceMesh& mesh = field().meshes[mesh_];
        const auto& bits = mesh.subdivision.bits;
        take(room, 64);
        const std::size_t count = std::min(bits.size() - position_, room + 1);
        protocol::SurfaceMeshPart part;
        part.mesh = static_cast<std::uint32_t>(mesh_);
        part.triangleCount = surface_->triangleCounts[mesh_];
        part.faceCount = mesh.faceCount;
        part.byteCount = static_cast<std::uint32_t>(bits.size());
        part.firstByte = static_cast<std::uint32_t>(position_);
        part.bits = SharedArray<std::uint8_t>(surface_, bits.data() + position_, count);
        take(room, count);
        advance(count, bits.size(), mesh_);
        return part;
    }

    protocol::SurfaceArrayPart nextArrayPart(std::size_t& room) {
        const SharedArray<float>& values = arrays_[array_];
        take(room, 64);
        const std::size_t count = std::min(values.size() - position_, room / sizeof(float) + 1);
        protocol::SurfaceArrayPart part;
        part.array = static_cast<std::uint32_t>(array_);
        part.first = position_;
        part.values = SharedArray<float>(surface_, values.data() + position_, count);
        take(room, count * sizeof(float));
        advance(count, values.size(), array_);
        return part;
    }

    void advance(std::size_t count, std::size_t whole, std::size_t& list) {
        position_ += count;
        if (position_ < whole) return;
        position_ = 0;
        ++list;
    }
    static void take(std::size_t& room, std::size_t bytes) { room -= std::min(room, bytes); }

    std::shared_ptr<const KeptSurface> surface_;
    std::vector<std::size_t> layers_;
    std::vector<SharedArray<float>> arrays_;
    std::size_t chunkBytes_;
    std::size_t mesh_ = 0, array_ = 0, position_ = 0;
    bool announced_ = false, finished_ = false;
};

}  // namespace

KeptSurfaces::KeptSurfaces(std::size_t most) : most_(std::max<std::size_t>(most, 1)) {}

void KeptSurfaces::add(std::shared_ptr<const KeptSurface> surface) {
    const std::lock_guard lock(mutex_);
    kept_.push_back(std::move(surface));
    while (kept_.size() > most_) kept_.pop_front();
}

std::shared_ptr<const KeptSurface> KeptSurfaces::newest() const {
    const std::lock_guard lock(mutex_);
    return kept_.empty() ? nullptr : kept_.back();
}

Result<std::shared_ptr<const KeptSurface>> KeptSurfaces::find(const protocol::SurfaceRequest& asked) const {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(kept_.rbegin(), kept_.rend(), [&](const auto& kept) {
        return asked.renderId != 0 ? kept->renderId == asked.renderId : matches(asked.settings, kept->settings);
    });
    if (found != kept_.rend()) return *found;
    if (kept_.empty()) {
        return Error{ErrorCode::invalidArgument, "Surface layers were asked for, but no image was rendered with layers yet: "
                                                 "name them when you render."};
    }
    std::string ids;
    for (const auto& kept : kept_) ids += (ids.empty() ? "" : ", ") + std::to_string(kept->renderId);
    return Error{ErrorCode::invalidArgument,
                 (asked.renderId != 0 ? "Surface layers of render " + std::to_string(asked.renderId) + " were asked for"
                                      : std::string("Surface layers of a render with certain settings were asked for")) +
                     ", but layers are kept of these renders only: " + ids + "."};
}

std::vector<protocol::Layer> collectedLayers(const SurfaceField& field) {
    std::vector<protocol::Layer> layers;
    for (const SurfaceLayerData& layer : field.layers) layers.push_back({layer.description, layer.samples, layer.total});
    return layers;
}

Result<std::vector<std::size_t>> chooseLayers(const SurfaceField& field, const std::vector<std::string>& names) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; names.empty() && i < field.layers.size(); ++i) chosen.push_back(i);
    for (const std::string& name : names) {
        const SurfaceLayerData* layer = field.find(name);
        if (!layer) {
            std::vector<LayerDescription> there;
            for (const SurfaceLayerData& other : field.layers) there.push_back(other.description);
            return Error{ErrorCode::invalidArgument, "Surface layer \"" + name.substr(0, 100) +
                                                         "\" was not collected in this render; there are " + quotedList(there) + "."};
        }
        const auto index = static_cast<std::size_t>(layer - field.layers.data());
        if (std::find(chosen.begin(), chosen.end(), index) == chosen.end()) chosen.push_back(index);
    }
    return chosen;
}

ClientPort::Source surfaceChunks(std::shared_ptr<const KeptSurface> surface, std::vector<std::size_t> layers, std::size_t chunkBytes) {
    return [cutter = SurfaceCutter(std::move(surface), std::move(layers), chunkBytes)]() mutable { return cutter.next(); };
}

std::string quotedList(const std::vector<LayerDescription>& layers) {
    constexpr std::size_t kMost = 40;
    std::string text;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (i == kMost) return text + " and " + std::to_string(layers.size() - kMost) + " more";
        text += (i == 0 ? "\"" : i + 1 == layers.size() ? " and \"" : ", \"") + layers[i].name + "\"";
    }
    return text;
}

}  // namespace emca
