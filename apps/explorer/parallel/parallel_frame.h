#pragma once

#include <QRectF>
#include <QSizeF>
#include <vector>

#include "parallel/parallel_axes.h"

namespace emca::explorer {

/// Geometry of parallel axes: values to pixels of the canvas and back. A value; nothing of it is drawn here. Above and
/// below the scales are rows for what the ranges do not hold, under them those for NaN and for what was not recorded,
/// at the same height for all axes.
class ParallelFrame {
  public:
    static constexpr double kHeader = 42, kRow = 18, kPadding = 8, kGrab = 12;

    ParallelFrame() = default;
    /// \param left, right  room beside the first and the last axis
    ParallelFrame(QSizeF canvas, const std::vector<ParallelAxis>& axes, double left, double right);

    QSizeF canvas() const { return canvas_; }
    std::size_t axes() const { return count_; }
    double x(std::size_t axis) const;
    /// Distance between two axes; of a single one all there is.
    double spacing() const { return spacing_; }
    double top() const { return top_; }          ///< of the scales
    double bottom() const { return bottom_; }
    double end() const { return end_; }          ///< below the last row
    bool hasTopRow() const { return topRow_; }
    bool hasBottomRow() const { return bottomRow_; }
    bool hasNanRow() const { return nanRow_; }
    bool hasMissingRow() const { return missingRow_; }
    double topRowCenter() const { return top_ - kRow / 2; }
    double bottomRowCenter() const { return bottom_ + kRow / 2; }
    double nanCenter() const;
    double missingCenter() const;

    /// Where a number stands on the scale of an axis; beyond its ends for what the range does not hold.
    double position(const ParallelAxis& axis, double value) const;
    /// Where the line of a path crosses the axis. Lines of one category spread over its room, so that they are seen.
    double y(const ParallelAxis& axis, Index path) const;
    /// Inverse of position().
    double value(const ParallelAxis& axis, double y) const;

    /// What is marked on an axis by a drag from one height to another; numbers are as round as a pixel allows.
    query::Brush brush(const ParallelAxis& axis, double from, double to) const;
    /// Where the numbers of a brush are; empty if it has none.
    QRectF brushRect(std::size_t i, const ParallelAxis& axis, const query::Brush& brush) const;
    QRectF rowRect(std::size_t i, double center) const;

    std::size_t nearestAxis(double x) const;
    /// Whether a position is on the line of an axis, to mark something; below the header.
    bool onAxis(std::size_t axis, QPointF position) const;
    QRectF header(std::size_t axis) const;

  private:
    QSizeF canvas_;
    std::size_t count_ = 0;
    double left_ = 0, spacing_ = 0, top_ = 0, bottom_ = 1, end_ = 1;
    bool topRow_ = false, bottomRow_ = false, nanRow_ = false, missingRow_ = false;
};

}  // namespace emca::explorer
