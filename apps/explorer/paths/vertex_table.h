#pragma once

#include <QWidget>

#include "base/listeners.h"
#include "emca/query/rules.h"

class QTableView;
class QToolButton;

namespace emca::explorer {

class StateOverlay;
class TextLine;
class Theme;
class VertexTableModel;

/// Everything recorded at the selected vertex, beside the same quantities at the vertices before and after it.
class VertexTable : public QWidget {
    Q_OBJECT
  public:
    VertexTable(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);

    const VertexTableModel& model() const { return *model_; }
    /// To the vertex before or after on the path, if there is one.
    void stepBack();
    void stepForward();

  signals:
    /// A person wants the paths for which this holds.
    void filterWanted(const emca::query::Rule& rule);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void reload();
    void showNeighbours();
    void showMenu(const QPoint& position);

    client::Dataset& dataset_;
    client::Selection& selection_;
    VertexTableModel* model_;
    TextLine* title_;
    QToolButton* back_;
    QToolButton* forward_;
    QTableView* table_;
    StateOverlay* overlay_;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
