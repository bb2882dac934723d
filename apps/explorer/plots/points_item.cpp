#include "plots/points_item.h"

#include <QPaintEngine>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "plots/edge_marks.h"

namespace emca::explorer {
namespace {

QColor withAlpha(QColor color, double alpha) {
    color.setAlphaF(alpha);
    return color;
}

/// Pictures and printers of vectors get circles, screens get stamps.
bool isVector(const QPainter& painter) {
    return painter.paintEngine() && painter.paintEngine()->type() != QPaintEngine::Raster &&
           painter.paintEngine()->type() != QPaintEngine::OpenGL2;
}

}  // namespace

bool ScatterContent::isSelected(std::uint32_t point) const {
    return std::binary_search(selected.begin(), selected.end(), point);
}

void GridItem::draw(QPainter* painter, const QwtScaleMap&, const QwtScaleMap&, const QRectF& canvas) const {
    const ThemeColors& c = theme_.colors();
    const PlotFrame& frame = content_.frame;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing, false);
    painter->setPen(QPen(c.grid, 1));
    for (const analysis::Tick& tick : content_.xTicks)
        if (tick.major) {
            const double x = std::round(frame.x().pixel(tick.value));
            painter->drawLine(QPointF(x, canvas.top()), QPointF(x, canvas.bottom()));
        }
    for (const analysis::Tick& tick : content_.yTicks) {
        const double y = std::round(frame.y().pixel(tick.value));
        painter->setPen(QPen(tick.major ? c.grid : withAlpha(c.grid, 0.45), 1));
        painter->drawLine(QPointF(canvas.left(), y), QPointF(canvas.right(), y));
    }
    // Edge rows are not part of the scale: a quieter ground and a line say so.
    const double h = PlotFrame::kRowHeight;
    const auto band = [&](bool there, double top) {
        if (there) painter->fillRect(QRectF(canvas.left(), top, canvas.width(), h), withAlpha(c.panel, 0.75));
    };
    band(frame.rows().above, canvas.top());
    band(frame.rows().nan, canvas.bottom() - h);
    band(frame.rows().below, canvas.bottom() - h - (frame.rows().nan ? h : 0));
    if (frame.rows().below && frame.rows().nan) {
        painter->setPen(QPen(c.ground, 1));
        painter->drawLine(QPointF(canvas.left(), canvas.bottom() - h), QPointF(canvas.right(), canvas.bottom() - h));
    }
    if (content_.mean && frame.row(*content_.mean) == PlotRow::inside) {
        const double y = std::round(frame.y().pixel(*content_.mean)) + 0.5;
        QPen pen(withAlpha(c.text, 0.55), 1);
        pen.setDashPattern({5, 4});
        painter->setPen(pen);
        painter->drawLine(QPointF(canvas.left(), y), QPointF(canvas.right(), y));
    }
    painter->restore();
}

double PointsItem::radius(std::size_t points) {
    return points <= 256 ? 3.5 : points <= 2048 ? 2.5 : points <= 20000 ? 1.75 : 1.25;
}

void PointsItem::draw(QPainter* painter, const QwtScaleMap&, const QwtScaleMap&, const QRectF& canvas) const {
    painter->save();
    painter->setClipRect(canvas);
    painter->setRenderHint(QPainter::Antialiasing);
    if (content_.dense()) {
        drawDensity(*painter);
    } else {
        drawDots(*painter, false);
    }
    drawDots(*painter, true);
    drawEdges(*painter);
    drawMean(*painter);
    drawCurrent(*painter);
    painter->restore();
}

QPixmap PointsItem::stamp(const QColor& color, double radius, const QColor& halo, double ratio) const {
    const int side = 2 * static_cast<int>(std::ceil(radius + 1.5));
    QPixmap pixmap(QSize(side, side) * ratio);
    pixmap.setDevicePixelRatio(ratio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(color);
    painter.setPen(halo.isValid() ? QPen(halo, 1) : QPen(Qt::NoPen));
    painter.drawEllipse(QPointF(side / 2.0, side / 2.0), radius, radius);
    return pixmap;
}

void PointsItem::drawDots(QPainter& painter, bool selected) const {
    const ThemeColors& c = theme_.colors();
    const std::size_t count = content_.xs.size();
    const bool dimmed = !selected && !content_.selected.empty();
    const double r = radius(count) + (selected ? 1 : 0);
    const double opaque = count <= 256 ? 0.95 : count <= 2048 ? 0.8 : 0.6;
    const QColor color = selected ? c.selected : withAlpha(content_.color, dimmed ? opaque * 0.38 : opaque);
    const QColor halo = selected ? c.halo : QColor();
    const bool vector = isVector(painter);
    QPixmap dot;
    if (!vector) dot = stamp(color, r, halo, painter.device()->devicePixelRatioF());
    const double half = std::ceil(r + 1.5);
    painter.setPen(halo.isValid() ? QPen(halo, 1) : QPen(Qt::NoPen));
    painter.setBrush(color);
    const auto one = [&](std::uint32_t i) {
        if (content_.frame.row(content_.ys[i]) != PlotRow::inside) return;  // edge marks draw it
        const std::optional<QPointF> at = content_.frame.place(content_.xs[i], content_.ys[i]);
        if (!at) return;
        if (vector) {
            painter.drawEllipse(*at, r, r);
        } else {
            painter.drawPixmap(QPointF(at->x() - half, at->y() - half), dot);
        }
    };
    if (selected) {
        for (const std::uint32_t i : content_.selected) one(i);
        return;
    }
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (next < content_.selected.size() && content_.selected[next] == i) {
            ++next;
            continue;
        }
        one(i);
    }
}

