#include "scene_references.h"

#include <algorithm>
#include <unordered_map>

#include "emca/render/diagnostics.h"

namespace emca::render {

void SceneReferences::addNode(const NodePointer& node, std::vector<Diagnostic>& diagnostics) {
    nodes_.push_back(node);
    if (node->id.empty())
        return;
    const auto [place, added] = ids_.try_emplace(node->id, node);
    if (!added)
        addDiagnostic(diagnostics, node->where,
                      "id \"" + node->id + "\" is taken by the " + place->second->kind + " at " +
                          place->second->where.text() + ", which references keep to");
}

void SceneReferences::addAlias(std::string id, std::string alias) {
    aliases_.try_emplace(std::move(alias), std::move(id));
}

void SceneReferences::addReference(const NodePointer& parent, std::string role, std::string id, SourceLocation where) {
    references_.push_back({parent, parent->children.size(), std::move(id)});
    parent->children.push_back({std::move(role), nullptr, std::move(where)});
}

std::shared_ptr<const SceneNode> SceneReferences::find(const std::string& id) const {
    const std::string* name = &id;
    // Aliases of aliases may form a circle, which no longer chain than all of them can.
    for (std::size_t hops = 0; hops <= aliases_.size(); ++hops) {
        if (const auto node = ids_.find(*name); node != ids_.end())
            return node->second;
        const auto alias = aliases_.find(*name);
        if (alias == aliases_.end())
            return nullptr;
        name = &alias->second;
    }
    return nullptr;
}

void SceneReferences::resolve(const NodePointer& root, std::vector<Diagnostic>& diagnostics) {
    for (const auto& [parent, child, id] : references_) {
        auto& place = parent->children[child];
        place.node = find(id);
        if (!place.node)
            addDiagnostic(diagnostics, place.where, "ref to \"" + id + "\", but nothing has that id; it is ignored");
    }
    removeEmptyChildren();
    breakCircles(root, diagnostics);
    removeEmptyChildren();
}

void SceneReferences::removeEmptyChildren() {
    for (const auto& node : nodes_)
        std::erase_if(node->children, [](const auto& child) { return !child.node; });
}

void SceneReferences::breakCircles(const NodePointer& root, std::vector<Diagnostic>& diagnostics) {
    // Depth-first without recursion: `height` of a finished node is the longest way down from it.
    struct State { int height = -1; bool open = false; };
    struct Step { SceneNode* node; std::size_t next = 0; int height = 0; };
    std::unordered_map<const SceneNode*, SceneNode*> writable;
    for (const auto& node : nodes_)
        writable[node.get()] = node.get();
    std::unordered_map<const SceneNode*, State> states;
    std::vector<Step> stack{{root.get()}};
    states[root.get()].open = true;

    const auto drop = [&](Step& step, const char* why) {
        auto& child = step.node->children[step.next];
        addDiagnostic(diagnostics, child.where, "ref to \"" + child.node->id + "\" " + why + "; it is ignored");
        child.node = nullptr;
        ++step.next;
    };
    while (!stack.empty()) {
        Step& step = stack.back();
        if (step.next == step.node->children.size()) {
            states[step.node] = {step.height, false};
            stack.pop_back();
            continue;
        }
        const SceneNode* child = step.node->children[step.next].node.get();
        State& state = states[child];
        if (state.open) {
            drop(step, "makes a circle");
        } else if (state.height < 0) {
            state.open = true;
            stack.push_back({writable.at(child)});
        } else if (state.height + 1 > 2 * kMaxSceneDepth) {
            drop(step, "makes a chain of references that is too long");
        } else {
            step.height = std::max(step.height, state.height + 1);
            ++step.next;
        }
    }
}

}  // namespace emca::render
