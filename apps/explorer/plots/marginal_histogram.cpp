#include "plots/marginal_histogram.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/grouped.h"
#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
MarginalHistogram::MarginalHistogram(const ScatterContent& content, const Theme& theme, QWidget* parent)
    : BarHistogram(content, content.ys, theme, parent), one_(tr("path")), several_(tr("paths")) {
    setFixedWidth(sizeHint().width());
}

void MarginalHistogram::setCanvas(int top, int height) {
    if (top == top_ && height == height_) return;
    top_ = top;
    height_ = height;
    refresh();
}

void MarginalHistogram::refresh() {
    const analysis::ValueRange& y = content_.frame.y().range;
    const double length = std::abs(content_.frame.y().end - content_.frame.y().start);
    analysis::ValueRange range = y;
    std::size_t bins = 1;
    if (integral_) {
        // One bar for each whole number, as long as a bar is a few pixels high.
        const double first = std::ceil(y.min), last = std::max(first, std::floor(y.max));
        const double most = std::max(1.0, length / 4), whole = last - first + 1, step = std::ceil(whole / most);
        bins = static_cast<std::size_t>(std::max(1.0, std::ceil(whole / step)));
        range = {first - 0.5, first - 0.5 + step * double(bins), false};
    } else {
        bins = std::clamp<std::size_t>(static_cast<std::size_t>(length / 6), 1, 64);
    }
    count(range, bins);
    dimmed_ = !content_.selected.empty();
    const std::uint64_t most = std::max({all_.largest(), all_.below, all_.above, all_.nan});
    roomForCount_ = 12 + QFontMetrics(theme_.smallNumberFont()).horizontalAdvance(grouped(most));
    update();
}

void MarginalHistogram::refreshSelected() {
    analysis::Histogram fresh = histogramOfSelected();
    const bool dimmed = !content_.selected.empty();
    if (fresh.counts == selected_.counts && dimmed == dimmed_) return;
    selected_ = std::move(fresh);
    dimmed_ = dimmed;
    update();
}

void MarginalHistogram::setCounted(const QString& one, const QString& several) {
    one_ = one;
    several_ = several;
}

void MarginalHistogram::setCaption(const QString& caption) {
    caption_ = caption;
    update();
}

std::uint64_t MarginalHistogram::scale() const {
    std::vector<std::uint64_t> counts = all_.counts;
    std::sort(counts.begin(), counts.end(), std::greater<>());
    const std::uint64_t first = counts.empty() ? 0 : counts[0], second = counts.size() > 1 ? counts[1] : 0;
    const bool cut = second > 0 && first > 4 * second;
    return std::max<std::uint64_t>(cut ? 2 * second : first, 1);
}

double MarginalHistogram::lengthOf(std::uint64_t count) const {
    const double full = width() - roomForCount_;
    // A bar of one path among thousands is still seen.
    return count == 0 ? 0 : std::clamp(full * double(count) / double(scale()), 2.0, full);
}

void MarginalHistogram::paintNotch(QPainter& painter, const QRectF& bar) const {
    painter.setPen(QPen(theme_.colors().ground, 2));
    const double x = bar.right() - 9;
    painter.drawLine(QPointF(x - 2, bar.bottom() + 1), QPointF(x + 2, bar.top() - 1));
    painter.setPen(Qt::NoPen);
}

QRectF MarginalHistogram::barRect(std::size_t bar, std::uint64_t count) const {
    const double bottom = content_.frame.y().pixel(all_.lower(bar)), top = content_.frame.y().pixel(all_.upper(bar));
    return QRectF(QPointF(4, top_ + top + 0.5), QPointF(4 + lengthOf(count), top_ + bottom - 0.5));
}

