// The hands of a ParallelCanvas: mouse and keys.
#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "parallel/parallel_canvas.h"

namespace emca::explorer {
namespace {

constexpr double kPickRadius = 6, kEnd = 5;

}  // namespace

std::optional<ParallelCanvas::BrushHit> ParallelCanvas::brushAt(QPointF position) const {
    if (axes_.size() == 0) return std::nullopt;
    const std::size_t i = frame_.nearestAxis(position.x());
    if (!frame_.onAxis(i, position)) return std::nullopt;
    const ParallelAxis& axis = axes_[i];
    for (std::size_t k = axis.brushes.size(); k-- > 0;) {
        const query::Brush& brush = axis.brushes[k];
        const QRectF box = frame_.brushRect(i, axis, brush);
        if (!box.isEmpty() && position.y() >= box.top() - kEnd && position.y() <= box.bottom() + kEnd) {
            // Ends resize, as long as there is something between them; of categories there is nothing to resize.
            const bool ends = !axis.isText() && box.height() > 3 * kEnd;
            if (ends && position.y() <= box.top() + kEnd) return BrushHit{i, k, Drag::upperEnd};
            if (ends && position.y() >= box.bottom() - kEnd) return BrushHit{i, k, Drag::lowerEnd};
            return BrushHit{i, k, Drag::moveBrush};
        }
        const bool nan = brush.nan && frame_.rowRect(i, frame_.nanCenter()).adjusted(-6, 0, 6, 0).contains(position);
        const bool missing = brush.missing && frame_.rowRect(i, frame_.missingCenter()).adjusted(-6, 0, 6, 0).contains(position);
        if (nan || missing) return BrushHit{i, k, Drag::moveBrush};
    }
    return std::nullopt;
}

std::optional<std::pair<std::size_t, ParallelCanvas::Chip>> ParallelCanvas::chipAt(QPointF position) const {
    if (!hoveredAxis_ || *hoveredAxis_ >= axes_.size()) return std::nullopt;
    for (const Chip chip : {Chip::log, Chip::flip, Chip::remove})
        if (chipRect(*hoveredAxis_, chip).contains(position)) return std::pair{*hoveredAxis_, chip};
    return std::nullopt;
}

void ParallelCanvas::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    if (event->button() != Qt::LeftButton || axes_.size() == 0) return;
    pressedAt_ = positionOf(*event);
    drag_ = Drag::pressed;
    dragAdds_ = event->modifiers() & (Qt::ShiftModifier | Qt::ControlModifier);
    dragAxis_ = frame_.nearestAxis(pressedAt_.x());
    if (frame_.header(dragAxis_).contains(pressedAt_) || frame_.onAxis(dragAxis_, pressedAt_)) currentAxis_ = dragAxis_;
    event->accept();
}

void ParallelCanvas::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = positionOf(*event);
    mouse_ = at;
    if (drag_ == Drag::none) return hoverAt(at);
    if (drag_ == Drag::pressed) {
        if ((at - pressedAt_).manhattanLength() < QApplication::startDragDistance()) return;
        hoverAt(std::nullopt);
        if (frame_.header(dragAxis_).contains(pressedAt_)) {
            drag_ = Drag::axis;
            setCursor(Qt::ClosedHandCursor);
        } else if (const auto hit = brushAt(pressedAt_); hit && !dragAdds_) {
            drag_ = hit->part;
            dragAxis_ = hit->axis;
            dragBrush_ = hit->brush;
            before_ = axes_[dragAxis_].brushes;
            grabbed_ = frame_.brushRect(dragAxis_, axes_[dragAxis_], before_[dragBrush_]);
        } else if (frame_.onAxis(dragAxis_, pressedAt_) && !axes_[dragAxis_].isEmpty()) {
            drag_ = Drag::brush;
            before_ = dragAdds_ ? axes_[dragAxis_].brushes : std::vector<query::Brush>{};
            dragBrush_ = before_.size();
            before_.emplace_back();
        } else {
            drag_ = Drag::none;
            return;
        }
    }
    if (drag_ == Drag::axis) update();
    else dragBrush(at);
}

