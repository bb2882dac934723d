#pragma once

#include <QObject>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/listeners.h"
#include "emca/client/session.h"

namespace emca::explorer {

class FilterPanel;

/// Steps back and forth through what a person did: what was selected, and what was asked of the paths (rules, query,
/// whether it is applied by itself), in one history. Hovering is no step, nor is what only follows from something else:
/// that the paths of the pixel before go. A word typed into one field is one step.
class EditHistory : public QObject {
    Q_OBJECT
  public:
    static constexpr std::size_t kSteps = 200;
    /// Selected paths in all steps together; beyond it the oldest steps go. 32 bytes each.
    static constexpr std::size_t kPaths = 1u << 21;

    /// Both outlive this object.
    EditHistory(client::Selection& selection, FilterPanel& filter, QObject* parent = nullptr);

    bool canUndo() const { return !done_.empty(); }
    bool canRedo() const { return !undone_.empty(); }
    void undo() { move(done_, undone_); }
    void redo() { move(undone_, done_); }

    /// Other paths are here: what was selected before means nothing.
    void clear();

  signals:
    void changed();

  private:
    struct State {
        client::Selection::State selection;
        client::SavedFilter filter;
        friend bool operator==(const State&, const State&) = default;
    };
    State now() const;
    void record();
    void move(std::vector<State>& from, std::vector<State>& to);
    void forgetOldest();

    client::Selection& selection_;
    FilterPanel& filter_;
    State last_;
    std::vector<State> done_, undone_;
    std::optional<std::size_t> typing_;   ///< field that the last step wrote into
    bool restoring_ = false;
    SelectionListening listening_;
};

}  // namespace emca::explorer
