#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "base/listeners.h"
#include "base/plot_export.h"
#include "parallel/parallel_axes.h"

class QMenu;
class QToolButton;

namespace emca::explorer {

class CompletingField;
class ParallelCanvas;
class StateOverlay;
class TextLine;
class Theme;

/// Parallel coordinates: an axis for each of several quantities, a line for each path of the shown pixel (after Simons et
/// al., "Applying Visual Analytics to Physically Based Rendering", CGF 38(1), 2019). Marks on the axes become the
/// selection of all views, or rules of the filter. While the view is hidden it computes nothing.
class ParallelPlot : public QWidget {
    Q_OBJECT
  public:
    ParallelPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    ~ParallelPlot() override;

    /// The axes, for settings.
    QString layoutText() const;
    /// Text without any axis: the usual ones.
    void setLayoutText(const QString& text);
    /// Errors: as ParallelAxes::add.
    Result<void> addAxis(const AxisWish& wish);
    void setAxes(const std::vector<AxisWish>& wishes);

    const ParallelAxes& axes() const { return axes_; }
    ParallelCanvas& canvas() { return *canvas_; }
    CompletingField& addField() { return *add_; }
    QString summaryText() const;
    /// Of the axis that has the focus or is under the mouse; of all axes of radiance if none is.
    void toggleLog();
    void clearBrushes();
    /// What is marked goes to the filter, of one axis or of all.
    void filterByBrushes(std::size_t axis = ParallelAxes::kAll);
    QString csv() const { return axes_.csv(); }
    /// PNG, SVG or CSV by the ending of the name. Errors: fileUnwritable. \param scale  of PNG
    Result<void> exportTo(const QString& file, int scale = 2);
    PlotExport exporting();

  signals:
    /// A sentence for the status bar.
    void message(const QString& sentence);
    /// Rules for the filter; if rules cannot say it, `query` alone does.
    void filterWanted(const std::vector<emca::query::Rule>& rules, const QString& query);
    /// The axes are others, in another order, or scaled in another way.
    void layoutChanged();

  protected:
    void showEvent(QShowEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    void build();
    void connectCanvas();
    void reload();
    void select();      ///< marks what the Selection says
    void hover();
    void takeBrushes(); ///< what is marked becomes the Selection
    void addTyped();
    void suggest();
    void updateState();
    void showMenu(const QPoint& position, std::optional<std::size_t> axis, std::optional<Index> path);
    void addAxisActions(QMenu& menu, std::size_t axis);
    QString describe(Index path) const;

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    ParallelAxes axes_;
    ParallelCanvas* canvas_;
    CompletingField* add_;
    QToolButton *filter_, *clear_, *usual_;
    TextLine* summary_;
    StateOverlay* overlay_;
    QString problem_;                       ///< why the axis that was typed is none
    bool stale_ = true;                     ///< other paths came while the view was hidden
    std::optional<std::vector<client::PathId>> taken_;   ///< what the brushes selected: another selection ends them
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