void PointsItem::drawDensity(QPainter& painter) const {
    const PlotFrame& frame = content_.frame;
    const QRectF area(QPointF(frame.x().start, frame.y().end), QPointF(frame.x().end, frame.y().start));
    constexpr double kCell = 2;
    const auto width = static_cast<std::uint32_t>(std::max(1.0, area.width() / kCell));
    const auto height = static_cast<std::uint32_t>(std::max(1.0, area.height() / kCell));
    const QColor color = content_.selected.empty() ? content_.color : withAlpha(content_.color, 0.5);
    const bool stale = densityVersion_ != content_.version || !(densityX_ == frame.x().range) ||
                       !(densityY_ == frame.y().range) || density_.width() != int(width) ||
                       density_.height() != int(height) || densityColor_ != color;
    if (stale) {
        const analysis::DensityGrid grid =
            analysis::densityGrid(content_.xs, content_.ys, frame.x().range, frame.y().range, width, height);
        density_ = QImage(int(width), int(height), QImage::Format_ARGB32);
        const double scale = grid.largest > 0 ? 1 / std::log1p(double(grid.largest)) : 0;
        for (std::uint32_t row = 0; row < height; ++row) {
            auto* line = reinterpret_cast<QRgb*>(density_.scanLine(int(height - 1 - row)));
            for (std::uint32_t column = 0; column < width; ++column) {
                const std::uint32_t count = grid.count(column, row);
                const double alpha = count == 0 ? 0 : 0.15 + 0.85 * std::log1p(double(count)) * scale;
                line[column] = qRgba(color.red(), color.green(), color.blue(), int(alpha * color.alpha()));
            }
        }
        densityVersion_ = content_.version;
        densityX_ = frame.x().range;
        densityY_ = frame.y().range;
        densityColor_ = color;
    }
    painter.drawImage(area, density_);
}

void PointsItem::drawEdges(QPainter& painter) const { paintEdgeMarks(painter, content_, theme_); }

void PointsItem::drawMean(QPainter& painter) const {
    if (!content_.mean || content_.frame.row(*content_.mean) != PlotRow::inside) return;
    const QString text = QStringLiteral("mean ") + toQString(analysis::formatNumber(*content_.mean));
    const QFontMetricsF metrics(theme_.smallNumberFont());
    const double line = content_.frame.y().pixel(*content_.mean), height = metrics.height();
    QRectF box(content_.frame.canvas().width() - metrics.horizontalAdvance(text) - 12, line - height - 2,
               metrics.horizontalAdvance(text) + 8, height);
    if (box.top() < content_.frame.y().end - 2) box.moveTop(line + 2);
    painter.setPen(Qt::NoPen);
    painter.setBrush(withAlpha(theme_.colors().ground, 0.85));
    painter.drawRoundedRect(box, 2, 2);
    painter.setFont(theme_.smallNumberFont());
    painter.setPen(theme_.colors().text);
    painter.drawText(box, Qt::AlignCenter, text);
}

void PointsItem::drawCurrent(QPainter& painter) const {
    if (!content_.current || *content_.current >= content_.xs.size()) return;
    const std::uint32_t i = *content_.current;
    const std::optional<QPointF> at = content_.frame.place(content_.xs[i], content_.ys[i]);
    if (!at) return;
    // A ring around the dot and its value's level, so that one finds it among hundreds.
    const ThemeColors& c = theme_.colors();
    painter.setBrush(Qt::NoBrush);
    const double r = radius(content_.xs.size()) + 4;
    painter.setPen(QPen(c.halo, 3.5));
    painter.drawEllipse(*at, r, r);
    painter.setPen(QPen(c.selected, 1.75));
    painter.drawEllipse(*at, r, r);
}

}  // namespace emca::explorer
