#include "scene_input.h"

#include <QApplication>
#include <QDateTime>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <QWidget>

#include <cmath>

#include "base/qt_compat.h"

namespace emca::explorer {
namespace {

constexpr double kRadiansPerPixel = 0.0075;
constexpr double kZoomPerNotch = 0.86;
constexpr qint64 kWheelPause = 700;   ///< milliseconds; a later turn of the wheel is a new movement for "back"

}  // namespace

SceneInput::SceneInput(QWidget& canvas, CameraDriver& driver) : QObject(&canvas), canvas_(canvas), driver_(driver) {
    canvas_.installEventFilter(this);
}

void SceneInput::setRectangleMode(bool on) {
    if (on == rectangleMode_) return;
    rectangleMode_ = on;
    if (!on && drag_ == Drag::rectangle) endDrag();
    canvas_.setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
    emit rectangleModeChanged(on);
}

bool SceneInput::eventFilter(QObject* watched, QEvent* event) {
    if (watched != &canvas_) return false;
    switch (event->type()) {
        case QEvent::MouseButtonPress: return press(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseMove: return move(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseButtonRelease: return release(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseButtonDblClick:
            if (static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton)
                emit doubleClicked(positionOf(*static_cast<QMouseEvent*>(event)));
            return true;
        case QEvent::Wheel: wheel(*static_cast<QWheelEvent*>(event)); return true;
        case QEvent::ContextMenu: return true;   // on release, unless that ends a drag
        case QEvent::Leave: emit left(); return false;
        case QEvent::FocusOut: driver_.releaseAllKeys(); return false;
        case QEvent::ShortcutOverride: {
            // While the view has the focus, its keys are its own, whatever the window makes of them elsewhere.
            auto* k = static_cast<QKeyEvent*>(event);
            if (!isOwnKey(k->key(), k->modifiers())) return false;
            k->accept();
            return true;
        }
        case QEvent::KeyPress: {
            auto* k = static_cast<QKeyEvent*>(event);
            const bool taken = key(k->key(), k->modifiers());
            if (!taken) k->ignore();   // the window's shortcuts: [ ] , . Esc
            return true;
        }
        case QEvent::KeyRelease: {
            auto* k = static_cast<QKeyEvent*>(event);
            if (!k->isAutoRepeat()) driver_.releaseKey(k->key());
            k->ignore();
            return true;
        }
        default: return false;
    }
}

bool SceneInput::press(const QMouseEvent& event) {
    if (button_ != Qt::NoButton) return true;
    canvas_.setFocus(Qt::MouseFocusReason);
    button_ = event.button();
    pressed_ = last_ = positionOf(event);
    moved_ = false;
    return true;
}

bool SceneInput::move(const QMouseEvent& event) {
    const QPointF at = positionOf(event);
    if (button_ == Qt::NoButton) {
        emit hovered(at);
        return true;
    }
    if (!moved_) {
        if ((at - pressed_).manhattanLength() < QApplication::startDragDistance() / 2.0) return true;
        moved_ = true;
        const bool shift = event.modifiers() & Qt::ShiftModifier;
        drag_ = button_ == Qt::LeftButton && rectangleMode_ ? Drag::rectangle
                : button_ == Qt::MiddleButton || (button_ == Qt::LeftButton && shift) ? Drag::pan
                : button_ == Qt::LeftButton ? Drag::orbit : Drag::zoom;
        if (drag_ != Drag::rectangle) driver_.remember();
        emit dragging(true);
    }
    const QPointF d = at - last_;
    last_ = at;
    const Viewport viewport{std::max(canvas_.width(), 1), std::max(canvas_.height(), 1)};
    const ViewPose& pose = driver_.pose();
    switch (drag_) {
        case Drag::orbit:
            driver_.moveTo(orbited(pose, pivot_ ? pivot_() : pose.focus, upAxis_, -d.x() * kRadiansPerPixel,
                                   -d.y() * kRadiansPerPixel));
            break;
        case Drag::pan: driver_.moveTo(panned(pose, viewport, d.x(), d.y())); break;
        case Drag::zoom:
            driver_.moveTo(zoomed(pose, viewport, std::pow(1.006, d.y()), pressed_.x(), pressed_.y()));
            break;
        case Drag::rectangle: emit rectangleDragged(QRectF(pressed_, at).normalized()); break;
        case Drag::none: break;
    }
    return true;
}

bool SceneInput::release(const QMouseEvent& event) {
    if (event.button() != button_) return true;
    const bool wasClick = !moved_;
    const bool wasRectangle = drag_ == Drag::rectangle;
    const Qt::MouseButton button = button_;
    const QPointF at = positionOf(event);
    endDrag();
    if (wasRectangle) {
        setRectangleMode(false);
        emit rectangleSelected(QRectF(pressed_, at).normalized(), event.modifiers());
    } else if (wasClick && button == Qt::LeftButton) {
        emit clicked(at, event.modifiers());
    } else if (wasClick && button == Qt::RightButton) {
        emit menuRequested(at, globalPositionOf(event));
    }
    return true;
}

void SceneInput::endDrag() {
    const bool was = drag_ != Drag::none;
    if (drag_ == Drag::rectangle) emit rectangleDragged({});
    drag_ = Drag::none;
    button_ = Qt::NoButton;
    if (was) emit dragging(false);
}

void SceneInput::wheel(const QWheelEvent& event) {
    const qint64 now = QDateTime::currentMSecsSinceEpoch();
    if (!lastWheel_ || now - *lastWheel_ > kWheelPause) driver_.remember();
    lastWheel_ = now;
    const double notches = event.angleDelta().y() / 120.0;
    const QPointF at = positionOf(event);
    driver_.moveTo(zoomed(driver_.pose(), {std::max(canvas_.width(), 1), std::max(canvas_.height(), 1)},
                          std::pow(kZoomPerNotch, notches), at.x(), at.y()));
}

bool SceneInput::isOwnKey(int key, Qt::KeyboardModifiers modifiers) {
    if (modifiers & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
    switch (key) {
        case Qt::Key_W: case Qt::Key_A: case Qt::Key_S: case Qt::Key_D: case Qt::Key_Q: case Qt::Key_E:
        case Qt::Key_Up: case Qt::Key_Down: case Qt::Key_Left: case Qt::Key_Right: case Qt::Key_PageUp: case Qt::Key_PageDown:
        case Qt::Key_Home: case Qt::Key_Backspace: case Qt::Key_O: case Qt::Key_X: case Qt::Key_P: return true;
        default: return false;
    }
}

bool SceneInput::key(int key, Qt::KeyboardModifiers modifiers) {
    if (modifiers & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
    if (driver_.pressKey(key, modifiers & Qt::ShiftModifier)) return true;
    switch (key) {
        case Qt::Key_R: setRectangleMode(!rectangleMode_); return true;
        case Qt::Key_F: emit focusRequested(); return true;
        case Qt::Key_Home: emit resetRequested(); return true;
        case Qt::Key_Backspace: emit backRequested(); return true;
        case Qt::Key_O: emit orthographicRequested(); return true;
        case Qt::Key_X: emit clipRequested(); return true;
        case Qt::Key_P: emit pictureRequested(); return true;
        case Qt::Key_Escape:
            if (!rectangleMode_) return false;
            setRectangleMode(false);
            return true;
        default: return false;
    }
}

}  // namespace emca::explorer
