#include "image/image_canvas.h"

#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {
namespace {

constexpr double kFocusZoom = 16;
constexpr double kSplitReach = 5;     // widget pixels from which the line can be grabbed

}  // namespace

ImageCanvas::ImageCanvas(const ImageModel& model, Theme& theme, QWidget* parent)
    : QWidget(parent), model_(model), theme_(theme) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(120, 90);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setCursor(Qt::CrossCursor);
    connect(&model_, &ImageModel::pictureChanged, this, &ImageCanvas::imageChanged);
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    imageChanged();
}

void ImageCanvas::imageChanged() {
    const double before = transform_.zoom();
    const QSize size = model_.size();
    transform_.setImageSize(size.isEmpty() ? QSizeF(0, 0) : QSizeF(size));
    if (size.isEmpty()) setHovered(std::nullopt);
    if (before != transform_.zoom()) emit zoomChanged();
    update();
}

void ImageCanvas::setMarked(std::optional<Pixel> pixel) {
    if (pixel == marked_) return;
    updatePixel(marked_);
    marked_ = pixel;
    updatePixel(marked_);
}

void ImageCanvas::updatePixel(std::optional<Pixel> pixel) {
    if (pixel) update(transform_.rectOf(*pixel).toAlignedRect().adjusted(-16, -16, 16, 16));
}

void ImageCanvas::fit() {
    transform_.fit();
    changed();
}

void ImageCanvas::zoomTo(double zoom) {
    transform_.zoomTo(zoom, zoomAnchor());
    changed();
}

void ImageCanvas::zoomBy(double factor) { zoomTo(transform_.zoom() * factor); }

QPointF ImageCanvas::zoomAnchor() const {
    const QPoint cursor = mapFromGlobal(QCursor::pos());
    return underMouse() && rect().contains(cursor) ? QPointF(cursor) : QRectF(rect()).center();
}

void ImageCanvas::focusOn(const PixelRect& area) {
    if (area.empty()) return;
    const double zoom = std::min(width() / (2.0 * (area.x1 - area.x0)), height() / (2.0 * (area.y1 - area.y0)));
    transform_.zoomTo(std::min(zoom, 2 * kFocusZoom), QRectF(rect()).center());
    transform_.centre({area.x0 + (area.x1 - area.x0) / 2, area.y0 + (area.y1 - area.y0) / 2});
    changed();
}

void ImageCanvas::focusOn(Pixel pixel) {
    if (transform_.zoom() < kFocusZoom) transform_.zoomTo(kFocusZoom, QRectF(rect()).center());
    transform_.centre(pixel);
    changed();
}

void ImageCanvas::changed() {
    update();
    emit zoomChanged();
}

void ImageCanvas::resizeEvent(QResizeEvent*) {
    transform_.setWidgetSize(size());
    emit zoomChanged();
}

void ImageCanvas::setHovered(std::optional<Pixel> pixel) {
    if (pixel == hovered_) return;
    updatePixel(hovered_);
    hovered_ = pixel;
    updatePixel(hovered_);
    emit hoverChanged();
}

int ImageCanvas::splitX() const { return static_cast<int>(std::lround(split_ * width())); }

bool ImageCanvas::isOnSplit(QPointF at) const {
    return model_.display().mode == ImageMode::split && std::abs(at.x() - splitX()) <= kSplitReach;
}

void ImageCanvas::setSplit(double share) {
    split_ = std::clamp(share, 0.0, 1.0);
    update();
}

void ImageCanvas::showCursor(QPointF at) {
    const Qt::CursorShape shape = space_ ? Qt::OpenHandCursor : isOnSplit(at) ? Qt::SplitHCursor : Qt::CrossCursor;
    if (cursor().shape() != shape) setCursor(shape);
}

void ImageCanvas::mousePressEvent(QMouseEvent* event) {
    const bool pan = event->button() == Qt::MiddleButton ||
                     (event->button() == Qt::LeftButton && (space_ || (event->modifiers() & Qt::ControlModifier)));
    if (!pan && event->button() == Qt::LeftButton && isOnSplit(positionOf(*event))) {
        splitting_ = true;
    } else if (pan) {
        panFrom_ = positionOf(*event);
        setCursor(Qt::ClosedHandCursor);
    } else if (event->button() == Qt::LeftButton) {
        pressedAt_ = positionOf(*event);
    }
}

void ImageCanvas::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = positionOf(*event);
    if (panFrom_) {
        transform_.pan(at - *panFrom_);
        panFrom_ = at;
        update();
    } else if (splitting_) {
        setSplit(at.x() / std::max(1, width()));
    } else {
        showCursor(at);
    }
    setHovered(transform_.pixelAt(at));
}

void ImageCanvas::mouseReleaseEvent(QMouseEvent* event) {
    if (panFrom_) {
        panFrom_.reset();
        setCursor(space_ ? Qt::OpenHandCursor : Qt::CrossCursor);
        return;
    }
    if (splitting_ && event->button() == Qt::LeftButton) {
        splitting_ = false;
        return;
    }
    if (event->button() != Qt::LeftButton || !pressedAt_) return;
    // The pixel under the press counts: a hand that trembles by a pixel or two still means it.
    const QPointF pressed = *pressedAt_;
    pressedAt_.reset();
    const bool still = (positionOf(*event) - pressed).manhattanLength() < 6;
    if (const auto pixel = transform_.pixelAt(pressed); pixel && still) emit clicked(*pixel);
}

void ImageCanvas::wheelEvent(QWheelEvent* event) {
    const double steps = (event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x()) / 120.0;
    transform_.zoomTo(transform_.zoom() * std::pow(1.25, steps), positionOf(*event));
    setHovered(transform_.pixelAt(positionOf(*event)));
    changed();
    event->accept();
}

void ImageCanvas::leaveEvent(QEvent*) { setHovered(std::nullopt); }

void ImageCanvas::keyPressEvent(QKeyEvent* event) {
    const auto step = [&](int dx, int dy) {
        const QSize size = model_.size();
        if (!marked_ || size.isEmpty()) return;
        const auto x = std::clamp(static_cast<int>(marked_->x) + dx, 0, size.width() - 1);
        const auto y = std::clamp(static_cast<int>(marked_->y) + dy, 0, size.height() - 1);
        emit clicked(Pixel{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)});
    };
    switch (event->key()) {
        case Qt::Key_Plus: case Qt::Key_Equal: zoomBy(1.25); break;
        case Qt::Key_Minus: zoomBy(1 / 1.25); break;
        case Qt::Key_0: case Qt::Key_Home: fit(); break;
        case Qt::Key_1: zoomTo(1); break;
        case Qt::Key_Left: step(-1, 0); break;
        case Qt::Key_Right: step(1, 0); break;
        case Qt::Key_Up: step(0, -1); break;
        case Qt::Key_Down: step(0, 1); break;
        case Qt::Key_Space:
            if (!event->isAutoRepeat()) {
                space_ = true;
                setCursor(Qt::OpenHandCursor);
            }
            break;
        default: QWidget::keyPressEvent(event);
    }
}

void ImageCanvas::keyReleaseEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Space || event->isAutoRepeat()) {
        QWidget::keyReleaseEvent(event);
        return;
    }
    space_ = false;
    if (!panFrom_) setCursor(Qt::CrossCursor);
}

void ImageCanvas::contextMenuEvent(QContextMenuEvent* event) {
    if (const auto pixel = transform_.pixelAt(event->pos())) emit contextMenuWanted(*pixel, event->globalPos());
}

}  // namespace emca::explorer
