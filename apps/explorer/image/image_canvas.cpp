#include "image/image_canvas.h"

#include <QPainter>
#include <QPaintEvent>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

constexpr double kGridZoom = 14;      // widget pixels per image pixel from which on cells are told apart by lines
constexpr double kNumbersZoom = 72;   // from which on a cell has room for its values
constexpr double kRingZoom = 6;       // up to which invalid pixels get a ring, since they are easily missed
constexpr double kFocusZoom = 16;

}  // namespace

ImageCanvas::ImageCanvas(ImagePixels& pixels, Theme& theme, QWidget* parent)
    : QWidget(parent), pixels_(pixels), theme_(theme) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(120, 90);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setCursor(Qt::CrossCursor);
    connect(&pixels_, &ImagePixels::pictureChanged, this, &ImageCanvas::imageChanged);
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
}

void ImageCanvas::imageChanged() {
    const auto& image = pixels_.image();
    const double before = transform_.zoom();
    transform_.setImageSize(image ? QSizeF(image->color.width(), image->color.height()) : QSizeF(0, 0));
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

void ImageCanvas::mousePressEvent(QMouseEvent* event) {
    const bool pan = event->button() == Qt::MiddleButton ||
                     (event->button() == Qt::LeftButton && (space_ || (event->modifiers() & Qt::ControlModifier)));
    if (pan) {
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
    }
    setHovered(transform_.pixelAt(at));
}

void ImageCanvas::mouseReleaseEvent(QMouseEvent* event) {
    if (panFrom_) {
        panFrom_.reset();
        setCursor(space_ ? Qt::OpenHandCursor : Qt::CrossCursor);
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
        const auto& image = pixels_.image();
        if (!marked_ || !image) return;
        const auto x = std::clamp(static_cast<int>(marked_->x) + dx, 0, static_cast<int>(image->color.width()) - 1);
        const auto y = std::clamp(static_cast<int>(marked_->y) + dy, 0, static_cast<int>(image->color.height()) - 1);
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

PixelRect ImageCanvas::pixelsIn(const QRect& area) const {
    const auto& image = pixels_.image();
    if (!image) return {};
    const QPointF first = transform_.toImage(area.topLeft());
    const QPointF last = transform_.toImage(QPointF(area.right() + 1, area.bottom() + 1));
    const auto inside = [](double v, std::uint32_t limit) {
        return static_cast<std::uint32_t>(std::clamp(v, 0.0, static_cast<double>(limit)));
    };
    return {inside(std::floor(first.x()), image->color.width()), inside(std::floor(first.y()), image->color.height()),
            inside(std::ceil(last.x()), image->color.width()), inside(std::ceil(last.y()), image->color.height())};
}

void ImageCanvas::paintEvent(QPaintEvent* event) {
    QPainter painter(this);
    painter.fillRect(event->rect(), theme_.colors().ground);
    if (pixels_.picture().isNull() || !pixels_.image()) return;
    paintPicture(painter, event->rect());
    if (transform_.zoom() >= kGridZoom) paintGrid(painter, event->rect());
    if (transform_.zoom() >= kNumbersZoom) paintNumbers(painter, event->rect());
    paintInvalid(painter);
    paintMarker(painter);
}

void ImageCanvas::paintPicture(QPainter& painter, const QRect& area) {
    const PixelRect visible = pixelsIn(area);
    if (visible.empty()) return;
    const QRectF source(visible.x0, visible.y0, visible.x1 - visible.x0, visible.y1 - visible.y0);
    if (transform_.zoom() >= 1) {
        painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
        painter.drawImage(transform_.toWidget(source), pixels_.picture(), source);
        return;
    }
    // Reduced by averaging first, so that no row of pixels falls between two screen pixels.
    const int halvings = static_cast<int>(std::floor(-std::log2(transform_.zoom())));
    const QImage& picture = pixels_.reduced(halvings);
    const double sx = double(picture.width()) / pixels_.picture().width();
    const double sy = double(picture.height()) / pixels_.picture().height();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, true);
    painter.drawImage(transform_.toWidget(source), picture,
                      QRectF(source.x() * sx, source.y() * sy, source.width() * sx, source.height() * sy));
}

void ImageCanvas::paintGrid(QPainter& painter, const QRect& area) {
    const PixelRect visible = pixelsIn(area);
    const QRectF box = transform_.toWidget(QRectF(visible.x0, visible.y0, visible.x1 - visible.x0, visible.y1 - visible.y0));
    QVector<QLineF> lines;
    for (std::uint32_t x = visible.x0; x <= visible.x1; ++x) {
        const double at = std::round(transform_.toWidget(QPointF(x, 0)).x()) + 0.5;
        lines.push_back({at, box.top(), at, box.bottom()});
    }
    for (std::uint32_t y = visible.y0; y <= visible.y1; ++y) {
        const double at = std::round(transform_.toWidget(QPointF(0, y)).y()) + 0.5;
        lines.push_back({box.left(), at, box.right(), at});
    }
    const double strength = std::min(1.0, (transform_.zoom() - kGridZoom) / 24 + 0.3);
    painter.setPen(QColor(128, 128, 128, static_cast<int>(90 * strength)));
    painter.drawLines(lines);
}

void ImageCanvas::paintNumbers(QPainter& painter, const QRect& area) {
    const PixelRect visible = pixelsIn(area);
    const Image& image = pixels_.image()->color;
    const QImage& picture = pixels_.picture();
    QFont font = theme_.smallNumberFont();
    font.setPixelSize(std::clamp(static_cast<int>(transform_.zoom() / 7), 9, 16));
    painter.setFont(font);
    const auto channels = std::min<std::uint32_t>(image.channelCount(), 3);
    for (std::uint32_t y = visible.y0; y < visible.y1; ++y) {
        for (std::uint32_t x = visible.x0; x < visible.x1; ++x) {
            const QColor under = picture.pixelColor(static_cast<int>(x), static_cast<int>(y));
            const bool bright = 0.3 * under.red() + 0.59 * under.green() + 0.11 * under.blue() > 128;
            painter.setPen(bright ? QColor(0, 0, 0, 220) : QColor(255, 255, 255, 230));
            QStringList lines;
            for (std::uint32_t c = 0; c < channels; ++c)
                lines += toQString(analysis::formatNumber(double(image.at({x, y})[c])));
            painter.drawText(transform_.rectOf({x, y}), Qt::AlignCenter, lines.join('\n'));
        }
    }
}

void ImageCanvas::paintInvalid(QPainter& painter) {
    if (transform_.zoom() > kRingZoom || pixels_.invalid().count() == 0) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    const auto mark = analysis::kNaNColor;
    for (const Pixel pixel : pixels_.invalid().pixels) {
        const QPointF centre = transform_.rectOf(pixel).center();
        if (!QRectF(rect()).adjusted(-8, -8, 8, 8).contains(centre)) continue;
        painter.setPen(QPen(QColor(0, 0, 0, 160), 3));
        painter.drawEllipse(centre, 5.5, 5.5);
        painter.setPen(QPen(QColor(mark.r, mark.g, mark.b), 1.5));
        painter.drawEllipse(centre, 5.5, 5.5);
    }
}

void ImageCanvas::paintMarker(QPainter& painter) {
    const auto frame = [&](const QRectF& box, const QColor& color, double width) {
        painter.setPen(QPen(color, width, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(box);
    };
    painter.setRenderHint(QPainter::Antialiasing);
    if (hovered_ && transform_.zoom() >= kGridZoom / 2) frame(transform_.rectOf(*hovered_), QColor(255, 255, 255, 150), 1);
    if (!marked_) return;
    // A box around the pixel and four ticks: dark, light and orange lines side by side show on whatever lies below.
    QRectF box = transform_.rectOf(*marked_);
    const double grow = std::max(0.0, (9 - box.width()) / 2);
    // On whole positions, so that lines of even width have sharp edges.
    box = QRectF(box.adjusted(-grow - 1, -grow - 1, grow + 1, grow + 1).toAlignedRect());
    const double gap = 2, tick = 7;
    const QPointF c = box.center();
    const QLineF ticks[] = {{c.x(), box.top() - gap, c.x(), box.top() - gap - tick}, {c.x(), box.bottom() + gap, c.x(), box.bottom() + gap + tick},
                            {box.left() - gap, c.y(), box.left() - gap - tick, c.y()}, {box.right() + gap, c.y(), box.right() + gap + tick, c.y()}};
    frame(box, QColor(0, 0, 0), 6);
    painter.drawLines(ticks, 4);
    frame(box, QColor(255, 255, 255), 4);
    painter.drawLines(ticks, 4);
    frame(box, theme_.colors().selected, 2);
    painter.drawLines(ticks, 4);
}

}  // namespace emca::explorer
