#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "chunks.h"
#include "emca/protocol/frame.h"
#include "kept_surfaces.h"
#include "service.h"
#include "surface_collection.h"

namespace emca {

namespace {

/// The descriptions of the layers that a request names, each once.
Result<std::vector<LayerDescription>> namedLayers(const std::vector<std::string>& names, const std::vector<LayerDescription>& known) {
    std::vector<LayerDescription> chosen;
    for (const std::string& name : names) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& layer) { return layer.name == name; });
        if (found == known.end()) {
            return Error{ErrorCode::invalidArgument, "Surface layer \"" + name.substr(0, 100) + "\" was asked for, but this renderer has " +
                                                         quotedList(known) + "."};
        }
        if (std::find(chosen.begin(), chosen.end(), *found) == chosen.end()) chosen.push_back(*found);
    }
    return chosen;
}

Error notOffered() { return {ErrorCode::notSupported, "This renderer collects no surface layers: ask for the image without them."}; }
Error tooMany(std::size_t names) {
    return {ErrorCode::tooLarge, std::to_string(names) + " surface layers were asked for, but an answer holds at most " +
                                     std::to_string(protocol::kMaximumSurfaceLayers) + "."};
}

}  // namespace

Result<void> checkLayers(const std::vector<LayerDescription>& layers) {
    const auto refuse = [](const std::string& what) {
        return Error{ErrorCode::rendererFailed, "The renderer announces surface layers that cannot be: " + what + "."};
    };
    if (layers.size() > protocol::kMaximumSurfaceLayers) return refuse(std::to_string(layers.size()) + " of them");
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (layers[i].name.empty()) return refuse("one has no name");
        if (layers[i].kind > LayerKind::density) return refuse("\"" + layers[i].name + "\" is of no kind");
        for (std::size_t j = 0; j < i; ++j) {
            if (layers[j].name == layers[i].name) return refuse("two are called \"" + layers[i].name + "\"");
        }
    }
    return {};
}

Result<std::unique_ptr<SurfaceCollection>> Service::collectionFor(const protocol::RenderRequest& asked) {
    if (asked.layers.empty()) return std::unique_ptr<SurfaceCollection>();
    if (layers_.empty()) return notOffered();
    if (asked.layers.size() > protocol::kMaximumSurfaceLayers) return tooMany(asked.layers.size());
    auto chosen = namedLayers(asked.layers, layers_);
    if (!chosen) return chosen.error();
    SurfaceOptions options;
    options.budgetBytes = asked.surfaceBudget != 0 ? static_cast<std::size_t>(asked.surfaceBudget) : options_.surfaceBudget;
    if (options.budgetBytes > options_.maximumSurfaceBudget) {
        return Error{ErrorCode::tooLarge, std::to_string(options.budgetBytes) + " bytes for surface layers were asked for, but this server allows at most " +
                                              std::to_string(options_.maximumSurfaceBudget) + "."};
    }
    auto meshes = surfaceMeshes();
    if (!meshes) return meshes.error();
    auto collection = std::make_unique<SurfaceCollection>(std::move(meshes).value(), options);
    for (LayerDescription& layer : *chosen) {
        if (auto added = collection->recorder.addLayer(std::move(layer)); !added) return added.error();
    }
    return collection;
}

Result<std::shared_ptr<const std::vector<Mesh>>> Service::surfaceMeshes() {
    const std::lock_guard lock(surfaceMeshesMutex_);
    if (!surfaceMeshes_) {
        auto asked = meshes();
        if (!asked) return asked;
        surfaceMeshes_ = std::move(asked).value();
    }
    return surfaceMeshes_;
}

Result<std::shared_ptr<KeptSurface>> Service::finished(SurfaceCollection& collection) const {
    auto kept = std::make_shared<KeptSurface>();
    kept->field = collection.recorder.finish();
    for (const Mesh& mesh : *collection.meshes) kept->triangleCounts.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    if (kept->field.faceCount() > protocol::kMaximumSurfaceFaces) {
        return Error{ErrorCode::tooLarge, "The surface layers have " + std::to_string(kept->field.faceCount()) +
                                              " faces, more than can be sent: ask for a smaller budget."};
    }
    return kept;
}

Result<ClientPort::Source> Service::surfaceAnswer(const protocol::SurfaceRequest& asked) const {
    if (layers_.empty()) return notOffered();
    if (asked.layers.size() > protocol::kMaximumSurfaceLayers) return tooMany(asked.layers.size());
    auto kept = surfaces_.find(asked);
    if (!kept) return kept.error();
    auto layers = chooseLayers((*kept)->field, asked.layers);
    if (!layers) return layers.error();
    return surfaceChunks(std::move(kept).value(), std::move(layers).value(), chunkBytes(asked.maximumChunkBytes));
}

bool Service::answerAtOnce(const std::shared_ptr<Request>& request) const {
    const auto finish = [&](protocol::Body body) { request->client->finish(*request, std::move(body)); };
    if (const auto* asked = std::get_if<protocol::SurfaceRequest>(&request->body)) {
        auto source = surfaceAnswer(*asked);
        if (source) {
            request->client->stream(*request, std::move(source).value());
        } else {
            finish(protocol::Failure{source.error()});
        }
        return true;
    }
    auto answer = immediately(request->body);
    if (answer) finish(std::move(*answer));
    return answer.has_value();
}

}  // namespace emca
