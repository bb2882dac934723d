#include "plots/plot_overlay.h"

#include <QPainter>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {

PlotOverlay::PlotOverlay(const Theme& theme, QWidget* canvas) : QWidget(canvas), theme_(theme) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
}

void PlotOverlay::setHovered(std::optional<QPointF> position, double radius, const QString& text) {
    if (position == position_ && text == text_) return;
    position_ = position;
    radius_ = radius;
    text_ = text;
    update();
}

void PlotOverlay::setRectangle(std::optional<QRectF> rectangle) {
    rectangle_ = rectangle;
    update();
}

void PlotOverlay::paintEvent(QPaintEvent*) {
    if (!position_ && !rectangle_) return;
    QPainter painter(this);
    const ThemeColors& c = theme_.colors();
    if (position_) {
        painter.setPen(QPen(c.border, 1));
        painter.drawLine(QPointF(position_->x(), 0), QPointF(position_->x(), height()));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(c.halo, 3.5));
        painter.drawEllipse(*position_, radius_, radius_);
        painter.setPen(QPen(c.hover, 1.75));
        painter.drawEllipse(*position_, radius_, radius_);
        if (!text_.isEmpty()) paintBubble(painter);
    }
    if (rectangle_) {
        QColor fill = c.selected;
        fill.setAlphaF(0.14);
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(QPen(c.selected, 1));
        painter.setBrush(fill);
        painter.drawRect(*rectangle_);
    }
}

void PlotOverlay::paintBubble(QPainter& painter) const {
    const ThemeColors& c = theme_.colors();
    const QFont font = theme_.smallNumberFont();
    const QRectF text = QFontMetricsF(font).boundingRect(QRectF(0, 0, 400, 200), Qt::AlignLeft, text_);
    QRectF box(0, 0, text.width() + 16, text.height() + 10);
    const double gap = radius_ + 8;
    box.moveTopLeft(QPointF(position_->x() + gap, position_->y() - box.height() / 2));
    if (box.right() > width() - 2) box.moveRight(position_->x() - gap);
    box.moveTop(std::clamp(box.top(), 2.0, std::max(2.0, height() - box.height() - 2)));
    painter.setPen(QPen(c.border, 1));
    painter.setBrush(c.raised);
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), Spacing::radius, Spacing::radius);
    painter.setFont(font);
    painter.setPen(c.text);
    painter.drawText(box.adjusted(8, 5, -8, -5), Qt::AlignLeft | Qt::AlignVCenter, text_);
}

}  // namespace emca::explorer
