#pragma once

#include <cstddef>
#include <vector>

#include "base/listeners.h"

namespace emca::explorer {

/// Steps back through what was selected. Hovering is no step.
class SelectionUndo {
  public:
    static constexpr std::size_t kSteps = 200;

    explicit SelectionUndo(client::Selection& selection)
        : selection_(selection), last_(selection.state()), listening_(selection, [this](std::uint32_t parts) {
              if (restoring_ || (parts & ~static_cast<std::uint32_t>(client::SelectionPart::hover)) == 0) return;
              undone_.clear();
              done_.push_back(std::move(last_));
              if (done_.size() > kSteps) done_.erase(done_.begin());
              last_ = selection_.state();
          }) {}

    bool canUndo() const { return !done_.empty(); }
    bool canRedo() const { return !undone_.empty(); }
    void undo() { move(done_, undone_); }
    void redo() { move(undone_, done_); }

    /// Other paths are here: what was selected before means nothing.
    void clear() {
        done_.clear();
        undone_.clear();
        last_ = selection_.state();
    }

  private:
    void move(std::vector<client::Selection::State>& from, std::vector<client::Selection::State>& to) {
        if (from.empty()) return;
        to.push_back(selection_.state());
        restoring_ = true;
        selection_.set(from.back());
        restoring_ = false;
        from.pop_back();
        last_ = selection_.state();
    }
    client::Selection& selection_;
    client::Selection::State last_;
    std::vector<client::Selection::State> done_, undone_;
    bool restoring_ = false;
    SelectionListening listening_;
};

}  // namespace emca::explorer
