#pragma once

#include <QWidget>

#include "base/plot_export.h"
#include "emca/explorer/plot.h"

namespace emca::explorer {

class ScatterPlot;
class Theme;
class TopHistogram;

/// The plot that plugins get: a ScatterPlot with series, a histogram along x if it is wanted, and a menu of its own.
class PlotWidget : public QWidget, public Plot {
    Q_OBJECT
  public:
    PlotWidget(Theme& theme, QWidget* parent);
    ~PlotWidget() override;

    QWidget* widget() override { return this; }
    void setAxes(const PlotAxis& x, const PlotAxis& y) override;
    void setSeries(std::vector<PlotSeries> series) override;
    void setSelected(const std::vector<PlotPoint>& points, std::optional<PlotPoint> current) override;
    void setHovered(std::optional<PlotPoint> point) override;
    void setLog(bool log) override;
    bool isLog() const override;
    void setHistograms(bool alongX, bool alongY) override;
    void setXLabelsShown(bool shown) override;
    double axisWidth() const override;
    void setAxisWidth(double width) override;
    void setDescription(std::function<QString(PlotPoint)> description) override;
    void onClick(std::function<void(PlotPoint, Qt::KeyboardModifiers)> clicked) override { clicked_ = std::move(clicked); }
    void onArea(std::function<void(const std::vector<PlotPoint>&, bool)> selected) override { selected_ = std::move(selected); }
    void onHover(std::function<void(std::optional<PlotPoint>)> hovered) override { hovered_ = std::move(hovered); }
    void onLog(std::function<void()> changed) override { logChanged_ = std::move(changed); }
    Result<void> exportTo(const QString& file) override;
    /// \param scale  pixels of a PNG per pixel on screen
    Result<void> exportTo(const QString& file, int scale);
    PlotExport exporting();

    ScatterPlot& plot() { return *plot_; }
    TopHistogram& topHistogram() { return *top_; }
    /// One line per point: series, x, y; numbers in full.
    QString csv() const;

  signals:
    /// What was copied or written, or why not.
    void message(const QString& sentence);

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    std::uint32_t indexOf(PlotPoint point) const;
    PlotPoint pointOf(std::uint32_t index) const;
    bool holds(PlotPoint point) const;
    QString describe(std::uint32_t index) const;
    void changeLog();
    void showMenu(const QPoint& position, std::optional<std::uint32_t> index);

    ScatterPlot* plot_;
    TopHistogram* top_;
    std::vector<QString> names_;
    std::vector<std::uint32_t> first_{0};   ///< first point of each series, and the number of points
    std::function<QString(PlotPoint)> description_;
    std::function<void(PlotPoint, Qt::KeyboardModifiers)> clicked_;
    std::function<void(const std::vector<PlotPoint>&, bool)> selected_;
    std::function<void(std::optional<PlotPoint>)> hovered_;
    std::function<void()> logChanged_;
};

}  // namespace emca::explorer
