#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "emca/explorer/scene_objects.h"

// The objects that plugins add to the 3D view (their types: emca/explorer/scene_objects.h), and their switches. Knows
// neither Qt nor VTK.
namespace emca::explorer {

/// Errors: invalidArgument, naming the rule and both numbers.
Result<void> check(const SceneObject& object);
/// Where everything is; empty without finite positions.
BoundingBox boundsOf(const SceneObject& object);
/// What colours the elements by value: the given range, or that of the finite values; valid in any case.
analysis::ValueRange rangeOf(const ObjectColors& colors);
/// One per element.
std::vector<analysis::Color8> colorsOf(const SceneObject& object);
/// The words for an element under the cursor: its label, or "name 12", and its value with unit.
std::string labelOf(const SceneObject& object, std::size_t element);

/// Names an object: who added it, and its owner's own name for it.
struct ObjectId {
    std::string owner, id;
    friend auto operator<=>(const ObjectId&, const ObjectId&) = default;
};

/// The objects of a 3D view, with a switch each. The view and its options listen; plugins write. A switch that a person
/// set is remembered while the program runs, also while its object is gone and comes again with the next vertex.
/// GUI thread.
class SceneObjects {
  public:
    struct Entry {
        ObjectId id;
        std::shared_ptr<const SceneObject> object;   ///< never null; another one after each set()
        bool visible = true;
    };
    /// Bits that say what changed.
    enum Change : std::uint32_t { objects = 1, visibility = 2 };
    using Listener = std::function<void(std::uint32_t changes)>;
    using PickListener = std::function<void(const ObjectId& id, std::size_t element)>;
    using ListenerId = std::uint64_t;

    /// Adds or replaces. Errors: those of check(); then everything stays as it is.
    Result<void> set(const ObjectId& id, SceneObject object, bool visibleAtFirst = true);
    void remove(const ObjectId& id);
    /// Everything that an owner added: a plugin that ends.
    void removeAll(const std::string& owner);
    void setVisible(const ObjectId& id, bool visible);
    /// Ordered by owner and name.
    const std::vector<Entry>& entries() const { return entries_; }
    const Entry* find(const ObjectId& id) const;

    /// Told to pick listeners: a person clicked an element.
    void pick(const ObjectId& id, std::size_t element);

    /// Listeners may add and remove listeners and change objects while they are called.
    ListenerId listen(Listener listener);
    ListenerId listenPicks(PickListener listener);
    void unlisten(ListenerId id);

    /// While one lives, changes are collected; its end tells each listener once.
    class Transaction {
      public:
        explicit Transaction(SceneObjects& objects) : objects_(objects) { ++objects_.transactions_; }
        ~Transaction();
        Transaction(const Transaction&) = delete;
        Transaction& operator=(const Transaction&) = delete;
      private:
        SceneObjects& objects_;
    };

  private:
    void changed(std::uint32_t changes);
    std::vector<Entry> entries_;
    std::vector<std::pair<ObjectId, bool>> switches_;   ///< as people set them
    std::vector<std::pair<ListenerId, Listener>> listeners_;
    std::vector<std::pair<ListenerId, PickListener>> pickListeners_;
    ListenerId nextListener_ = 1;
    int transactions_ = 0;
    std::uint32_t pending_ = 0;
};

}  // namespace emca::explorer
