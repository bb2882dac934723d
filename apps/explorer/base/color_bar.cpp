#include "base/color_bar.h"

#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/seen_on.h"
#include "base/theme.h"
#include "emca/analysis/statistics.h"

namespace emca::explorer {
namespace {

constexpr double kTickRoom = 40;   ///< pixels of height per labelled tick

QRectF barOf(const QRectF& rect, const ColorBarContent& content) {
    const double top = content.label.isEmpty() ? 14 : 28;
    return {rect.x() + Spacing::small + (content.title.isEmpty() ? 0 : 4), rect.y() + top, 14, rect.height() - top - 14};
}

void paintTitle(QPainter& painter, const QRectF& rect, const QRectF& bar, const QString& title) {
    painter.save();
    painter.translate(rect.right() - 20, bar.bottom());
    painter.rotate(-90);
    const QFontMetricsF metrics(painter.font());
    painter.drawText(QRectF(0, 0, bar.height(), 18), Qt::AlignCenter, metrics.elidedText(title, Qt::ElideRight, bar.height()));
    painter.restore();
}

}  // namespace

void paintColorBar(QPainter& painter, const QRectF& rect, const ColorBarContent& content, const Theme& theme) {
    const ThemeColors& c = theme.colors();
    const analysis::ValueRange& range = content.range;
    const QRectF box = barOf(rect, content);
    if (box.height() < 20) return;
    const auto entries = analysis::ColorMap::get(content.map).entries();
    QImage strip(1, 256, QImage::Format_RGB32);
    for (int i = 0; i < 256; ++i) {
        const auto entry = entries[static_cast<std::size_t>(255 - i)], e = content.ground.isValid() ? seenOn(entry, content.ground) : entry;
        strip.setPixel(0, i, qRgb(e.r, e.g, e.b));
    }
    painter.drawImage(box, strip);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(c.border);
    painter.drawRect(box);

    painter.setFont(theme.smallFont());
    painter.setPen(content.title.isEmpty() ? c.mutedText : c.text);
    if (!content.title.isEmpty()) paintTitle(painter, rect, box, content.title);
    painter.setPen(c.mutedText);
    painter.drawText(QRectF(rect.x() + Spacing::tiny, rect.y() + 4, rect.width() - 2, 18), Qt::AlignLeft | Qt::AlignVCenter,
                     content.label);
    painter.setFont(theme.smallNumberFont());
    const int room = std::max(2, static_cast<int>(box.height() / kTickRoom));
    for (const analysis::Tick& tick : content.integral && !range.log ? analysis::integerTicks(range, room) : analysis::ticks(range, room)) {
        const double y = box.bottom() - range.position(tick.value) * box.height();
        painter.setPen(c.mutedText);
        painter.drawLine(QPointF(box.right() + 1, y), QPointF(box.right() + (tick.major ? 5 : 3), y));
        if (!tick.major) continue;
        painter.setPen(c.text);
        painter.drawText(QRectF(box.right() + 8, y - 8, rect.right() - box.right() - 8, 16), Qt::AlignLeft | Qt::AlignVCenter,
                         toQString(tick.label));
    }
    if (std::isnan(content.pointer)) return;
    const double y = box.bottom() - std::clamp(range.position(content.pointer), 0.0, 1.0) * box.height();
    QPainterPath arrow;
    arrow.moveTo(box.left() + 1, y);
    arrow.lineTo(box.left() - 7, y - 4.5);
    arrow.lineTo(box.left() - 7, y + 4.5);
    arrow.closeSubpath();
    painter.fillPath(arrow, c.text);
}

ColorBar::ColorBar(Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    setToolTip(tr("Wheel: moves the end of the range that is nearer to the cursor"));
}

void ColorBar::show(analysis::ColorMapId map, const analysis::ValueRange& range, const QString& label) {
    content_.map = map;
    content_.range = range;
    content_.label = label;
    update();
}

void ColorBar::show(const ColorBarContent& content) {
    content_ = content;
    update();
}

void ColorBar::setPointer(double value) {
    if (value == content_.pointer || (std::isnan(value) && std::isnan(content_.pointer))) return;
    content_.pointer = value;
    update();
}

void ColorBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), theme_.colors().ground);
    paintColorBar(painter, rect(), content_, theme_);
}

void ColorBar::wheelEvent(QWheelEvent* event) {
    const QRectF bar = barOf(rect(), content_);
    const double t = 1 - (positionOf(*event).y() - bar.top()) / bar.height();
    const double step = event->angleDelta().y() > 0 ? 0.08 : -0.08;
    analysis::ValueRange range = content_.range;
    if (t > 0.5) range.max = range.value(1 + step);
    else range.min = range.value(step);
    if (range.isValid()) emit rangeEdited(range);
    event->accept();
}

}  // namespace emca::explorer
