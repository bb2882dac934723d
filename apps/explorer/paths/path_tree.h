#pragma once

#include <QWidget>
#include <optional>

#include "base/listeners.h"
#include "emca/query/rules.h"
#include "emca/core/path_set.h"

class QComboBox;
class QItemSelection;
class QLabel;
class QLineEdit;
class QMenu;
class QToolButton;

namespace emca::explorer {

class PathTreeDelegate;
class PathTreeModel;
class PathTreeView;
class StateOverlay;
class Theme;

/// The recorded paths as a tree of values: path → info, data, vertices → values. Shows all paths or those that are
/// selected; what is selected here is selected everywhere, and the other way round.
class PathTree : public QWidget {
    Q_OBJECT
  public:
    PathTree(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);

    /// All paths, or only those that are selected now or that another view selects later.
    void showAll();
    void inspectSelected();
    /// One level: paths so that vertices are seen. Selected paths are expanded whole.
    void expand();
    void collapse();
    /// Rows of values whose key contains the text; what is current opens so that they are seen.
    void setKeyFilter(const QString& text);

    PathTreeModel& model() { return *model_; }
    PathTreeView& view() { return *view_; }
    QString countText() const;

  signals:
    /// A person wants the paths for which this holds.
    void filterWanted(const emca::query::Rule& rule);

  protected:
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void buildHeader();
    void reload();      ///< other paths, or others of them to show
    void follow();      ///< the Selection changed
    void adopt();       ///< the rows chosen here changed
    void selectRows();  ///< rows as the Selection says
    void reveal();      ///< current vertex or path, if another view made it current
    void updateState();
    void filterKeys(const QString& text);
    void showMenu(const QPoint& position);
    void copyValue(const QModelIndex& index);
    void copyAsText();
    std::optional<std::vector<Index>> wanted() const;

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    PathTreeModel* model_;
    PathTreeDelegate* delegate_;
    PathTreeView* view_;
    StateOverlay* overlay_;
    QLabel* count_;
    QToolButton* all_;
    QToolButton* selected_;
    QComboBox* order_;
    QLineEdit* find_;
    bool inspecting_ = false;
    std::vector<client::PathId> inspected_;            ///< what inspectSelected shows
    bool selecting_ = false;                           ///< rows are being set by us
    std::optional<client::Selection::State> written_;  ///< what adopt() wrote last: not news when it comes back
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