void ParallelCanvas::dragBrush(QPointF position) {
    const ParallelAxis& axis = axes_[dragAxis_];
    std::vector<query::Brush> brushes = before_;
    query::Brush& brush = brushes[dragBrush_];
    const double moved = position.y() - pressedAt_.y();
    if (drag_ == Drag::brush) {
        brush = frame_.brush(axis, pressedAt_.y(), position.y());
    } else if (grabbed_.isEmpty()) {
        return;   // NaN and what is missing stay where they are
    } else if (drag_ == Drag::moveBrush) {
        brush = frame_.brush(axis, grabbed_.top() + moved, grabbed_.bottom() + moved);
    } else if (drag_ == Drag::upperEnd) {
        brush = frame_.brush(axis, grabbed_.bottom(), grabbed_.top() + moved);
    } else {
        brush = frame_.brush(axis, grabbed_.top(), grabbed_.bottom() + moved);
    }
    if (!brush.hasNumbers() && !brush.nan && !brush.missing) brushes.erase(brushes.begin() + std::ptrdiff_t(dragBrush_));
    axes_.setBrushes(dragAxis_, std::move(brushes));
    // What it takes is shown here at once, and to all others when the mouse lets go.
    setSelected(axes_.brushed(), std::nullopt);
    update();
    emit brushed(false);
}

void ParallelCanvas::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    const Drag finished = std::exchange(drag_, Drag::none);
    const QPointF at = positionOf(*event);
    setCursor(Qt::ArrowCursor);
    if (finished == Drag::pressed) clickAt(at, event->modifiers());
    else if (finished == Drag::axis) dropAxis(at);
    else if (finished != Drag::none) emit brushed(true);
    event->accept();
}

void ParallelCanvas::dropAxis(QPointF position) {
    moveAxis(dragAxis_, frame_.nearestAxis(position.x()));
    update();
}

void ParallelCanvas::clickAt(QPointF position, Qt::KeyboardModifiers modifiers) {
    if (const auto chip = chipAt(position)) {
        if (chip->second == Chip::log) toggleLog(chip->first);
        else if (chip->second == Chip::flip) toggleFlipped(chip->first);
        else removeAxis(chip->first);
        return;
    }
    if (const auto hit = brushAt(position)) {
        std::vector<query::Brush> brushes = axes_[hit->axis].brushes;
        brushes.erase(brushes.begin() + std::ptrdiff_t(hit->brush));
        axes_.setBrushes(hit->axis, std::move(brushes));
        update();
        emit brushed(true);
        return;
    }
    const std::size_t i = frame_.nearestAxis(position.x());
    const ParallelAxis& axis = axes_[i];
    const bool row = position.y() > frame_.bottom() || position.y() < frame_.top();
    if (frame_.onAxis(i, position) && !axis.isEmpty() && (axis.isText() || row)) {
        // One category, or one of the places beside the scale.
        query::Brush brush = frame_.brush(axis, position.y() - 0.5, position.y() + 0.5);
        if (!row) brush.low = brush.high = std::round(frame_.value(axis, position.y()));
        if (!brush.hasNumbers() && !brush.nan && !brush.missing) return;
        std::vector<query::Brush> brushes;
        if (modifiers & (Qt::ShiftModifier | Qt::ControlModifier)) brushes = axis.brushes;
        brushes.push_back(brush);
        axes_.setBrushes(i, std::move(brushes));
        update();
        emit brushed(true);
        return;
    }
    if (const auto path = lineAt(lines_, position, kPickRadius)) emit clicked(*path, modifiers);
    update();
}

void ParallelCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
    // The second press of a double click: a title turns its axis upside down.
    const QPointF at = positionOf(*event);
    if (event->button() != Qt::LeftButton || axes_.size() == 0) return;
    if (const std::size_t i = frame_.nearestAxis(at.x()); frame_.header(i).contains(at) && !chipAt(at)) toggleFlipped(i);
    else mousePressEvent(event);
}

void ParallelCanvas::hoverAt(std::optional<QPointF> position) {
    const std::optional<std::size_t> axis =
        position && axes_.size() > 0 && (frame_.header(frame_.nearestAxis(position->x())).contains(*position) ||
                                         frame_.onAxis(frame_.nearestAxis(position->x()), *position))
            ? std::optional(frame_.nearestAxis(position->x()))
            : std::nullopt;
    const std::optional<Index> path = position && !axis && position->y() > ParallelFrame::kHeader ? lineAt(lines_, *position, kPickRadius) : std::nullopt;
    hoveredAxis_ = axis;
    bubble_ = path && description_ ? description_(*path) : position ? textAt(*position) : QString();
    if (position) showCursor(*position);
    update();
    if (path == hovered_) return;
    hovered_ = path;
    emit hovered(path);
}

