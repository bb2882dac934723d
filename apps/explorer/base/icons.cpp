#include "base/icons.h"

#include <QPainter>
#include <QPainterPath>
#include <QPixmap>
#include <QVector>
#include <cmath>

#include "base/theme.h"

namespace emca::explorer {
namespace {

/// On a grid of 16 x 16.
void draw(QPainter& p, Icon symbol) {
    const auto line = [&](double x0, double y0, double x1, double y1) { p.drawLine(QPointF(x0, y0), QPointF(x1, y1)); };
    switch (symbol) {
        case Icon::link:
            p.drawEllipse(QPointF(4.5, 8), 2.6, 2.6);
            p.drawEllipse(QPointF(11.5, 8), 2.6, 2.6);
            line(7.1, 8, 8.9, 8);
            break;
        case Icon::render: {
            QPainterPath triangle(QPointF(5, 3.2));
            triangle.lineTo(12.5, 8);
            triangle.lineTo(5, 12.8);
            triangle.closeSubpath();
            p.fillPath(triangle, p.pen().color());
            p.drawPath(triangle);
            break;
        }
        case Icon::cancel: p.drawRoundedRect(QRectF(4, 4, 8, 8), 1.2, 1.2); break;
        case Icon::open:
            p.drawPolyline(QPolygonF(QVector<QPointF>{{2.5, 12.5}, {2.5, 3.8}, {6.2, 3.8}, {7.6, 5.6}, {13.5, 5.6}, {13.5, 12.5}, {2.5, 12.5}}));
            break;
        case Icon::save:
            line(8, 2.8, 8, 9.6);
            p.drawPolyline(QPolygonF(QVector<QPointF>{{5, 6.9}, {8, 9.8}, {11, 6.9}}));
            p.drawPolyline(QPolygonF(QVector<QPointF>{{2.8, 10.2}, {2.8, 13}, {13.2, 13}, {13.2, 10.2}}));
            break;
        case Icon::previous: p.drawPolyline(QPolygonF(QVector<QPointF>{{9.8, 3.8}, {5.8, 8}, {9.8, 12.2}})); break;
        case Icon::next: p.drawPolyline(QPolygonF(QVector<QPointF>{{6.2, 3.8}, {10.2, 8}, {6.2, 12.2}})); break;
        case Icon::focus:
            p.drawEllipse(QPointF(8, 8), 3.4, 3.4);
            line(8, 1.8, 8, 4.6);
            line(8, 11.4, 8, 14.2);
            line(1.8, 8, 4.6, 8);
            line(11.4, 8, 14.2, 8);
            break;
        case Icon::sun:
            p.drawEllipse(QPointF(8, 8), 2.9, 2.9);
            for (int i = 0; i < 8; ++i) {
                const double a = i * 0.78539816, c = std::cos(a), s = std::sin(a);
                line(8 + 4.8 * c, 8 + 4.8 * s, 8 + 6.3 * c, 8 + 6.3 * s);
            }
            break;
        case Icon::moon: {
            QPainterPath disc, bite;
            disc.addEllipse(QPointF(8, 8), 5.2, 5.2);
            bite.addEllipse(QPointF(10.8, 6.2), 4.6, 4.6);
            p.drawPath(disc - bite);
            break;
        }
    }
}

QPixmap pixmap(Icon symbol, const QColor& color) {
    constexpr int kScale = 3;
    QPixmap made(16 * kScale, 16 * kScale);
    made.fill(Qt::transparent);
    QPainter painter(&made);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.scale(kScale, kScale);
    painter.setPen(QPen(color, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    draw(painter, symbol);
    painter.end();
    made.setDevicePixelRatio(kScale);
    return made;
}

}  // namespace

QIcon icon(Icon symbol, const Theme& theme) {
    QIcon made(pixmap(symbol, theme.colors().text));
    QColor quiet = theme.colors().mutedText;
    quiet.setAlphaF(0.5f);
    made.addPixmap(pixmap(symbol, quiet), QIcon::Disabled);
    return made;
}

}  // namespace emca::explorer
