// What ImageCanvas paints.
#include <QPainter>
#include <QPaintEvent>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "image/image_canvas.h"

namespace emca::explorer {
namespace {

constexpr double kGridZoom = 14;      // widget pixels per image pixel from which on cells are told apart by lines
constexpr double kNumbersZoom = 72;   // from which on a cell has room for its values
constexpr double kRingZoom = 6;       // up to which invalid pixels get a ring, since they are easily missed

}  // namespace

PixelRect ImageCanvas::pixelsIn(const QRect& area, QSize image) const {
    if (image.isEmpty() || area.isEmpty()) return {};
    const QPointF first = transform_.toImage(area.topLeft());
    const QPointF last = transform_.toImage(QPointF(area.right() + 1, area.bottom() + 1));
    const auto inside = [](double v, int limit) { return static_cast<std::uint32_t>(std::clamp(v, 0.0, static_cast<double>(limit))); };
    return {inside(std::floor(first.x()), image.width()), inside(std::floor(first.y()), image.height()),
            inside(std::ceil(last.x()), image.width()), inside(std::ceil(last.y()), image.height())};
}

void ImageCanvas::paintEvent(QPaintEvent* event) {
    QPainter painter(this);
    painter.fillRect(event->rect(), theme_.colors().ground);
    if (model_.size().isEmpty()) return;
    const ImageMode mode = model_.display().mode;
    if (mode == ImageMode::split) {
        const QRect area = event->rect(), left(0, 0, splitX(), height()), right(splitX(), 0, width() - splitX(), height());
        paintSide(painter, area & left, model_.front(), model_.content());
        paintSide(painter, area & right, model_.back(), model_.backContent());
        painter.setClipping(false);
    } else {
        paintSide(painter, event->rect(), model_.front(), model_.content());
    }
    paintMarker(painter);
    if (mode == ImageMode::split) paintSplit(painter);
    if (mode == ImageMode::reference) paintTag(painter, tr("Reference: %1").arg(toQString(model_.referenceTitle())), Spacing::small, Qt::AlignLeft);
}

void ImageCanvas::paintSide(QPainter& painter, const QRect& area, const ImagePixels& pixels, const ImageContent& content) {
    if (area.isEmpty() || pixels.picture().isNull()) return;
    painter.setClipRect(area);
    paintPicture(painter, area, pixels.picture());
    if (transform_.zoom() >= kGridZoom) paintGrid(painter, area);
    if (transform_.zoom() >= kNumbersZoom && content.values) paintNumbers(painter, area, pixels.picture(), *content.values);
    if (model_.display().toneMap.markInvalid) paintInvalid(painter, pixels.invalid());
}

void ImageCanvas::paintPicture(QPainter& painter, const QRect& area, const Picture& picture) {
    const PixelRect visible = pixelsIn(area, picture.full().size());
    if (visible.empty()) return;
    const QRectF source(visible.x0, visible.y0, visible.x1 - visible.x0, visible.y1 - visible.y0);
    if (transform_.zoom() >= 1) {
        painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
        painter.drawImage(transform_.toWidget(source), picture.full(), source);
        return;
    }
    // Reduced by averaging first, so that no row of pixels falls between two screen pixels.
    const int halvings = static_cast<int>(std::floor(-std::log2(transform_.zoom())));
    const QImage& reduced = picture.reduced(halvings);
    const double sx = double(reduced.width()) / picture.full().width();
    const double sy = double(reduced.height()) / picture.full().height();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, true);
    painter.drawImage(transform_.toWidget(source), reduced,
                      QRectF(source.x() * sx, source.y() * sy, source.width() * sx, source.height() * sy));
}

