#include "image/color_bar.h"

#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <cmath>
#include <limits>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/statistics.h"

namespace emca::explorer {

ColorBar::ColorBar(Theme& theme, QWidget* parent)
    : QWidget(parent), theme_(theme), pointer_(std::numeric_limits<double>::quiet_NaN()) {
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    setToolTip(tr("Wheel: moves the end of the range that is nearer to the cursor"));
}

void ColorBar::show(analysis::ColorMapId map, const analysis::ValueRange& range, const QString& label) {
    map_ = map;
    range_ = range;
    label_ = label;
    update();
}

void ColorBar::setPointer(double value) {
    pointer_ = value;
    update();
}

QRectF ColorBar::bar() const { return {Spacing::small, 28, 14, height() - 42.0}; }

void ColorBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    painter.fillRect(rect(), c.ground);
    const QRectF box = bar();
    const auto entries = analysis::ColorMap::get(map_).entries();
    QImage strip(1, 256, QImage::Format_RGB32);
    for (int i = 0; i < 256; ++i) {
        const auto e = entries[static_cast<std::size_t>(255 - i)];
        strip.setPixel(0, i, qRgb(e.r, e.g, e.b));
    }
    painter.drawImage(box, strip);
    painter.setPen(c.border);
    painter.drawRect(box);

    painter.setFont(theme_.smallFont());
    painter.setPen(c.mutedText);
    painter.drawText(QRectF(Spacing::tiny, 4, width() - 2, 18), Qt::AlignLeft | Qt::AlignVCenter, label_);
    painter.setFont(theme_.smallNumberFont());
    for (const analysis::Tick& tick : analysis::ticks(range_, std::max(2, static_cast<int>(box.height() / 40)))) {
        const double y = box.bottom() - range_.position(tick.value) * box.height();
        painter.setPen(c.mutedText);
        painter.drawLine(QPointF(box.right() + 1, y), QPointF(box.right() + (tick.major ? 5 : 3), y));
        if (!tick.major) continue;
        painter.setPen(c.text);
        painter.drawText(QRectF(box.right() + 8, y - 8, width() - box.right() - 8, 16), Qt::AlignLeft | Qt::AlignVCenter,
                         toQString(tick.label));
    }
    if (std::isnan(pointer_)) return;
    const double y = box.bottom() - std::clamp(range_.position(pointer_), 0.0, 1.0) * box.height();
    QPainterPath arrow;
    arrow.moveTo(box.left() + 1, y);
    arrow.lineTo(box.left() - 7, y - 4.5);
    arrow.lineTo(box.left() - 7, y + 4.5);
    arrow.closeSubpath();
    painter.fillPath(arrow, c.text);
}

void ColorBar::wheelEvent(QWheelEvent* event) {
    const double t = 1 - (positionOf(*event).y() - bar().top()) / bar().height();
    const double step = event->angleDelta().y() > 0 ? 0.08 : -0.08;
    analysis::ValueRange range = range_;
    if (t > 0.5) range.max = range_.value(1 + step);
    else range.min = range_.value(step);
    if (range.isValid()) emit rangeEdited(range);
    event->accept();
}

}  // namespace emca::explorer
