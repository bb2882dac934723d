#pragma once

#include <QVector>
#include <QWidget>
#include <functional>
#include <optional>

#include "base/theme.h"
#include "emca/explorer/plot.h"
#include "plots/points_item.h"

class QwtPlot;

namespace emca::explorer {

class MarginalHistogram;
class MeanLabel;
class PlotOverlay;

/// Points over two axes with a histogram of the values beside them. Knows no paths: what the points stand for, its
/// owner says. Mouse: click and shift-click choose a point, dragging draws a rectangle, the wheel zooms at the cursor
/// (over an axis, or with Ctrl for x and Shift for y: that axis alone), middle or Alt-left drags move, a double click
/// shows everything again. Keys: L, R, Home. The default range is robust: what lies beyond is at the edge.
class ScatterPlot : public QWidget {
    Q_OBJECT
  public:
    using ColorRole = explorer::ColorRole;

    explicit ScatterPlot(Theme& theme, QWidget* parent = nullptr);
    ~ScatterPlot() override;

    void setAxes(const PlotAxis& x, const PlotAxis& y);
    void setColor(ColorRole role);
    /// The hover text of a point; without one: both values.
    void setDescription(std::function<QString(std::uint32_t point)> description);
    /// Keeps a zoom if points are left inside it.
    void setPoints(std::vector<double> xs, std::vector<double> ys);
    /// Points [first, last) of one colour, which a line may connect.
    struct Group {
        std::uint32_t first = 0, last = 0;
        ColorRole color = &ThemeColors::data;
        bool connected = false;
    };
    /// The same with points in groups, which ascend.
    void setPoints(std::vector<double> xs, std::vector<double> ys, std::vector<Group> groups);
    void setSelected(std::vector<std::uint32_t> points, std::optional<std::uint32_t> current);
    /// Marked by another view or by the mouse in it.
    void setHovered(std::optional<std::uint32_t> point);

    void setLog(bool log);
    bool isLog() const { return log_; }
    void setLogAllowed(bool allowed) { logAllowed_ = allowed; }
    void setMeanShown(bool shown);
    void resetZoom();
    bool isZoomed() const { return xZoom_.has_value() || yZoom_.has_value(); }
    /// Of plots that share x: where the others are; nothing: all of it.
    const std::optional<analysis::ValueRange>& xZoom() const { return xZoom_; }
    void setXZoom(std::optional<analysis::ValueRange> range);
    /// Plots above others leave labels and title of x to the lowest.
    void setXLabelsShown(bool shown);
    /// Room that the y axis needs, and the room that it gets so that plots above each other align.
    double axisWidth() const;
    void setAxisWidth(double width);
    int xAxisHeight() const;
    /// Waits for the next drag to be a rectangle whatever the modifiers; Esc gives up.
    void startRectangle();

    const ScatterContent& content() const { return content_; }
    const PlotAxis& xAxis() const { return xAxis_; }
    const PlotAxis& yAxis() const { return yAxis_; }
    QWidget* canvas() const;
    QwtPlot* plot() const { return plot_; }
    MarginalHistogram* histogram() const { return histogram_; }
    /// How often all points were drawn so far; selecting some must not.
    std::uint64_t drawnPointLayers() const { return points_->drawnLayers(); }
    QString hoverText() const;
    /// While set, the canvas is painted anew each time, as vectors if the device takes them.
    void setExporting(bool exporting);

  signals:
    void clicked(std::uint32_t point, Qt::KeyboardModifiers modifiers);
    void areaSelected(const QVector<quint32>& points, bool add);
    void hovered(std::optional<std::uint32_t> point);
    void menuRequested(const QPoint& globalPosition, std::optional<std::uint32_t> point);
    void logToggled();
    void clearRequested();
    void zoomResetRequested();
    /// The person zoomed or moved; x may have changed.
    void zoomChanged();
    /// Points, ranges, size or selection changed: what stands beside the canvas is drawn anew.
    void contentChanged();
    void axisWidthChanged();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    enum class Drag { none, pressed, rectangle, moving };
    void restyle();
    void colorGroups();
    void findRanges();   ///< default ranges of the points
    void layoutFrame();  ///< frame, ticks and axes for the current ranges and size
    void layoutFrame(int roomAtTheRight);
    void refresh();      ///< draws points and histogram again
    void replotCanvas();
    bool press(QMouseEvent& event);
    bool move(QMouseEvent& event);
    bool release(QMouseEvent& event);
    void zoomBy(QPointF position, double factor, bool x, bool y);
    void moveBy(QPointF distance);
    void hoverAt(std::optional<QPointF> position);
    void showHovered();
    std::optional<std::uint32_t> pointAt(QPointF position) const;

    Theme& theme_;
    PlotAxis xAxis_, yAxis_;
    ColorRole role_ = &ThemeColors::data;
    std::function<QString(std::uint32_t)> description_;
    ScatterContent content_;
    std::vector<Group> groups_;
    analysis::ValueRange xFull_, yFull_;
    std::optional<analysis::ValueRange> xZoom_, yZoom_;
    bool log_ = false, logAllowed_ = true, meanShown_ = true, xLabels_ = true, layingOut_ = false;
    std::optional<std::uint32_t> hovered_;
    bool hoveredHere_ = false;
    Drag drag_ = Drag::none;
    bool rectangleKey_ = false, ignoreRelease_ = false;
    QPointF pressedAt_, lastAt_;
    QwtPlot* plot_;
    MarginalHistogram* histogram_;
    PlotOverlay* overlay_;
    PointsItem* points_;  ///< belongs to plot_
    MeanLabel* mean_;
    double axisWidth_ = 0;
};

}  // namespace emca::explorer
