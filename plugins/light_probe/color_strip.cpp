#include "color_strip.h"

#include <QPainter>
#include <algorithm>

#include "emca/analysis/statistics.h"

namespace emca::light_probe {

void ColorStrip::show(analysis::ColorMapId map, const analysis::ValueRange& range) {
    map_ = map;
    range_ = range.repaired();
    update();
}

void ColorStrip::setPointer(double value) {
    pointer_ = value;
    update();
}

void ColorStrip::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const explorer::ThemeColors& colors = context_.colors();
    const QRectF bar(12, 6, width() - 24, 10);
    const auto entries = analysis::ColorMap::get(map_).entries();
    QImage line(static_cast<int>(entries.size()), 1, QImage::Format_RGB32);
    for (int i = 0; i < line.width(); ++i) line.setPixel(i, 0, qRgb(entries[i].r, entries[i].g, entries[i].b));
    painter.drawImage(bar, line);
    painter.setPen(QPen(colors.border, 1));
    painter.drawRect(bar.adjusted(-0.5, -0.5, 0.5, 0.5));

    painter.setFont(context_.smallNumberFont());
    double free = -1e9;
    for (const analysis::Tick& tick : analysis::ticks(range_, std::max(2, width() / 70))) {
        const double x = bar.left() + range_.position(tick.value) * bar.width();
        painter.setPen(QPen(colors.mutedText, 1));
        painter.drawLine(QPointF(x, bar.bottom() + 1), QPointF(x, bar.bottom() + (tick.major ? 5 : 3)));
        const QString label = QString::fromStdString(tick.label);
        const double half = painter.fontMetrics().horizontalAdvance(label) / 2.0;
        const double middle = std::clamp(x, half, width() - half);
        if (label.isEmpty() || middle - half < free + 4) continue;
        painter.drawText(QRectF(middle - half - 1, bar.bottom() + 4, 2 * half + 2, 14), Qt::AlignCenter, label);
        free = middle + half;
    }
    if (std::isnan(pointer_)) return;
    const double x = bar.left() + std::clamp(range_.position(pointer_), 0.0, 1.0) * bar.width();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colors.text);
    painter.drawPolygon(QPolygonF({QPointF(x - 4, 0), QPointF(x + 4, 0), QPointF(x, 6)}));
}

}  // namespace emca::light_probe
