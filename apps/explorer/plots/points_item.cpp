#include "plots/points_item.h"

#include <QPaintEngine>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/theme.h"

namespace emca::explorer {
namespace {

QColor withAlpha(QColor color, double alpha) {
    color.setAlphaF(alpha);
    return color;
}

}  // namespace

bool keepsShapes(const QPainter& painter) {
    return painter.paintEngine() && painter.paintEngine()->type() != QPaintEngine::Raster &&
           painter.paintEngine()->type() != QPaintEngine::OpenGL2;
}

bool ScatterContent::isSelected(std::uint32_t point) const {
    return std::binary_search(selected.begin(), selected.end(), point);
}

const QColor& ScatterContent::colorOf(std::uint32_t point) const {
    for (const ScatterGroup& group : groups)
        if (point < group.last) return group.color;
    return color;
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
    if (keepsShapes(*painter) && !content_.dense()) {
        drawDots(*painter, !content_.selected.empty());
    } else {
        drawLayer(*painter);
    }
    painter->restore();
}

QPixmap dotStamp(const QColor& color, double radius, const QColor& halo, double ratio) {
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

QColor PointsItem::dotColor(const QColor& color, bool dimmed) const {
    const std::size_t count = content_.xs.size();
    const double opaque = count <= 256 ? 0.95 : count <= 2048 ? 0.8 : 0.6;
    return withAlpha(color, dimmed ? opaque * 0.38 : opaque);
}

template <typename Draw>
void PointsItem::forGroups(Draw draw) const {
    if (content_.groups.empty()) return draw(ScatterGroup{0, static_cast<std::uint32_t>(content_.xs.size()), content_.color, false});
    for (const ScatterGroup& group : content_.groups) draw(group);
}

void PointsItem::drawLines(QPainter& painter, bool dimmed) const {
    painter.setBrush(Qt::NoBrush);
    forGroups([&](const ScatterGroup& group) {
        if (!group.connected) return;
        painter.setPen(QPen(withAlpha(group.color, dimmed ? 0.3 : 0.55), 1.25));
        std::optional<QPointF> before;   // nothing: a point before the next that is not on the canvas
        for (std::uint32_t i = group.first; i < group.last; ++i) {
            const auto at = content_.frame.row(content_.ys[i]) == PlotRow::nan ? std::nullopt : content_.frame.place(content_.xs[i], content_.ys[i]);
            if (before && at) painter.drawLine(*before, *at);
            before = at;
        }
    });
}

template <typename Draw>
void PointsItem::forInside(std::uint32_t point, Draw draw) const {
    if (content_.frame.row(content_.ys[point]) != PlotRow::inside) return;  // edge marks draw it
    if (const auto at = content_.frame.place(content_.xs[point], content_.ys[point])) draw(*at);
}

void PointsItem::drawDots(QPainter& painter, bool dimmed) const {
    const double r = radius(content_.xs.size());
    drawLines(painter, dimmed);
    painter.setPen(Qt::NoPen);
    forGroups([&](const ScatterGroup& group) {
        painter.setBrush(dotColor(group.color, dimmed));
        for (std::uint32_t i = group.first; i < group.last; ++i)
            forInside(i, [&](QPointF at) { painter.drawEllipse(at, r, r); });
    });
}

void PointsItem::drawLayer(QPainter& painter) const {
    const PlotFrame& frame = content_.frame;
    const double ratio = painter.device()->devicePixelRatioF();
    const bool dimmed = !content_.selected.empty();
    Layer& layer = layers_[dimmed];
    const bool fresh = layer.version == content_.version && layer.x == frame.x().range && layer.y == frame.y().range &&
                       layer.canvas == frame.canvas() && layer.color == content_.color &&
                       layer.image.devicePixelRatioF() == (content_.dense() ? 1 : ratio) && !layer.image.isNull();
    if (!fresh) {
        ++drawnLayers_;
        layer = {content_.dense() ? densityImage(dimmed) : dotsImage(dimmed, ratio), content_.version, frame.x().range,
                 frame.y().range, frame.canvas(), content_.color};
    }
    if (content_.dense()) {
        painter.drawImage(QRectF(QPointF(frame.x().start, frame.y().end), QPointF(frame.x().end, frame.y().start)),
                          layer.image);
    } else {
        painter.drawImage(QPointF(0, 0), layer.image);
    }
}

QImage PointsItem::dotsImage(bool dimmed, double ratio) const {
    QImage image((content_.frame.canvas() * ratio).toSize().expandedTo(QSize(1, 1)),
                 QImage::Format_ARGB32_Premultiplied);
    image.setDevicePixelRatio(ratio);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    const double r = radius(content_.xs.size()), half = std::ceil(r + 1.5);
    drawLines(painter, dimmed);
    forGroups([&](const ScatterGroup& group) {
        const QPixmap dot = dotStamp(dotColor(group.color, dimmed), r, {}, ratio);
        for (std::uint32_t i = group.first; i < group.last; ++i)
            forInside(i, [&](QPointF at) { painter.drawPixmap(QPointF(at.x() - half, at.y() - half), dot); });
    });
    return image;
}

QImage PointsItem::densityImage(bool dimmed) const {
    const PlotFrame& frame = content_.frame;
    constexpr double kCell = 2;  // pixels
    const auto cells = [](double length) { return static_cast<std::uint32_t>(std::max(1.0, length / kCell)); };
    const std::uint32_t width = cells(frame.x().end - frame.x().start), height = cells(frame.y().start - frame.y().end);
    const QColor color = withAlpha(content_.color, dimmed ? 0.5 : 1);
    const analysis::DensityGrid grid =
        analysis::densityGrid(content_.xs, content_.ys, frame.x().range, frame.y().range, width, height);
    QImage image(int(width), int(height), QImage::Format_ARGB32);
    const double scale = grid.largest > 0 ? 1 / std::log1p(double(grid.largest)) : 0;
    for (std::uint32_t row = 0; row < height; ++row) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(int(height - 1 - row)));
        for (std::uint32_t column = 0; column < width; ++column) {
            const std::uint32_t count = grid.count(column, row);
            const double alpha = count == 0 ? 0 : 0.15 + 0.85 * std::log1p(double(count)) * scale;
            line[column] = qRgba(color.red(), color.green(), color.blue(), int(alpha * color.alpha()));
        }
    }
    return image;
}

}  // namespace emca::explorer
