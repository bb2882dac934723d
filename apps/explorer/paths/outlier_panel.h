#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "base/listeners.h"
#include "emca/query/rules.h"
#include "emca/analysis/outliers.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTableView;

namespace emca::explorer {

class OutlierModel;
class StateOverlay;
class Theme;

/// Finds paths that stand out: beyond mean ± m·σ of a quantity, or by the generalized ESD test; NaN and infinite ones always. The list follows the
/// shown pixel; with "select on new pixels" what is found becomes the selection of all views.
class OutlierPanel : public QWidget {
    Q_OBJECT
  public:
    OutlierPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);

    const analysis::OutlierOptions& options() const { return options_; }
    void setOptions(const analysis::OutlierOptions& options);
    /// Of a region: each path against the paths of its own pixel, not against all.
    bool isPerPixel() const;
    void setPerPixel(bool perPixel);
    bool isAutomatic() const;
    /// Selects what is found whenever another pixel is shown.
    void setAutomatic(bool automatic);
    /// Makes the paths found the selection; the farthest becomes current.
    void selectFound();

    const OutlierModel& model() const { return *model_; }
    QTableView& table() { return *table_; }
    QString summaryText() const;

  signals:
    /// A person wants the paths for which this holds.
    void filterWanted(const emca::query::Rule& rule);
    /// All views shall show this path alone.
    void showOnlyWanted(const emca::client::PathId& path);

  private:
    void build();
    void styleTable();
    void connectControls();
    void showParameters();
    QString testText() const;  ///< what the ESD test says, step by step
    QString limitsText() const;
    QString perPixelText() const;
    bool comparesPixels() const;   ///< there are several, and each counts for itself
    Result<void> report();
    void detect();
    void reload();
    void follow();  ///< marks in the list what the Selection says
    void showMenu(const QPoint& position);
    void choose();  ///< rows were chosen in the list
    void updateState();

    client::Dataset& dataset_;
    client::Selection& selection_;
    analysis::OutlierOptions options_;
    /// One of all paths, or one for each pixel; `sum_` is the only one, or counts of all.
    std::vector<analysis::PixelOutliers> reports_;
    analysis::OutlierReport sum_;
    OutlierModel* model_;
    QComboBox* quantity_;
    QComboBox* method_;
    QDoubleSpinBox* deviations_;
    QSpinBox* maximum_;
    QDoubleSpinBox* significance_;
    QCheckBox* upperOnly_;
    QCheckBox* perPixel_;
    QCheckBox* automatic_;
    QLabel* summary_;
    QTableView* table_;
    QPushButton* select_;
    StateOverlay* overlay_;
    bool marking_ = false;
    std::optional<std::vector<client::PathId>> written_;  ///< what choose() wrote: not news when it comes back
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
