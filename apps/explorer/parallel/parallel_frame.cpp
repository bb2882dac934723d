#include "parallel/parallel_frame.h"

#include <algorithm>
#include <cmath>

namespace emca::explorer {

using analysis::AxisPlace;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

ParallelFrame::ParallelFrame(QSizeF canvas, const std::vector<ParallelAxis>& axes, double left, double right)
    : canvas_(canvas.expandedTo(QSizeF(120, 120))), count_(axes.size()), left_(left) {
    const double room = std::max(40.0, canvas_.width() - left - right);
    spacing_ = count_ > 1 ? room / double(count_ - 1) : room;
    if (count_ == 1) left_ = canvas_.width() / 2;
    for (const ParallelAxis& axis : axes) {
        const bool above = axis.scale.above > 0, below = axis.scale.below > 0;
        topRow_ |= axis.wish.flipped ? below : above;
        bottomRow_ |= axis.wish.flipped ? above : below;
        nanRow_ |= axis.scale.nan > 0;
        missingRow_ |= axis.scale.missing > 0;
    }
    top_ = kHeader + kPadding + (topRow_ ? kRow : 0);
    end_ = canvas_.height() - kPadding;
    bottom_ = end_ - (bottomRow_ ? kRow : 0) - (nanRow_ ? kRow : 0) - (missingRow_ ? kRow : 0);
    bottom_ = std::max(bottom_, top_ + 10);
}

double ParallelFrame::x(std::size_t axis) const { return left_ + (count_ > 1 ? double(axis) * spacing_ : 0); }

double ParallelFrame::nanCenter() const { return bottom_ + (bottomRow_ ? kRow : 0) + kRow / 2; }

double ParallelFrame::missingCenter() const { return bottom_ + (bottomRow_ ? kRow : 0) + (nanRow_ ? kRow : 0) + kRow / 2; }

double ParallelFrame::position(const ParallelAxis& axis, double value) const {
    const double part = axis.scale.range.position(value);
    return axis.wish.flipped ? top_ + part * (bottom_ - top_) : bottom_ - part * (bottom_ - top_);
}

double ParallelFrame::y(const ParallelAxis& axis, Index path) const {
    if (path >= axis.values.size()) return missingCenter();
    const double value = axis.values.numbers[path];
    switch (axis.scale.place(value, axis.values.known[path] != 0)) {
        case AxisPlace::above: return axis.wish.flipped ? bottomRowCenter() : topRowCenter();
        case AxisPlace::below: return axis.wish.flipped ? topRowCenter() : bottomRowCenter();
        case AxisPlace::nan: return nanCenter();
        case AxisPlace::missing: return missingCenter();
        case AxisPlace::inside: break;
    }
    if (!axis.isText()) return position(axis, value);
    // The golden ratio spreads any run of paths evenly.
    const double spread = std::fmod(path * 0.6180339887498949, 1.0) - 0.5;
    return position(axis, value) + spread * 0.55 * (bottom_ - top_) / double(axis.values.categories.size());
}

double ParallelFrame::value(const ParallelAxis& axis, double y) const {
    const double part = (y - top_) / (bottom_ - top_);
    return axis.scale.range.value(axis.wish.flipped ? part : 1 - part);
}

query::Brush ParallelFrame::brush(const ParallelAxis& axis, double from, double to) const {
    query::Brush brush{kInfinity, -kInfinity};   // no number
    const double upper = std::min(from, to), lower = std::max(from, to);
    const auto touches = [&](bool there, double center) { return there && upper < center + kRow / 2 - 1 && lower > center - kRow / 2 + 1; };
    brush.nan = touches(nanRow_, nanCenter());
    brush.missing = touches(missingRow_, missingCenter());
    const bool flipped = axis.wish.flipped;
    const auto rounded = [&](double y) {
        return analysis::roundedWithin(value(axis, y), std::abs(value(axis, y + 0.5) - value(axis, y - 0.5)) / 2);
    };
    if (lower >= top_ && upper <= bottom_) {
        const double atUpper = upper < top_ - 1 ? (flipped ? -kInfinity : kInfinity) : rounded(std::max(upper, top_));
        const double atLower = lower > bottom_ + 1 ? (flipped ? kInfinity : -kInfinity) : rounded(std::min(lower, bottom_));
        brush.low = std::min(atUpper, atLower);
        brush.high = std::max(atUpper, atLower);
        return brush;
    }
    // Only a row at an end: what is there, and nothing of the scale.
    const bool above = lower < top_ ? !flipped : upper < bottom_ + kRow && flipped && bottomRow_;
    const bool below = lower < top_ ? flipped : upper < bottom_ + kRow && !flipped && bottomRow_;
    if (above && axis.scale.above > 0) brush.low = axis.scale.leastAbove, brush.high = kInfinity;
    if (below && axis.scale.below > 0) brush.low = -kInfinity, brush.high = axis.scale.greatestBelow;
    return brush;
}

QRectF ParallelFrame::brushRect(std::size_t i, const ParallelAxis& axis, const query::Brush& brush) const {
    if (!brush.hasNumbers()) return {};
    const auto end = [&](double value) {
        const bool upwards = (value > axis.scale.range.max) != axis.wish.flipped;
        if (value > axis.scale.range.max || value < axis.scale.range.min || !(axis.scale.range.position(value) > -kInfinity))
            return upwards ? top_ - (topRow_ ? kRow : 0) : bottom_ + (bottomRow_ ? kRow : 0);
        return position(axis, value);
    };
    double a = end(brush.low), b = end(brush.high);
    if (brush.low > axis.scale.range.max) a = axis.wish.flipped ? bottom_ : top_;
    if (brush.high < axis.scale.range.min) b = axis.wish.flipped ? top_ : bottom_;
    // Of one category its whole room; of anything else at least something to grab.
    double least = 5;
    if (axis.isText() || axis.values.integral) {
        const double each = std::abs(position(axis, 1) - position(axis, 0));
        if (!axis.isLog()) least = std::max(least, std::min(each * 0.7, 28.0));
    }
    const double upper = std::min(a, b), lower = std::max(a, b), more = std::max(0.0, least - (lower - upper)) / 2;
    return {x(i) - 6, upper - more, 12, lower - upper + 2 * more};
}

QRectF ParallelFrame::rowRect(std::size_t i, double center) const { return {x(i) - 6, center - kRow / 2 + 2, 12, kRow - 4}; }

std::size_t ParallelFrame::nearestAxis(double x) const {
    if (count_ == 0) return 0;
    const double at = std::round((x - left_) / std::max(spacing_, 1e-9));
    return static_cast<std::size_t>(std::clamp(at, 0.0, double(count_ - 1)));
}

bool ParallelFrame::onAxis(std::size_t axis, QPointF position) const {
    return axis < count_ && std::abs(position.x() - x(axis)) <= std::min(kGrab, spacing_ / 3) && position.y() >= kHeader;
}

QRectF ParallelFrame::header(std::size_t axis) const {
    const double half = std::min(spacing_ / 2, 110.0);
    const double from = std::max(0.0, x(axis) - half), to = std::min(canvas_.width(), x(axis) + half);
    return {from, 0, to - from, kHeader};
}

}  // namespace emca::explorer
