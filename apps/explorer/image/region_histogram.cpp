#include "image/region_histogram.h"

#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "base/grouped.h"
#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

bool isLuminance(const RegionChannel& channel) { return channel.image.channel == "luminance"; }

}  // namespace

RegionHistogram::RegionHistogram(Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
}

void RegionHistogram::show(const RegionNumbers& numbers) {
    channels_ = numbers.channels;
    largest_ = 0;
    for (const RegionChannel& channel : channels_) {
        if (channel.image.channel == "A") continue;   // opaque everywhere: one bin with all pixels would hide the rest
        largest_ = std::max(largest_, channel.histogram.largest());
    }
    update();
}

void RegionHistogram::setLogCounts(bool log) {
    logCounts_ = log;
    update();
}

QRectF RegionHistogram::plotArea() const { return QRectF(rect()).adjusted(8, 8, -8, -20); }

double RegionHistogram::height(std::uint64_t count) const {
    if (largest_ == 0) return 0;
    const double share = logCounts_ ? std::log1p(double(count)) / std::log1p(double(largest_)) : double(count) / double(largest_);
    return std::min(share, 1.0);
}

QPolygonF RegionHistogram::outline(const analysis::Histogram& histogram, const QRectF& area) const {
    QPolygonF line;
    const auto bins = double(histogram.binCount());
    line << area.bottomLeft();
    for (std::size_t bin = 0; bin < histogram.binCount(); ++bin) {
        const double y = area.bottom() - height(histogram.counts[bin]) * area.height();
        line << QPointF(area.left() + area.width() * double(bin) / bins, y) << QPointF(area.left() + area.width() * double(bin + 1) / bins, y);
    }
    line << area.bottomRight();
    return line;
}

QColor RegionHistogram::colorOf(const std::string& channel) const {
    const ThemeColors& c = theme_.colors();
    if (channel == "R") return c.red;
    if (channel == "G") return c.green;
    if (channel == "B") return c.blue;
    if (channel == "A") return c.alpha;
    return channel == "luminance" ? c.luminance : c.data;
}

void RegionHistogram::paintEvent(QPaintEvent*) {
    const ThemeColors& c = theme_.colors();
    QPainter painter(this);
    painter.fillRect(rect(), c.ground);
    if (channels_.empty()) return;
    const QRectF area = plotArea();
    paintAxis(painter, area);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const RegionChannel& channel : channels_) {   // the area first, lines on it
        if (!isLuminance(channel)) continue;
        QColor fill = colorOf("luminance");
        fill.setAlpha(70);
        painter.setPen(Qt::NoPen);
        painter.setBrush(fill);
        painter.drawPolygon(outline(channel.histogram, area));
    }
    painter.setBrush(Qt::NoBrush);
    for (const RegionChannel& channel : channels_) {
        if (channel.image.channel == "A") continue;
        painter.setPen(QPen(colorOf(channel.image.channel), 1.5));
        painter.drawPolyline(outline(channel.histogram, area));
        if (!isLuminance(channel) || !channel.referenceHistogram) continue;
        painter.setPen(QPen(c.text, 1.5, Qt::DashLine));
        painter.drawPolyline(outline(*channel.referenceHistogram, area));
    }
    if (hovered_) {
        const double width = area.width() / double(binCount());
        QColor band = c.hover;
        band.setAlpha(45);
        painter.fillRect(QRectF(area.left() + width * double(*hovered_), area.top(), width, area.height()), band);
    }
    paintBeyond(painter, area);
}

void RegionHistogram::paintAxis(QPainter& painter, const QRectF& area) const {
    const ThemeColors& c = theme_.colors();
    const analysis::ValueRange& range = channels_.front().histogram.range;
    painter.setFont(theme_.smallNumberFont());
    double free = -1e9;
    for (const analysis::Tick& tick : analysis::ticks(range, std::max(2, int(area.width() / 60)))) {
        const double x = std::round(area.left() + range.position(tick.value) * area.width()) + 0.5;
        painter.setPen(c.grid);
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        if (tick.label.empty()) continue;
        const QString label = toQString(tick.label);
        const double half = painter.fontMetrics().horizontalAdvance(label) / 2.0;
        const double left = std::clamp(x - half, 0.0, width() - 2 * half);
        if (left < free) continue;
        free = left + 2 * half + 6;
        painter.setPen(c.mutedText);
        painter.drawText(QRectF(left, area.bottom() + 3, 2 * half + 1, 16), Qt::AlignLeft | Qt::AlignTop | Qt::TextDontClip, label);
    }
    painter.setPen(c.border);
    painter.drawLine(area.bottomLeft(), area.bottomRight());
}

/// "12 brighter ▸" at the edge that hides them.
void RegionHistogram::paintBeyond(QPainter& painter, const QRectF& area) const {
    const auto found = std::ranges::find_if(channels_, isLuminance);
    const RegionChannel& channel = found == channels_.end() ? channels_.front() : *found;
    const analysis::Histogram& h = channel.histogram;
    painter.setFont(theme_.smallNumberFont());
    painter.setPen(theme_.colors().mutedText);
    const QRectF line(area.left() + 2, area.top() - 4, area.width() - 4, 16);
    if (const std::uint64_t above = h.above + h.positiveInfinite) painter.drawText(line, Qt::AlignRight, tr("%1 brighter ▸").arg(grouped(above)));
    if (const std::uint64_t below = h.below + h.negativeInfinite)
        painter.drawText(line, Qt::AlignLeft, h.range.log ? tr("◂ %1 darker, or 0").arg(grouped(below)) : tr("◂ %1 darker").arg(grouped(below)));
}

QString RegionHistogram::describe(std::size_t bin) const {
    if (bin >= binCount()) return {};
    const analysis::Histogram& first = channels_.front().histogram;
    QString text = tr("%1 to %2").arg(toQString(analysis::formatNumber(first.lower(bin))), toQString(analysis::formatNumber(first.upper(bin))));
    for (const RegionChannel& channel : channels_) {
        text += QStringLiteral("\n%1  %2").arg(toQString(channel.image.channel), grouped(channel.histogram.counts[bin]));
        if (channel.referenceHistogram) text += tr(", reference %1").arg(grouped(channel.referenceHistogram->counts[bin]));
    }
    return text;
}

void RegionHistogram::mouseMoveEvent(QMouseEvent* event) {
    const QRectF area = plotArea();
    const QPointF at = positionOf(*event);
    std::optional<std::size_t> bin;
    if (binCount() > 0 && area.adjusted(0, -8, 0, 20).contains(at))
        bin = std::min(binCount() - 1, static_cast<std::size_t>(std::max(0.0, (at.x() - area.left()) / area.width() * double(binCount()))));
    if (bin == hovered_) return;
    hovered_ = bin;
    update();
    if (bin) QToolTip::showText(globalPositionOf(*event), describe(*bin), this);
    else QToolTip::hideText();
}

void RegionHistogram::leaveEvent(QEvent*) {
    hovered_.reset();
    update();
}

}  // namespace emca::explorer
