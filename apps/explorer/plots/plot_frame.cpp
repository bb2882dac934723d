#include "plots/plot_frame.h"

#include <algorithm>
#include <cmath>

namespace emca::explorer {

using analysis::ValueRange;

PlotFrame::PlotFrame(QSizeF canvas, const ValueRange& x, const ValueRange& y, Rows rows)
    : canvas_(canvas.expandedTo(QSizeF(20, 72))), rows_(rows) {  // less would turn axes around
    x_ = {x.repaired(), kPadding, canvas_.width() - kPadding};
    const double top = kPadding + (rows.above ? kRowHeight : 0);
    const double bottom = canvas_.height() - kPadding - (rows.below ? kRowHeight : 0) - (rows.nan ? kRowHeight : 0);
    y_ = {y.repaired(), bottom, top};
}

PlotFrame::Rows PlotFrame::rowsFor(std::span<const double> ys, const ValueRange& y) {
    Rows rows;
    for (const double value : ys) {
        rows.nan |= std::isnan(value);
        rows.above |= value > y.max;
        rows.below |= value < y.min;
    }
    return rows;
}

PlotRow PlotFrame::row(double y) const {
    if (std::isnan(y)) return PlotRow::nan;
    if (y > y_.range.max) return PlotRow::above;
    if (y < y_.range.min) return PlotRow::below;
    return PlotRow::inside;
}

double PlotFrame::center(PlotRow row) const {
    switch (row) {
        case PlotRow::above:
            return kRowHeight / 2 + 1;
        case PlotRow::nan:
            return canvas_.height() - kRowHeight / 2 - 1;
        case PlotRow::below:
            return canvas_.height() - kRowHeight / 2 - 1 - (rows_.nan ? kRowHeight : 0);
        case PlotRow::inside:
            break;
    }
    return (y_.start + y_.end) / 2;
}

std::optional<QPointF> PlotFrame::place(double x, double y) const {
    if (!(x >= x_.range.min && x <= x_.range.max)) return std::nullopt;
    const PlotRow where = row(y);
    return QPointF(x_.pixel(x), where == PlotRow::inside ? y_.pixel(y) : center(where));
}

ValueRange PlotFrame::spannedX() const { return {x_.value(0), x_.value(canvas_.width()), x_.range.log}; }

ValueRange PlotFrame::spannedY() const { return {y_.value(canvas_.height()), y_.value(0), y_.range.log}; }

std::optional<std::uint32_t> PlotFrame::nearest(std::span<const double> xs, std::span<const double> ys,
                                                QPointF position, double radius) const {
    std::optional<std::uint32_t> best;
    double bestSquared = radius * radius;
    for (std::size_t i = 0; i < xs.size(); ++i) {
        const std::optional<QPointF> at = place(xs[i], ys[i]);
        if (!at) continue;
        const QPointF d = *at - position;
        const double squared = QPointF::dotProduct(d, d);
        if (squared > bestSquared) continue;
        bestSquared = squared;
        best = static_cast<std::uint32_t>(i);
    }
    return best;
}

std::vector<std::uint32_t> PlotFrame::inside(std::span<const double> xs, std::span<const double> ys,
                                             QRectF rectangle) const {
    const QRectF r = rectangle.normalized();
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < xs.size(); ++i) {
        const std::optional<QPointF> at = place(xs[i], ys[i]);
        if (at && at->x() >= r.left() && at->x() <= r.right() && at->y() >= r.top() && at->y() <= r.bottom())
            points.push_back(static_cast<std::uint32_t>(i));
    }
    return points;
}

ValueRange zoomed(const ValueRange& range, double position, double factor) {
    return ValueRange{range.value(position - position * factor), range.value(position + (1 - position) * factor),
                      range.log};
}

ValueRange moved(const ValueRange& range, double part) {
    return ValueRange{range.value(part), range.value(1 + part), range.log};
}

}  // namespace emca::explorer
