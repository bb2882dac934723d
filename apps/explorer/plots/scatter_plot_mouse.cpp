// The hands of a ScatterPlot: mouse and keys.

#include <qwt_plot.h>
#include <qwt_scale_widget.h>
#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "plots/plot_overlay.h"
#include "plots/scatter_plot.h"

namespace emca::explorer {
namespace {

constexpr double kPickRadius = 8;
constexpr double kWheelStep = 1.2;  ///< per notch

}  // namespace

std::optional<std::uint32_t> ScatterPlot::pointAt(QPointF position) const {
    // Selected points are drawn on top, so they come first where several are under the cursor.
    const auto distance = [&](std::uint32_t i) {
        const auto at = content_.frame.place(content_.xs[i], content_.ys[i]);
        return at ? std::hypot(at->x() - position.x(), at->y() - position.y()) : 1e9;
    };
    const auto nearest = content_.frame.nearest(content_.xs, content_.ys, position, kPickRadius);
    if (!nearest || content_.isSelected(*nearest)) return nearest;
    for (const std::uint32_t i : content_.selected)
        if (distance(i) <= distance(*nearest)) return i;
    return nearest;
}

bool ScatterPlot::eventFilter(QObject* watched, QEvent* event) {
    const bool onCanvas = watched == plot_->canvas();
    switch (event->type()) {
        case QEvent::Resize:
            if (onCanvas) layoutFrame();
            break;
        case QEvent::MouseButtonPress:
            return onCanvas && press(static_cast<QMouseEvent&>(*event));
        case QEvent::MouseMove:
            return onCanvas && move(static_cast<QMouseEvent&>(*event));
        case QEvent::MouseButtonRelease:
            return onCanvas && release(static_cast<QMouseEvent&>(*event));
        case QEvent::MouseButtonDblClick:
            if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) break;
            ignoreRelease_ = true;
            emit zoomResetRequested();
            return true;
        case QEvent::Leave:
            if (onCanvas) hoverAt(std::nullopt);
            break;
        case QEvent::Wheel: {
            auto& wheel = static_cast<QWheelEvent&>(*event);
            // Alt and Shift turn the wheel sideways on some systems.
            const int delta = wheel.angleDelta().y() != 0 ? wheel.angleDelta().y() : wheel.angleDelta().x();
            const bool onX =
                watched == plot_->axisWidget(QwtPlot::xBottom) || (wheel.modifiers() & Qt::ControlModifier);
            const bool onY = watched == plot_->axisWidget(QwtPlot::yLeft) || (wheel.modifiers() & Qt::ShiftModifier);
            const QPointF at = plot_->canvas()->mapFrom(static_cast<QWidget*>(watched), positionOf(wheel).toPoint());
            zoomBy(at, std::pow(kWheelStep, -delta / 120.0), !onY || onX, !onX || onY);
            return true;
        }
        case QEvent::ContextMenu: {
            if (!onCanvas) break;
            auto& menu = static_cast<QContextMenuEvent&>(*event);
            emit menuRequested(menu.globalPos(), pointAt(menu.pos()));
            return true;
        }
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

bool ScatterPlot::press(QMouseEvent& event) {
    setFocus(Qt::MouseFocusReason);
    pressedAt_ = lastAt_ = positionOf(event);
    ignoreRelease_ = false;
    if (event.button() == Qt::MiddleButton ||
        (event.button() == Qt::LeftButton && (event.modifiers() & Qt::AltModifier) && !rectangleKey_)) {
        drag_ = Drag::moving;
        plot_->canvas()->setCursor(Qt::ClosedHandCursor);
    } else if (event.button() == Qt::LeftButton) {
        drag_ = Drag::pressed;
    } else {
        return false;
    }
    return true;
}

bool ScatterPlot::move(QMouseEvent& event) {
    const QPointF at = positionOf(event);
    if (drag_ == Drag::none) {
        hoverAt(at);
        return true;
    }
    if (drag_ == Drag::pressed && (at - pressedAt_).manhattanLength() >= QApplication::startDragDistance()) {
        drag_ = Drag::rectangle;
        hoverAt(std::nullopt);
    }
    if (drag_ == Drag::rectangle) overlay_->setRectangle(QRectF(pressedAt_, at).normalized());
    if (drag_ == Drag::moving) moveBy(at - lastAt_);
    lastAt_ = at;
    return true;
}

bool ScatterPlot::release(QMouseEvent& event) {
    const Drag finished = std::exchange(drag_, Drag::none);
    plot_->canvas()->setCursor(Qt::ArrowCursor);
    overlay_->setRectangle(std::nullopt);
    if (std::exchange(ignoreRelease_, false)) return true;
    if (finished == Drag::rectangle) {
        rectangleKey_ = false;
        const auto points = content_.frame.inside(content_.xs, content_.ys, QRectF(pressedAt_, positionOf(event)));
        emit areaSelected(QVector<quint32>(points.begin(), points.end()),
                          event.modifiers() & (Qt::ShiftModifier | Qt::ControlModifier));
    } else if (finished == Drag::pressed) {
        if (const auto point = pointAt(positionOf(event))) emit clicked(*point, event.modifiers());
    }
    return true;
}

void ScatterPlot::startRectangle() {
    rectangleKey_ = true;
    plot_->canvas()->setCursor(Qt::CrossCursor);
}

void ScatterPlot::zoomBy(QPointF position, double factor, bool x, bool y) {
    const auto apply = [&](std::optional<analysis::ValueRange>& zoom, const AxisFrame& axis,
                           const analysis::ValueRange& full, double pixel, bool integral) {
        const double at = std::clamp((pixel - axis.start) / (axis.end - axis.start), 0.0, 1.0);
        const analysis::ValueRange next = zoomed(axis.range, at, factor);
        if (!next.isValid()) return;
        const double part = full.position(next.max) - full.position(next.min);
        if (factor < 1 && (part < 1e-7 || (integral && next.max - next.min < 3))) return;
        if (factor > 1 && part > 1e4) return;
        zoom = next;
    };
    if (x) apply(xZoom_, content_.frame.x(), xFull_, position.x(), xAxis_.integral);
    if (y) apply(yZoom_, content_.frame.y(), yFull_, position.y(), yAxis_.integral);
    // Out again beyond all samples: that is no zoom.
    if (xZoom_ && factor > 1 && xZoom_->min <= xFull_.min && xZoom_->max >= xFull_.max) xZoom_.reset();
    layoutFrame();
    emit zoomChanged();
}

void ScatterPlot::moveBy(QPointF distance) {
    const AxisFrame &x = content_.frame.x(), &y = content_.frame.y();
    const analysis::ValueRange nextX = moved(x.range, -distance.x() / (x.end - x.start));
    const analysis::ValueRange nextY = moved(y.range, -distance.y() / (y.end - y.start));
    if (nextX.isValid() && distance.x() != 0) xZoom_ = nextX;
    if (nextY.isValid() && distance.y() != 0) yZoom_ = nextY;
    layoutFrame();
    emit zoomChanged();
}

void ScatterPlot::hoverAt(std::optional<QPointF> position) {
    const std::optional<std::uint32_t> point = position ? pointAt(*position) : std::nullopt;
    hoveredHere_ = point.has_value();
    if (point == hovered_) return showHovered();
    hovered_ = point;
    showHovered();
    emit hovered(point);
}

bool ScatterPlot::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        // These keys belong to the plot while it has the focus, whatever the window uses them for.
        const auto& key = static_cast<QKeyEvent&>(*event);
        if (key.modifiers() == Qt::NoModifier &&
            (key.key() == Qt::Key_L || key.key() == Qt::Key_R || key.key() == Qt::Key_Home)) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void ScatterPlot::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_L:
            emit logToggled();
            break;
        case Qt::Key_R:
            startRectangle();
            break;
        case Qt::Key_Home:
            emit zoomResetRequested();
            break;
        case Qt::Key_Escape:
            if (drag_ != Drag::none || rectangleKey_) {
                drag_ = Drag::none;
                rectangleKey_ = false;
                overlay_->setRectangle(std::nullopt);
                plot_->canvas()->setCursor(Qt::ArrowCursor);
            } else {
                emit clearRequested();
            }
            break;
        default:
            QWidget::keyPressEvent(event);
            return;
    }
    event->accept();
}

}  // namespace emca::explorer
