#include "emca/render/scene_loader.h"

#include <set>
#include <string>
#include <variant>

#include "emca/imageio/imageio.h"
#include "emca/render/diagnostics.h"
#include "scene_building.h"

namespace emca::render {

namespace {

/// "kitchen" for both kitchen.xml and kitchen/scene.xml.
std::string sceneName(const std::filesystem::path& path) {
    const std::string stem = path.stem().string();
    const std::string folder = std::filesystem::absolute(path).parent_path().filename().string();
    return stem.starts_with("scene") && !folder.empty() ? folder : stem;
}

Result<void> setImageSize(const SceneOptions& options, SceneParts& parts) {
    if (options.width > 0) parts.width = options.width;
    if (options.height > 0) parts.height = options.height;
    const std::string asked = std::to_string(parts.width) + " x " + std::to_string(parts.height);
    if (parts.width == 0 || parts.height == 0) {
        return Error{ErrorCode::invalidArgument, "Asked for an image of " + asked + " pixels: both must be at least 1."};
    }
    if (parts.width > kMaximumImageSide || parts.height > kMaximumImageSide ||
        std::uint64_t(parts.width) * parts.height > kMaximumImagePixels) {
        return Error{ErrorCode::tooLarge, "Asked for an image of " + asked + " pixels: at most " +
                                              std::to_string(kMaximumImageSide) + " a side and " +
                                              std::to_string(kMaximumImagePixels) + " in all are possible."};
    }
    return {};
}

/// A scene without a camera is seen from outside its bounds, along -z.
void useDefaultCamera(const SceneDocument& document, SceneParts& parts) {
    BoundingBox box;
    for (const auto& shape : parts.shapes) {
        for (const Vec3f p : shape->displayMesh().positions) box.extend(p);
    }
    const Vec3f center = box.empty ? Vec3f{} : box.centre();
    const float distance = box.empty ? 1.f : 1.5f * box.diagonal();
    parts.camera.toWorld = Transform::lookAt({double(center.x), double(center.y), double(center.z + distance)},
                                             {double(center.x), double(center.y), double(center.z)}, {0, 1, 0});
    parts.camera.nearClip = 1e-4f * distance;
    parts.camera.farClip = 1e3f * distance;
    parts.filter = ReconstructionFilter::gaussian();
    addDiagnostic(parts.diagnostics, document.root->where,
                  "The scene has no sensor: it is seen from the side, with all of it in view.");
}

/// Has images read while meshes are. Nodes may be referred to many times.
void readImagesAhead(const SceneNode& node, FactoryContext& factories, std::set<const SceneNode*>& seen) {
    if (!seen.insert(&node).second) return;
    if (node.kind == "texture") readImageAhead(node, factories);
    if (const auto file = node.properties.find("filename"); file != node.properties.end() && node.type == "envmap") {
        if (const auto* name = std::get_if<std::string>(&file->second.value)) imageio::prepareFor(*name);
    }
    for (const SceneNode::Child& child : node.children) readImagesAhead(*child.node, factories, seen);
}

void buildParts(const SceneNode& root, SceneBuilding& building) {
    // The first integrator counts, and before the shapes: it may say how lights choose their points.
    for (const SceneNode::Child& child : root.children) {
        if (child.node->kind != "integrator") continue;
        buildIntegrator(*child.node, building);
        break;
    }
    for (const SceneNode::Child& child : root.children) {
        const SceneNode& node = *child.node;
        if (node.kind == "shape") buildShape(node, building);
        if (node.kind == "emitter") buildEmitter(node, building);
        // Materials, textures and media that stand alone are there to be referred to.
    }
}

}  // namespace

Result<std::shared_ptr<const Scene>> loadScene(const std::filesystem::path& path, const SceneOptions& options) {
    auto document = readSceneFile(path, options.defines);
    if (!document) return document.error();
    return buildScene(*document, sceneName(path), options);
}

Result<std::shared_ptr<const Scene>> buildScene(const SceneDocument& document, std::string name,
                                                const SceneOptions& options) {
    SceneParts parts;
    parts.name = std::move(name);
    parts.diagnostics = document.diagnostics;
    FactoryContext factories{parts.diagnostics, document.searchFolders};
    SceneBuilding building{parts, document.searchFolders, factories};

    std::set<const SceneNode*> seen;
    for (const SceneNode::Child& child : document.root->children) {
        // Materials that no shape refers to are not looked at: their images may be missing.
        if (child.node->kind == "shape" || child.node->kind == "emitter") readImagesAhead(*child.node, factories, seen);
    }
    buildParts(*document.root, building);
    const SceneNode* sensor = nullptr;
    for (const SceneNode::Child& child : document.root->children) {
        if (child.node->kind != "sensor") continue;
        if (!sensor) {
            sensor = child.node.get();
        } else {
            addDiagnostic(parts.diagnostics, child.node->where, "A second sensor is left out: the first one is used.");
        }
    }
    if (sensor) {
        buildSensor(*sensor, building);
    } else {
        useDefaultCamera(document, parts);
    }
    if (parts.emitters.empty()) {
        addDiagnostic(parts.diagnostics, document.root->where, "The scene has no light: its image is black.");
    }
    if (auto sized = setImageSize(options, parts); !sized) return sized.error();
    return Scene::make(std::move(parts));
}

}  // namespace emca::render