/// What an axis says about itself: its whole name, unit, and what is where.
QString ParallelCanvas::textAt(QPointF position) const {
    if (!hoveredAxis_ || chipAt(position)) {
        const auto chip = chipAt(position);
        if (!chip) return {};
        if (chip->second == Chip::log) return axes_[chip->first].isText() ? tr("Texts have no logarithm") : tr("Logarithmic axis (L)");
        return chip->second == Chip::flip ? tr("Turn the axis upside down (I)") : tr("Remove the axis (Delete)");
    }
    const ParallelAxis& axis = axes_[*hoveredAxis_];
    if (!frame_.header(*hoveredAxis_).contains(position)) {
        if (axis.isEmpty() || position.y() < frame_.top() || position.y() > frame_.bottom()) return {};
        if (axis.isText()) {
            const double k = std::clamp(std::round(frame_.value(axis, position.y())), 0.0, double(axis.values.categories.size() - 1));
            const auto times = std::count(axis.values.numbers.begin(), axis.values.numbers.end(), k);
            return tr("%1\n%2 paths").arg(toQString(axis.values.categories[std::size_t(k)])).arg(times);
        }
        return {};
    }
    QString text = axis.wish.expression;
    if (!axis.unit.isEmpty()) text += QStringLiteral(", ") + axis.unit;
    if (!axis.error.isEmpty()) text += '\n' + axis.error;
    const auto line = [&](std::uint32_t count, const QString& what) {
        if (count > 0) text += QStringLiteral("\n%1 %2").arg(count).arg(what);
    };
    line(axis.scale.above, tr("above the scale"));
    line(axis.scale.below, tr("below the scale"));
    line(axis.scale.nan, tr("NaN"));
    line(axis.scale.missing, tr("not recorded"));
    return text;
}

void ParallelCanvas::showCursor(QPointF position) {
    Qt::CursorShape shape = Qt::ArrowCursor;
    if (chipAt(position)) shape = Qt::PointingHandCursor;
    else if (hoveredAxis_ && frame_.header(*hoveredAxis_).contains(position)) shape = Qt::OpenHandCursor;
    else if (const auto hit = brushAt(position)) shape = hit->part == Drag::moveBrush ? Qt::SizeAllCursor : Qt::SizeVerCursor;
    else if (hoveredAxis_ && !axes_[*hoveredAxis_].isEmpty()) shape = Qt::CrossCursor;
    if (cursor().shape() != shape) setCursor(shape);
}

void ParallelCanvas::leaveEvent(QEvent*) {
    if (drag_ == Drag::none) hoverAt(std::nullopt);
}

void ParallelCanvas::contextMenuEvent(QContextMenuEvent* event) {
    const QPointF at = event->pos();
    std::optional<std::size_t> axis;
    if (axes_.size() > 0) {
        const std::size_t i = frame_.nearestAxis(at.x());
        if (frame_.header(i).contains(at) || frame_.onAxis(i, at)) axis = i;
    }
    emit menuRequested(event->globalPos(), axis, axis ? std::nullopt : lineAt(lines_, at, kPickRadius));
    event->accept();
}

bool ParallelCanvas::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        // These keys belong to the view while it has the focus, whatever the window uses them for.
        const auto& key = static_cast<QKeyEvent&>(*event);
        if (key.modifiers() == Qt::NoModifier && (key.key() == Qt::Key_L || key.key() == Qt::Key_I || key.key() == Qt::Key_Escape)) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void ParallelCanvas::keyPressEvent(QKeyEvent* event) {
    const std::optional<std::size_t> axis = currentAxis();
    const bool shift = event->modifiers() & Qt::ShiftModifier;
    switch (event->key()) {
        case Qt::Key_Left:
        case Qt::Key_Right: {
            if (axes_.size() == 0) return;
            const auto last = std::ptrdiff_t(axes_.size()) - 1, step = std::ptrdiff_t(event->key() == Qt::Key_Left ? -1 : 1);
            const std::size_t next = axis ? std::size_t(std::clamp(std::ptrdiff_t(*axis) + step, std::ptrdiff_t(0), last)) : step > 0 ? 0 : std::size_t(last);
            hoveredAxis_.reset();
            if (shift && axis) moveAxis(*axis, next);
            setCurrentAxis(next);
            break;
        }
        case Qt::Key_L:
            if (axis) toggleLog(*axis);
            break;
        case Qt::Key_I:
            if (axis) toggleFlipped(*axis);
            break;
        case Qt::Key_Delete:
            if (axis) removeAxis(*axis);
            break;
        case Qt::Key_Insert:
        case Qt::Key_Plus:
            emit addRequested();
            break;
        case Qt::Key_Escape:
            if (drag_ == Drag::axis || drag_ == Drag::none || drag_ == Drag::pressed) {
                if (std::exchange(drag_, Drag::none) == Drag::none) emit clearRequested();
                update();
            } else {
                drag_ = Drag::none;
                before_.clear();
                axes_.setBrushes(dragAxis_, {});
                emit brushed(true);
            }
            break;
        default:
            QWidget::keyPressEvent(event);
            return;
    }
    event->accept();
}

}  // namespace emca::explorer
