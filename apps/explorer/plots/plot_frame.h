#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <optional>
#include <span>
#include <vector>

#include "emca/analysis/statistics.h"

namespace emca::explorer {

/// Where the values of one axis are on the canvas.
struct AxisFrame {
    analysis::ValueRange range;
    double start = 0, end = 1;  ///< pixel of range.min and of range.max

    double pixel(double value) const { return start + range.position(value) * (end - start); }
    double value(double pixel) const { return range.value((pixel - start) / (end - start)); }
};

/// Where a point is along y. What the range does not hold has rows of its own at the edges.
enum class PlotRow : std::uint8_t {
    inside,
    above,  ///< larger than the range, +infinity
    below,  ///< smaller than the range, -infinity; on logarithmic axes 0 and negative values
    nan,
};

/// Geometry of a scatter plot: points to pixels of the canvas and back. A value; nothing of it is drawn here.
class PlotFrame {
  public:
    static constexpr double kRowHeight = 18, kPadding = 6;

    PlotFrame() = default;
    /// \param rows  which edge rows there are room for
    struct Rows {
        bool above = false, below = false, nan = false;
    };
    PlotFrame(QSizeF canvas, const analysis::ValueRange& x, const analysis::ValueRange& y, Rows rows);
    /// The rows that these values need.
    static Rows rowsFor(std::span<const double> ys, const analysis::ValueRange& y);

    const AxisFrame& x() const { return x_; }
    const AxisFrame& y() const { return y_; }
    QSizeF canvas() const { return canvas_; }
    const Rows& rows() const { return rows_; }

    PlotRow row(double y) const;
    /// Middle of an edge row on the canvas.
    double center(PlotRow row) const;
    /// Where a point is drawn; nothing if its x is not finite or lies outside.
    std::optional<QPointF> place(double x, double y) const;

    /// Values at the edges of the canvas, beyond the ranges by padding and rows: what the scales span.
    analysis::ValueRange spannedX() const;
    analysis::ValueRange spannedY() const;

    /// The point drawn nearest to a position, within a radius in pixels. Of equally near ones the last, which is on
    /// top.
    std::optional<std::uint32_t> nearest(std::span<const double> xs, std::span<const double> ys, QPointF position,
                                         double radius) const;
    /// Points drawn inside a rectangle, its edges included; ascending.
    std::vector<std::uint32_t> inside(std::span<const double> xs, std::span<const double> ys, QRectF rectangle) const;

  private:
    QSizeF canvas_;
    AxisFrame x_, y_;
    Rows rows_;
};

/// The range zoomed by a factor (below 1: closer) so that what was at `position` (0 to 1) stays there.
analysis::ValueRange zoomed(const analysis::ValueRange& range, double position, double factor);
/// The range moved by a part of its length.
analysis::ValueRange moved(const analysis::ValueRange& range, double part);

}  // namespace emca::explorer
