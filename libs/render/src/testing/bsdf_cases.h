#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emca/render/bsdf_factory.h"

/// Materials for tests, made the way that scene files make them.
namespace emca::render::testing {

/// A scene node as the reader of scene files would hand it over; the line number is 7 of "scene.xml".
inline std::shared_ptr<SceneNode> node(std::string kind, std::string type,
                                       std::initializer_list<std::pair<std::string, Property>> properties = {},
                                       std::vector<SceneNode::Child> children = {}) {
    auto result = std::make_shared<SceneNode>();
    result->kind = std::move(kind);
    result->type = std::move(type);
    result->where = {"scene.xml", 7};
    for (const auto& [name, value] : properties) result->properties[name] = {value, result->where};
    result->children = std::move(children);
    return result;
}

inline std::shared_ptr<SceneNode> bsdfNode(std::string type,
                                           std::initializer_list<std::pair<std::string, Property>> properties = {},
                                           std::vector<SceneNode::Child> children = {}) {
    return node("bsdf", std::move(type), properties, std::move(children));
}

/// Makes the material and insists that nothing about it was worth a diagnostic.
std::shared_ptr<const Bsdf> made(const std::shared_ptr<SceneNode>& node);

struct BsdfCase {
    std::string name;
    std::shared_ptr<const Bsdf> bsdf;
    bool transmits = false;
};

/// Every material that scatters into more than single directions, with several roughnesses.
const std::vector<BsdfCase>& scatteringBsdfs();
/// Every material there is.
const std::vector<BsdfCase>& allBsdfs();

}  // namespace emca::render::testing
