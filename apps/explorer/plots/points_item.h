#pragma once

#include <qwt_plot_item.h>
#include <QImage>
#include <QPixmap>
#include <optional>
#include <vector>

#include "plots/plot_frame.h"

namespace emca::explorer {

class Theme;

/// Points [first, last) of one colour.
struct ScatterGroup {
    std::uint32_t first = 0, last = 0;
    QColor color;
    bool connected = false;  ///< a line through its points, in their order
};

/// What a scatter plot shows, and how it lies on the canvas.
struct ScatterContent {
    std::vector<double> xs, ys;           ///< equally many
    std::vector<std::uint32_t> selected;  ///< points, ascending
    std::optional<std::uint32_t> current;
    QColor color;                         ///< of points and histogram
    std::vector<ScatterGroup> groups;     ///< ascending; where there are some, points have their colours
    PlotFrame frame;
    std::vector<analysis::Tick> xTicks, yTicks;
    std::optional<double> mean;  ///< of ys, where it means something
    std::uint64_t version = 0;   ///< counts changes of xs and ys

    bool dense() const { return xs.size() > analysis::kDensityThreshold; }
    bool isSelected(std::uint32_t point) const;
    const QColor& colorOf(std::uint32_t point) const;
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

/// Points of a scatter plot inside its ranges, whether selected or not: dots, or density where dots would hide dots;
/// dimmed while some are selected. What is selected is marked by PlotOverlay above it, so that a selection draws no
/// point again.
class PointsItem : public QwtPlotItem {
  public:
    PointsItem(const ScatterContent& content, const Theme& theme) : content_(content), theme_(theme) { setZ(2); }
    void draw(QPainter* painter, const QwtScaleMap&, const QwtScaleMap&, const QRectF& canvas) const override;
    /// Radius of a dot in pixels: smaller the more there are.
    static double radius(std::size_t points);
    /// How often all points were drawn so far.
    std::uint64_t drawnLayers() const { return drawnLayers_; }

  private:
    QColor dotColor(const QColor& color, bool dimmed) const;
    /// Calls draw with each group, or with all points as one.
    template <typename Draw>
    void forGroups(Draw draw) const;
    void drawLines(QPainter& painter, bool dimmed) const;
    /// Calls draw with the place of a point that is inside the ranges.
    template <typename Draw>
    void forInside(std::uint32_t point, Draw draw) const;
    void drawDots(QPainter& painter, bool dimmed) const;

    const ScatterContent& content_;
    const Theme& theme_;
    // All dots (or their density) as drawn last, bright and dim: a selection that comes or goes draws neither again.
    struct Layer {
        QImage image;
        std::uint64_t version = 0;
        analysis::ValueRange x, y;
        QSizeF canvas;
        QColor color;
    };
    void drawLayer(QPainter& painter) const;
    QImage densityImage(bool dimmed) const;
    QImage dotsImage(bool dimmed, double ratio) const;
    mutable Layer layers_[2];
    mutable std::uint64_t drawnLayers_ = 0;
};

/// One dot as a picture: stamping it is ten times as fast as drawing circles.
QPixmap dotStamp(const QColor& color, double radius, const QColor& halo, double ratio);
/// Whether what is painted keeps shapes: pictures and printers of vectors get circles, screens get stamps.
bool keepsShapes(const QPainter& painter);

}  // namespace emca::explorer
