#pragma once

#include <QString>
#include <QStringList>
#include <Qt>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "emca/core/result.h"
#include "emca/explorer/look.h"

class QWidget;

namespace emca::explorer {

/// What an axis shows.
struct PlotAxis {
    QString quantity;          ///< "luminance"
    QString unit;              ///< "W/(sr m²)" or empty
    bool integral = false;     ///< whole numbers: no tick between them
    bool includeZero = false;  ///< its range begins at 0, as radiance does
    QStringList names;         ///< words for the values 0, 1, 2, … in the place of numbers; implies `integral`
    QString title() const { return unit.isEmpty() ? quantity : quantity + QStringLiteral(", ") + unit; }
};

/// Points of one colour, e.g. a channel.
struct PlotSeries {
    QString name;              ///< "red"; in the hover text where there are several
    ColorRole color = &ThemeColors::data;
    std::vector<double> xs, ys;  ///< equally many; NaN and infinity are shown at the edges
    bool connected = false;    ///< a thin line through the points, in their order
};

/// A point of a plot: which series, which of its points.
struct PlotPoint {
    std::uint32_t series = 0, point = 0;
    friend bool operator==(const PlotPoint&, const PlotPoint&) = default;
};

/// A plot as the explorer's own: points over two axes with histograms at its edges, robust ranges, hover values, zoom
/// by the wheel, rectangle selection, logarithmic axis (key L), export by the context menu. It knows no paths; what the
/// points stand for, its owner says. PluginContext::makePlot makes it. GUI thread.
///
/// It is owned by its parent widget: deleted with it. After that the functions must not be called.
class Plot {
  public:
    /// A place for it in a layout.
    virtual QWidget* widget() = 0;
    virtual void setAxes(const PlotAxis& x, const PlotAxis& y) = 0;
    /// Replaces all points. A zoom stays if points are left inside it; the selection goes.
    virtual void setSeries(std::vector<PlotSeries> series) = 0;
    /// Orange. \param current  with a ring
    virtual void setSelected(const std::vector<PlotPoint>& points, std::optional<PlotPoint> current) = 0;
    /// A ring around a point that another view is hovering over.
    virtual void setHovered(std::optional<PlotPoint> point) = 0;
    virtual void setLog(bool log) = 0;
    virtual bool isLog() const = 0;
    /// Histograms beside the plot. Of y there is one without this call.
    virtual void setHistograms(bool alongX, bool alongY) = 0;
    /// Plots above each other leave the labels of x to the lowest.
    virtual void setXLabelsShown(bool shown) = 0;
    /// Room at the left for labels of y, so that plots above each other align: the largest of their axisWidth(). Pixels.
    virtual double axisWidth() const = 0;
    virtual void setAxisWidth(double width) = 0;
    /// The hover text of a point; without one: both values.
    virtual void setDescription(std::function<QString(PlotPoint)> description) = 0;
    virtual void onClick(std::function<void(PlotPoint, Qt::KeyboardModifiers)> clicked) = 0;
    /// A rectangle was drawn or a bar of a histogram clicked. \param add  to what is selected
    virtual void onArea(std::function<void(const std::vector<PlotPoint>&, bool add)> selected) = 0;
    virtual void onHover(std::function<void(std::optional<PlotPoint>)> hovered) = 0;
    /// The key L or the context menu changed isLog().
    virtual void onLog(std::function<void()> changed) = 0;
    /// PNG, SVG or CSV by the ending of the name. Errors: fileUnwritable.
    virtual Result<void> exportTo(const QString& file) = 0;

  protected:
    virtual ~Plot() = default;
};

}  // namespace emca::explorer
