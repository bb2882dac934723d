#pragma once

#include <QTreeView>
#include <optional>
#include <vector>

#include "emca/client/selection.h"
#include "emca/core/path_set.h"

namespace emca::explorer {

class PathTreeModel;
class Theme;

/// The tree view of a PathTreeModel: what QTreeView lacks for it.
class PathTreeView : public QTreeView {
    Q_OBJECT
  public:
    PathTreeView(PathTreeModel& model, Theme& theme, QWidget* parent = nullptr);

    /// What a person has arranged, by identifiers, so that it outlives a reset of the model.
    struct Arrangement {
        struct Child {
            bool vertex = false;     ///< else a group
            bool dataGroup = false;  ///< groups
            std::int32_t depth = 0;  ///< vertices
            Subpath subpath = Subpath::camera;
        };
        struct Expanded {
            client::PathId path;
            std::vector<Child> children;  ///< those expanded below it
        };
        std::vector<Expanded> expanded;
        std::optional<client::PathId> topPath;      ///< path of the first visible row
        std::optional<client::VertexId> topVertex;  ///< its vertex, if it is on one
        int horizontal = 0;
    };
    Arrangement arrangement() const;
    /// Applies what still exists; call it right after a reset.
    void restore(const Arrangement& arrangement);

    /// Expands the shown paths so that their vertices are seen.
    void expandPaths();
    /// Expands one path with all that is below it.
    void expandWhole(const QModelIndex& path);
    /// Ranges of the rows of paths for a selection model. Positions of the set, any order.
    QItemSelection rowsOf(const std::vector<Index>& paths) const;

  signals:
    /// The selected rows or the current one changed: once for each press of a button or key, whatever Qt tells.
    void rowsChosen();

  protected:
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void selectionChanged(const QItemSelection& selected, const QItemSelection& deselected) override;
    void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;

  private:
    template <typename Handler>
    void inOne(Handler handler);
    void chosen();

    int handling_ = 0;      ///< events being handled
    bool changed_ = false;  ///< rows changed meanwhile
    PathTreeModel& model_;
    Theme& theme_;
};

}  // namespace emca::explorer
