#include "plots/plot_overlay.h"

#include <QPainter>
#include <cmath>

#include "base/bubble.h"
#include "base/theme.h"
#include "plots/edge_marks.h"
#include "plots/points_item.h"

namespace emca::explorer {

PlotOverlay::PlotOverlay(const ScatterContent& content, const Theme& theme, QWidget* canvas)
    : QWidget(canvas), content_(content), theme_(theme) {
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

QRect PlotOverlay::roomOf(std::uint32_t point) const {
    if (point >= content_.xs.size()) return {};
    const double y = content_.ys[point];
    const auto at = content_.frame.place(content_.xs[point], y);
    if (!at) return {};
    const int h = int(PlotFrame::kRowHeight) / 2 + 2;
    if (content_.frame.row(y) != PlotRow::inside) return QRect(0, int(at->y()) - h, width(), 2 * h);
    const double r = PointsItem::radius(content_.xs.size()) + 7;
    return QRectF(at->x() - r, at->y() - r, 2 * r, 2 * r).toAlignedRect();
}

QRegion PlotOverlay::markedRegion() const {
    constexpr std::size_t kFew = 64;
    if (content_.selected.size() > kFew) return rect();
    QRegion region;
    for (const std::uint32_t point : content_.selected) region += roomOf(point);
    if (content_.current) region += roomOf(*content_.current);
    return region;
}

void PlotOverlay::paintSelected(QPainter& painter) const {
    const ThemeColors& c = theme_.colors();
    const double r = PointsItem::radius(content_.xs.size()) + 1, half = std::ceil(r + 1.5);
    const bool shapes = keepsShapes(painter);
    QPixmap dot;
    if (!shapes) dot = dotStamp(c.selected, r, c.halo, painter.device()->devicePixelRatioF());
    painter.setPen(QPen(c.halo, 1));
    painter.setBrush(c.selected);
    for (const std::uint32_t i : content_.selected) {
        if (content_.frame.row(content_.ys[i]) != PlotRow::inside) continue;   // edge marks draw it
        const auto at = content_.frame.place(content_.xs[i], content_.ys[i]);
        if (!at) continue;
        if (shapes) painter.drawEllipse(*at, r, r);
        else painter.drawPixmap(QPointF(at->x() - half, at->y() - half), dot);
    }
}

void PlotOverlay::paintCurrent(QPainter& painter) const {
    if (!content_.current || *content_.current >= content_.xs.size()) return;
    const std::uint32_t i = *content_.current;
    const std::optional<QPointF> at = content_.frame.place(content_.xs[i], content_.ys[i]);
    if (!at) return;
    // A ring around the dot, so that one finds it among hundreds.
    const ThemeColors& c = theme_.colors();
    painter.setBrush(Qt::NoBrush);
    const double r = PointsItem::radius(content_.xs.size()) + 4;
    painter.setPen(QPen(c.halo, 3.5));
    painter.drawEllipse(*at, r, r);
    painter.setPen(QPen(c.selected, 1.75));
    painter.drawEllipse(*at, r, r);
}

void PlotOverlay::paintEvent(QPaintEvent*) {
    if (content_.xs.empty() && !rectangle_) return;
    QPainter painter(this);
    const ThemeColors& c = theme_.colors();
    painter.setRenderHint(QPainter::Antialiasing);
    paintSelected(painter);
    paintEdgeMarks(painter, content_, theme_);
    paintCurrent(painter);
    if (position_) {
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(QPen(c.border, 1));
        painter.drawLine(QPointF(position_->x(), 0), QPointF(position_->x(), height()));
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(c.halo, 3.5));
        painter.drawEllipse(*position_, radius_, radius_);
        painter.setPen(QPen(c.hover, 1.75));
        painter.drawEllipse(*position_, radius_, radius_);
        if (!text_.isEmpty()) paintBubble(painter, theme_, text_, *position_, radius_ + 8, size());
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

}  // namespace emca::explorer