void MarginalHistogram::paintEvent(QPaintEvent*) {
    const ThemeColors& c = theme_.colors();
    QPainter painter(this);
    painter.fillRect(rect(), c.ground);
    painter.setPen(QPen(c.grid, 1));
    painter.drawLine(3, top_, 3, top_ + height_);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(theme_.smallNumberFont());
    painter.setPen(Qt::NoPen);
    QColor color = content_.color;
    color.setAlphaF(content_.selected.empty() ? 0.75 : 0.4);
    const auto largest = std::max_element(all_.counts.begin(), all_.counts.end()) - all_.counts.begin();
    for (std::size_t bar = 0; bar < all_.binCount(); ++bar) {
        if (all_.counts[bar] == 0) continue;
        const QRectF rect = barRect(bar, all_.counts[bar]);
        painter.fillRect(rect, int(bar) == hovered_ ? c.hover : color);
        if (selected_.counts[bar] > 0) painter.fillRect(barRect(bar, selected_.counts[bar]), c.selected);
        if (all_.counts[bar] > scale()) paintNotch(painter, rect);
        const bool labelled = integral_ ? rect.height() >= 11 : std::ptrdiff_t(bar) == largest;
        if (!labelled) continue;
        painter.setPen(c.mutedText);
        painter.drawText(QRectF(rect.right() + 4, rect.center().y() - 8, width() - rect.right() - 4, 16),
                         Qt::AlignLeft | Qt::AlignVCenter, grouped(all_.counts[bar]));
        painter.setPen(Qt::NoPen);
    }
    if (!caption_.isEmpty()) {
        painter.setFont(theme_.smallFont());
        painter.setPen(c.mutedText);
        painter.drawText(QRectF(4, height() - 17, width() - 8, 16), Qt::AlignLeft | Qt::AlignVCenter, caption_);
        painter.setFont(theme_.smallNumberFont());
        painter.setPen(Qt::NoPen);
    }
    paintRowCount(painter, PlotRow::above, all_.above + all_.positiveInfinite, c.text);
    paintRowCount(painter, PlotRow::below, all_.below + all_.negativeInfinite, c.text);
    paintRowCount(painter, PlotRow::nan, all_.nan, c.warning);
}

void MarginalHistogram::paintRowCount(QPainter& painter, PlotRow row, std::uint64_t count, const QColor& color) const {
    const PlotFrame::Rows& rows = content_.frame.rows();
    const bool there = row == PlotRow::above ? rows.above : row == PlotRow::below ? rows.below : rows.nan;
    if (!there || count == 0) return;
    const double middle = top_ + content_.frame.center(row), length = lengthOf(count);
    QColor bar = row == PlotRow::nan ? theme_.colors().warning : content_.color;
    bar.setAlphaF(0.5);
    painter.fillRect(QRectF(4, middle - 4, length, 8), bar);
    painter.setPen(color);
    painter.drawText(QRectF(8 + length, middle - 8, width() - 8 - length, 16), Qt::AlignLeft | Qt::AlignVCenter,
                     grouped(count));
    painter.setPen(Qt::NoPen);
}

int MarginalHistogram::barAt(QPointF position) const {
    for (std::size_t bar = 0; bar < all_.binCount(); ++bar) {
        const QRectF rect = barRect(bar, 1);
        if (position.y() >= rect.top() && position.y() < rect.bottom() + 1 && all_.counts[bar] > 0) return int(bar);
    }
    return -1;
}

QString MarginalHistogram::tip(std::size_t i) const {
    const QString from = toQString(analysis::formatNumber(all_.lower(i))),
                  to = toQString(analysis::formatNumber(all_.upper(i)));
    const QString range = integral_ && all_.upper(i) - all_.lower(i) == 1
                              ? QString::number(std::round((all_.lower(i) + all_.upper(i)) / 2))
                              : tr("%1 to %2").arg(from, to);
    const auto whole = static_cast<qsizetype>(std::round((all_.lower(i) + all_.upper(i)) / 2));
    const QString name = !names_.isEmpty() && whole >= 0 && whole < names_.size() ? names_[int(whole)] : range;
    QString text = tr("%1: %2 %3").arg(name, grouped(all_.counts[i]), all_.counts[i] == 1 ? one_ : several_);
    if (selected_.counts[i] > 0) text += tr(", %1 selected").arg(grouped(selected_.counts[i]));
    return text;
}

}  // namespace emca::explorer
