#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emca/render/scene_node.h"

namespace emca::render {

/// Keeps the nodes of a scene while it is read and then puts the right one in the place of every <ref>.
class SceneReferences {
  public:
    using NodePointer = std::shared_ptr<SceneNode>;

    /// Every node, the root too. If its id is taken already, that is a diagnostic.
    void addNode(const NodePointer& node, std::vector<Diagnostic>& diagnostics);
    /// A second id for what `id` names, now or later.
    void addAlias(std::string id, std::string alias);
    /// Appends a child whose node comes with resolve().
    void addReference(const NodePointer& parent, std::string role, std::string id, SourceLocation where);

    /// Fills in all references; those to ids that nobody has, that would make a circle or that would be nested too
    /// deeply for those who walk the tree by recursion are removed, with a diagnostic each.
    void resolve(const NodePointer& root, std::vector<Diagnostic>& diagnostics);

  private:
    struct Reference { NodePointer parent; std::size_t child; std::string id; };

    std::shared_ptr<const SceneNode> find(const std::string& id) const;
    void breakCircles(const NodePointer& root, std::vector<Diagnostic>& diagnostics);
    void removeEmptyChildren();

    std::vector<NodePointer> nodes_;
    std::map<std::string, std::shared_ptr<const SceneNode>> ids_;
    std::map<std::string, std::string> aliases_;  ///< alias to id
    std::vector<Reference> references_;
};

/// How deeply elements may be nested, and references on top of them.
inline constexpr int kMaxSceneDepth = 200;

}  // namespace emca::render
