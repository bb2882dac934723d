#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emca/render/bsdf.h"
#include "emca/render/scene_node.h"
#include "emca/render/texture.h"

namespace emca::render {

class ImageAhead;

/// What the factories of one scene share. Nodes that are referenced several times become one object, and an image file
/// is loaded once. One thread at a time.
struct FactoryContext {
    std::vector<Diagnostic>& diagnostics;                     ///< appended; outlives the context
    std::span<const std::filesystem::path> searchFolders;     ///< SceneDocument::searchFolders; outlives the context
    std::map<const SceneNode*, std::shared_ptr<const Bsdf>> bsdfs = {};        ///< by node, which must stay alive
    std::map<const SceneNode*, std::shared_ptr<const Texture>> textures = {};  ///< by node, which must stay alive
    std::map<std::string, std::shared_ptr<ImageAhead>> images = {};            ///< by file and how it is read
};

/// The material that a node of kind "bsdf" describes, with all textures and nested materials. Never null: a type or
/// value that is not known is named in a diagnostic and replaced by the nearest one that is.
std::shared_ptr<const Bsdf> makeBsdf(const SceneNode& node, FactoryContext& context);

/// Begins to read the image file of a texture, if it has one, beside the caller's other work: makeTexture() then waits
/// for what is missing.
void readImageAhead(const SceneNode& texture, FactoryContext& context);

/// The texture that a node of kind "texture" describes. Never null: a file that cannot be read and an unknown type are
/// named in a diagnostic and replaced by a grey of 0.5.
std::shared_ptr<const Texture> makeTexture(const SceneNode& node, FactoryContext& context);

/// What surfaces are made of that name no material: diffuse, reflectance 0.5.
std::shared_ptr<const Bsdf> defaultBsdf();

}  // namespace emca::render
