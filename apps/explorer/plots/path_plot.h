#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/listeners.h"
#include "base/plot_export.h"
#include "emca/analysis/path_quantities.h"
#include "emca/query/rules.h"
#include "plots/scatter_plot.h"

class QToolButton;

namespace emca::explorer {

class StateOverlay;
class TextLine;

/// One of the plots above each other: a quantity of each path over its sample index.
struct PathPlotRow {
    PlotAxis axis;
    ScatterPlot::ColorRole color = &ThemeColors::data;
    bool log = true;   ///< offers a logarithmic axis
    bool mean = true;  ///< marks the mean of the paths, which is the pixel's value
    /// Computed by analysis; paths without the quantity are left out.
    std::function<analysis::PathSeries(const PathSet& paths)> series;
    bool optional = false;  ///< hidden while no path has the quantity
    std::string query;      ///< the quantity as a query names it; empty: none does
};

/// Base of the plots over paths: rows with a common sample axis, linked with all other views through the Selection.
class PathPlot : public QWidget {
    Q_OBJECT
  public:
    ~PathPlot() override;

    void setLog(bool log);
    bool isLog() const { return log_; }
    void resetZoom();
    ScatterPlot& row(std::size_t i) { return *rows_[i]->plot; }
    std::size_t rowCount() const { return rows_.size(); }
    /// One line per path: pixel, sample, part and the quantities of all rows, numbers in full.
    QString csv() const;
    /// The histograms beside the rows: quantity, ends of each bar, paths, selected paths; what lies beyond as bars that
    /// have no end.
    QString histogramCsv() const;
    /// PNG, SVG or CSV by the ending of the name. Errors: fileUnwritable. \param scale  of PNG
    Result<void> exportTo(const QString& file, int scale = 2);
    PlotExport exporting();

  signals:
    /// A sentence for the status bar.
    void message(const QString& sentence);
    /// A person wants the paths for which this holds.
    void filterWanted(const emca::query::Rule& rule);
    /// All views shall show this path alone.
    void showOnlyWanted(const emca::client::PathId& path);

  protected:
    PathPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, std::vector<PathPlotRow> rows,
             QWidget* parent);
    void resizeEvent(QResizeEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    struct Row {
        PathPlotRow spec;
        analysis::PathSeries series;
        ScatterPlot* plot = nullptr;
        bool shown = true;
    };
    void addRow(PathPlotRow spec);
    void connectRow(Row& row);
    void reload();
    void select();  ///< marks what the Selection says
    void hover();
    void updateState();
    void placeRows();
    void alignAxes();
    void choose(const Row& row, const QVector<quint32>& points, bool add);
    void showMenu(const Row& row, const QPoint& position, std::optional<std::uint32_t> point);
    QString describe(const Row& row, std::uint32_t point) const;
    std::optional<std::uint32_t> pointOf(const Row& row, Index path) const;

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    std::vector<std::unique_ptr<Row>> rows_;
    QWidget* area_;
    QToolButton* logButton_;
    QToolButton* resetButton_;
    TextLine* summary_;
    StateOverlay* overlay_;
    bool several_ = false;   ///< paths of more than one pixel
    bool log_ = false, aligning_ = false;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
