#pragma once

#include <QAbstractTableModel>
#include <QWidget>
#include <vector>

#include "base/listeners.h"
#include "window/detail_rows.h"

class QLabel;
class QTableView;

namespace emca::explorer {

class StateOverlay;
class Theme;

/// Rows of the detail table for a QTableView.
class DetailModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    explicit DetailModel(Theme& theme, QObject* parent = nullptr);
    void setRows(std::vector<DetailRow> rows);
    const std::vector<DetailRow>& rows() const { return rows_; }
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;

  private:
    Theme& theme_;
    std::vector<DetailRow> rows_;
};

/// Everything that is recorded of the selected vertex, or of the selected path while no vertex is, as a table.
class VertexView : public QWidget {
    Q_OBJECT
  public:
    VertexView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    DetailModel& model() { return *model_; }
    QString title() const;

  private:
    void reload();
    void copy(bool wholeTable);

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    DetailModel* model_;
    QTableView* table_;
    QLabel* title_;
    StateOverlay* overlay_;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
