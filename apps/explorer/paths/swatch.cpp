#include "paths/swatch.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/theme.h"

namespace emca::explorer {

void paintSwatch(QPainter& painter, const QRect& rect, Color color, const analysis::ToneMapper& mapper,
                 const Theme& theme) {
    const ThemeColors& c = theme.colors();
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(theme.smallNumberFont());
    const QRectF frame = QRectF(rect).adjusted(0.5, 0.5, -0.5, -0.5);
    if (!isFinite(color)) {
        painter.setPen(QPen(c.warning, 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(frame, 2, 2);
        const bool nan = std::isnan(color.r) || std::isnan(color.g) || std::isnan(color.b);
        painter.drawText(rect, Qt::AlignCenter, nan ? QStringLiteral("NaN") : QStringLiteral("Inf"));
        painter.restore();
        return;
    }
    const analysis::Color8 shown =
        mapper.color({std::max(color.r, 0.f), std::max(color.g, 0.f), std::max(color.b, 0.f)});
    const QColor fill(shown.r, shown.g, shown.b);
    painter.setPen(QPen(c.border, 1));
    painter.setBrush(fill);
    painter.drawRoundedRect(frame, 2, 2);
    if (mapper.clips(color)) {
        const double stops = std::log2(double(maxComponent(color))) + double(mapper.settings().exposure);
        painter.setPen(fill.lightnessF() > 0.55 ? QColor("#1a1b1d") : QColor("#f5f5f5"));
        painter.drawText(rect, Qt::AlignCenter,
                         QStringLiteral("+") + QString::number(stops, 'f', stops < 9.95 ? 1 : 0));
    }
    if (std::min({color.r, color.g, color.b}) < 0) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.warning);
        painter.drawRect(QRectF(frame.left(), frame.bottom() - 2, frame.width(), 2));
    }
    painter.restore();
}

}  // namespace emca::explorer
