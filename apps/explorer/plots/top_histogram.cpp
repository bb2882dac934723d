#include "plots/top_histogram.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/grouped.h"
#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {

TopHistogram::TopHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent)
    : BarHistogram(content, content.xs, theme, parent) {
    setFixedHeight(sizeHint().height());
}

void TopHistogram::refresh(int left) {
    left_ = left;
    const AxisFrame& x = content_.frame.x();
    analysis::ValueRange range = x.range;
    std::size_t bins = std::clamp<std::size_t>(static_cast<std::size_t>((x.end - x.start) / 6), 1, 64);
    if (integral_) {
        const double first = std::ceil(range.min), last = std::max(first, std::floor(range.max));
        bins = static_cast<std::size_t>(std::clamp(last - first + 1, 1.0, double(bins)));
        const double step = std::ceil((last - first + 1) / double(bins));
        range = {first - 0.5, first - 0.5 + step * double(bins), false};
    }
    count(range, bins);
    update();
}

QRectF TopHistogram::barRect(std::size_t bar, std::uint64_t count) const {
    const AxisFrame& x = content_.frame.x();
    const double most = double(std::max<std::uint64_t>(all_.largest(), 1)), room = height() - 6;
    const double high = count == 0 ? 0 : std::max(2.0, room * double(count) / most);
    return {QPointF(left_ + x.pixel(all_.lower(bar)) + 0.5, height() - 1 - high), QPointF(left_ + x.pixel(all_.upper(bar)) - 0.5, height() - 1)};
}

void TopHistogram::paintEvent(QPaintEvent*) {
    const ThemeColors& c = theme_.colors();
    QPainter painter(this);
    painter.fillRect(rect(), c.ground);
    painter.setPen(QPen(c.grid, 1));
    painter.drawLine(left_, height() - 1, left_ + int(content_.frame.canvas().width()), height() - 1);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor color = content_.color;
    color.setAlphaF(content_.selected.empty() ? 0.75 : 0.4);
    for (std::size_t bar = 0; bar < all_.binCount(); ++bar) {
        if (all_.counts[bar] == 0) continue;
        painter.fillRect(barRect(bar, all_.counts[bar]), int(bar) == hovered_ ? c.hover : color);
        if (selected_.counts[bar] > 0) painter.fillRect(barRect(bar, selected_.counts[bar]), c.selected);
    }
}

int TopHistogram::barAt(QPointF position) const {
    for (std::size_t bar = 0; bar < all_.binCount(); ++bar) {
        const QRectF rect = barRect(bar, 1);
        if (position.x() >= rect.left() && position.x() < rect.right() + 1 && all_.counts[bar] > 0) return int(bar);
    }
    return -1;
}

QString TopHistogram::tip(std::size_t i) const {
    return tr("%1 to %2: %3").arg(toQString(analysis::formatNumber(all_.lower(i))), toQString(analysis::formatNumber(all_.upper(i))), grouped(all_.counts[i]));
}

}  // namespace emca::explorer
