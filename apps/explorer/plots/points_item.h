#pragma once

#include <qwt_plot_item.h>
#include <QImage>
#include <QPixmap>
#include <optional>
#include <vector>

#include "plots/plot_frame.h"

namespace emca::explorer {

class Theme;

/// What a scatter plot shows, and how it lies on the canvas.
struct ScatterContent {
    std::vector<double> xs, ys;           ///< equally many
    std::vector<std::uint32_t> selected;  ///< points, ascending
    std::optional<std::uint32_t> current;
    QColor color;
    PlotFrame frame;
    std::vector<analysis::Tick> xTicks, yTicks;
    std::optional<double> mean;  ///< of ys, where it means something
    std::uint64_t version = 0;   ///< counts changes of xs and ys

    bool dense() const { return xs.size() > analysis::kDensityThreshold; }
    bool isSelected(std::uint32_t point) const;
};

/// Grid, edge rows and mean of a scatter plot: what lies below the points.
class GridItem : public QwtPlotItem {
  public:
    GridItem(const ScatterContent& content, const Theme& theme) : content_(content), theme_(theme) { setZ(1); }
    void draw(QPainter* painter, const QwtScaleMap&, const QwtScaleMap&, const QRectF& canvas) const override;

  private:
    const ScatterContent& content_;
    const Theme& theme_;
};

/// Points of a scatter plot: dots, or density where dots would hide dots; dimmed while others are selected; what lies
/// beyond the range with an arrow and its value at the edge; NaN and infinity as words.
class PointsItem : public QwtPlotItem {
  public:
    PointsItem(const ScatterContent& content, const Theme& theme) : content_(content), theme_(theme) { setZ(2); }
    void draw(QPainter* painter, const QwtScaleMap&, const QwtScaleMap&, const QRectF& canvas) const override;
    /// Radius of a dot in pixels: smaller the more there are.
    static double radius(std::size_t points);

  private:
    void drawSelected(QPainter& painter) const;
    QColor dotColor(bool dimmed) const;
    /// Calls draw with the place of a point that is inside the ranges.
    template <typename Draw>
    void forInside(std::uint32_t point, Draw draw) const;
    void drawDots(QPainter& painter, bool dimmed) const;
    void drawEdges(QPainter& painter) const;
    void drawCurrent(QPainter& painter) const;
    void drawMean(QPainter& painter) const;
    /// One dot as a picture: stamping it is ten times as fast as drawing circles.
    QPixmap stamp(const QColor& color, double radius, const QColor& halo, double ratio) const;

    const ScatterContent& content_;
    const Theme& theme_;
    // All dots (or their density) without what is selected, as drawn last: a change of the selection draws them again
    // only if they become dim or bright. A selected dot covers its own.
    struct Layer {
        QImage image;
        std::uint64_t version = 0;
        analysis::ValueRange x, y;
        QSizeF canvas;
        QColor color;
        bool dimmed = false;
    };
    void drawLayer(QPainter& painter) const;
    QImage densityImage(bool dimmed) const;
    QImage dotsImage(bool dimmed, double ratio) const;
    mutable Layer layer_;
};

}  // namespace emca::explorer
