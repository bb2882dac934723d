#include "emca/core/surface_field.h"

#include <algorithm>
#include <limits>

namespace emca {
namespace {

Error violation(std::string what) {
    return {ErrorCode::protocolViolation, "The surface layers do not fit together: " + std::move(what) + "."};
}

/// The subdivision of every mesh, and where its faces are in the value arrays.
Result<void> validateMeshes(const SurfaceField& field, std::span<const std::uint32_t> triangleCounts) {
    if (field.meshes.size() != triangleCounts.size())
        return violation("the scene has " + std::to_string(triangleCounts.size()) + " meshes, the layers are for " +
                         std::to_string(field.meshes.size()));
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < triangleCounts.size(); ++i) {
        const SurfaceMesh& mesh = field.meshes[i];
        const std::string which = "mesh " + std::to_string(i);
        if (mesh.firstFace != next)
            return violation(which + " begins at face " + std::to_string(mesh.firstFace) + " instead of " +
                             std::to_string(next));
        if (mesh.faceCount == 0) {
            if (!mesh.subdivision.bits.empty()) return violation(which + " has no values, but is divided");
            continue;
        }
        const auto faces = refinedFaceCount(triangleCounts[i], mesh.subdivision);
        if (!faces) return faces.error();
        if (*faces != mesh.faceCount)
            return violation(which + " says that it has " + std::to_string(mesh.faceCount) + " faces, but has " +
                             std::to_string(*faces));
        next += mesh.faceCount;
    }
    return {};
}

}  // namespace

const char* name(LayerKind kind) {
    switch (kind) {
        case LayerKind::mean: return "mean";
        case LayerKind::meanColor: return "mean color";
        case LayerKind::sum: return "sum";
        case LayerKind::density: return "density";
    }
    return "unknown";
}

const SurfaceLayerData* SurfaceField::find(std::string_view layer) const {
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const SurfaceLayerData& data) { return data.description.name == layer; });
    return found == layers.end() ? nullptr : &*found;
}

float SurfaceField::value(const SurfaceLayerData& layer, std::size_t mesh, std::uint32_t refinedFace,
                          std::uint32_t channel) const {
    const LayerKind kind = layer.description.kind;
    const bool isMean = kind == LayerKind::mean || kind == LayerKind::meanColor;
    const float none = isMean ? std::numeric_limits<float>::quiet_NaN() : 0.f;
    if (mesh >= meshes.size() || refinedFace >= meshes[mesh].faceCount || channel >= channelCount(kind)) return none;
    const std::uint64_t i = (meshes[mesh].firstFace + refinedFace) * channelCount(kind) + channel;
    return i < layer.values.size() ? layer.values[i] : none;
}

Result<void> validate(const SurfaceField& field, std::span<const Mesh> meshes) {
    std::vector<std::uint32_t> triangleCounts;
    for (const Mesh& mesh : meshes) triangleCounts.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    return validate(field, triangleCounts);
}

Result<void> validate(const SurfaceField& field, std::span<const std::uint32_t> triangleCounts) {
    if (auto ok = validateMeshes(field, triangleCounts); !ok) return ok;
    const std::uint64_t faces = field.faceCount();
    if (field.points.size() != faces)
        return violation("there are " + std::to_string(field.points.size()) + " point counts for " +
                         std::to_string(faces) + " faces");
    for (const SurfaceLayerData& layer : field.layers) {
        const LayerDescription& description = layer.description;
        if (description.name.empty()) return violation("a layer has no name");
        if (description.kind > LayerKind::density)
            return violation("layer \"" + description.name + "\" is of a kind that this version does not know");
        if (field.find(description.name) != &layer) return violation("two layers are called \"" + description.name + "\"");
        if (layer.values.size() != faces * channelCount(description.kind))
            return violation("layer \"" + description.name + "\" has " + std::to_string(layer.values.size()) +
                             " values for " + std::to_string(faces) + " faces");
    }
    return {};
}

}  // namespace emca