void ImageCanvas::paintGrid(QPainter& painter, const QRect& area) {
    const PixelRect visible = pixelsIn(area, model_.size());
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

void ImageCanvas::paintNumbers(QPainter& painter, const QRect& area, const Picture& picture, const Image& values) {
    PixelRect visible = pixelsIn(area, picture.full().size());
    visible.x1 = std::min(visible.x1, values.width());
    visible.y1 = std::min(visible.y1, values.height());
    QFont font = theme_.smallNumberFont();
    font.setPixelSize(std::clamp(static_cast<int>(transform_.zoom() / 7), 9, 16));
    painter.setFont(font);
    // What the colour stands for: three channels, or the one number that is shown.
    const ImageStyle style = model_.display().style();
    const ResolvedChannel channel = resolve(style.channel, values);
    const bool single = style.falseColor || !channel.color || values.channelCount() < 3;
    for (std::uint32_t y = visible.y0; y < visible.y1; ++y) {
        for (std::uint32_t x = visible.x0; x < visible.x1; ++x) {
            const QColor under = picture.full().pixelColor(static_cast<int>(x), static_cast<int>(y));
            const bool bright = 0.3 * under.red() + 0.59 * under.green() + 0.11 * under.blue() > 128;
            painter.setPen(bright ? QColor(0, 0, 0, 220) : QColor(255, 255, 255, 230));
            QStringList lines;
            if (single) lines += toQString(analysis::formatNumber(double(shownNumber(values, {x, y}, style.channel))));
            else
                for (const std::uint32_t c : channel.channels) lines += toQString(analysis::formatNumber(double(values.at({x, y})[c])));
            painter.drawText(transform_.rectOf({x, y}), Qt::AlignCenter, lines.join('\n'));
        }
    }
}

void ImageCanvas::paintInvalid(QPainter& painter, const InvalidPixels& invalid) {
    if (transform_.zoom() > kRingZoom || invalid.marked.empty()) return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    const auto mark = analysis::kNaNColor;
    for (const analysis::FaultyPixel& found : invalid.marked) {
        const QPointF centre = transform_.rectOf(found.pixel).center();
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

/// A line that shows on everything, a handle in its middle, and who is at which side.
void ImageCanvas::paintSplit(QPainter& painter) {
    const double x = splitX();
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.fillRect(QRectF(x - 2, 0, 4, height()), QColor(0, 0, 0, 130));
    painter.fillRect(QRectF(x - 1, 0, 2, height()), Qt::white);
    painter.setRenderHint(QPainter::Antialiasing);
    const QPointF middle(x, height() / 2.0);
    painter.setPen(QPen(QColor(0, 0, 0, 130), 1));
    painter.setBrush(Qt::white);
    painter.drawEllipse(middle, 10, 10);
    painter.setPen(QPen(QColor(40, 40, 40), 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    for (const double side : {-1.0, 1.0}) {
        const QPointF tip = middle + QPointF(6 * side, 0);
        const QPointF arrow[] = {tip + QPointF(-3 * side, -3), tip, tip + QPointF(-3 * side, 3)};
        painter.drawPolyline(arrow, 3);
    }
    paintTag(painter, tr("Image"), static_cast<int>(x) - Spacing::small, Qt::AlignRight);
    paintTag(painter, tr("Reference"), static_cast<int>(x) + Spacing::small, Qt::AlignLeft);
}

/// \param x  where the tag begins (left) or ends (right)
void ImageCanvas::paintTag(QPainter& painter, const QString& text, int x, Qt::Alignment side) {
    painter.setFont(theme_.smallFont());
    const QFontMetrics metrics(painter.font());
    const QString shown = metrics.elidedText(text, Qt::ElideRight, std::max(60, width() / 2));
    QRect box(0, Spacing::small, metrics.horizontalAdvance(shown) + 2 * Spacing::small, metrics.height() + 6);
    if (side == Qt::AlignRight) box.moveRight(x);
    else box.moveLeft(x);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 22, 190));
    painter.drawRoundedRect(box, Spacing::radius, Spacing::radius);
    painter.setPen(QColor(240, 240, 240));
    painter.drawText(box, Qt::AlignCenter, shown);
}

}  // namespace emca::explorer
