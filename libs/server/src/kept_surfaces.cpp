#include "kept_surfaces.h"

#include <algorithm>
#include <utility>

#include "emca/protocol/cut.h"
#include "image_store.h"

namespace emca {

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
    const std::shared_ptr<const SurfaceField> field(surface, &surface->field);
    protocol::SurfaceCutter whole(field, surface->triangleCounts, std::move(layers), chunkBytes);
    return [cutter = std::move(whole), id = surface->renderId, announced = false]() mutable -> std::optional<protocol::Body> {
        if (std::exchange(announced, true)) return cutter.next();
        return cutter.announcement(id);
    };
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
