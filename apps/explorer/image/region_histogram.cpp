#include "image/region_histogram.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
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
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
}

void RegionHistogram::show(const RegionNumbers& numbers, const QString& title) {
    channels_ = numbers.channels;
    title_ = title;
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

QRectF RegionHistogram::plotArea() const { return QRectF(rect()).adjusted(8, exporting_ ? 28 : 8, -8, -20); }

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
    if (hovered_ && !exporting_) {
        const double width = area.width() / double(binCount());
        QColor band = c.hover;
        band.setAlpha(45);
        painter.fillRect(QRectF(area.left() + width * double(*hovered_), area.top(), width, area.height()), band);
    }
    paintBeyond(painter, area);
    if (exporting_) paintCaption(painter);
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

/// A picture stands alone: what pixels, what quantity in what unit, and whose line is whose.
void RegionHistogram::paintCaption(QPainter& painter) const {
    const ThemeColors& c = theme_.colors();
    painter.setFont(theme_.font());
    const QFontMetricsF metrics(painter.font(), painter.device());
    double right = width() - 8;
    const auto write = [&](const QString& text, const QColor& color) {
        right -= metrics.horizontalAdvance(text);
        painter.setPen(color);
        painter.drawText(QPointF(right, 18), text);
        right -= 10;
    };
    for (auto channel = channels_.rbegin(); channel != channels_.rend(); ++channel) {
        if (channel->image.channel == "A") continue;
        if (isLuminance(*channel) && channel->referenceHistogram) write(tr("- - reference"), c.text);
        write(toQString(channel->image.channel), colorOf(channel->image.channel));
    }
    painter.setPen(c.text);
    painter.drawText(QPointF(8, 18), metrics.elidedText(tr("%1, W/(sr m²)").arg(title_), Qt::ElideRight, right - 8));
}

QString RegionHistogram::csv() const {
    if (channels_.empty()) return {};
    QString text = QStringLiteral("from,to");
    std::vector<const analysis::Histogram*> columns;
    for (const RegionChannel& channel : channels_) {
        text += ',' + toQString(channel.image.channel);
        columns.push_back(&channel.histogram);
        if (!channel.referenceHistogram) continue;
        text += QStringLiteral(",reference ") + toQString(channel.image.channel);
        columns.push_back(&*channel.referenceHistogram);
    }
    const analysis::Histogram& first = *columns.front();
    const auto full = [](double value) { return toQString(analysis::formatFull(value)); };
    const auto line = [&](const QString& from, const QString& to, auto&& count) {
        text += '\n' + from + ',' + to;
        for (const analysis::Histogram* histogram : columns) text += ',' + QString::number(count(*histogram));
    };
    const auto below = [](const analysis::Histogram& h) { return h.below + h.negativeInfinite; };
    const auto above = [](const analysis::Histogram& h) { return h.above + h.positiveInfinite; };
    const auto nan = [](const analysis::Histogram& h) { return h.nan; };
    const auto occurs = [&](auto&& count) { return std::ranges::any_of(columns, [&](const auto* h) { return count(*h) > 0; }); };
    if (occurs(below)) line({}, full(first.range.min), below);
    for (std::size_t bin = 0; bin < first.binCount(); ++bin)
        line(full(first.lower(bin)), full(first.upper(bin)), [bin](const analysis::Histogram& h) { return h.counts[bin]; });
    if (occurs(above)) line(full(first.range.max), {}, above);
    if (occurs(nan)) line(QStringLiteral("NaN"), QStringLiteral("NaN"), nan);
    return text + '\n';
}

Result<void> RegionHistogram::exportTo(const QString& file, int scale) { return writeExport(exporting(), file, scale); }

PlotExport RegionHistogram::exporting() {
    return {this, this, QStringLiteral("histogram"), [this](bool on) { exporting_ = on; },
            [this] { return csv(); }, [this](const QString& sentence) { emit message(sentence); }};
}

bool RegionHistogram::event(QEvent* event) { return claimExportKeys(*event) || QWidget::event(event); }

void RegionHistogram::keyPressEvent(QKeyEvent* event) {
    if (handleExportKeys(*event, exporting())) event->accept();
    else QWidget::keyPressEvent(event);
}

void RegionHistogram::contextMenuEvent(QContextMenuEvent* event) {
    if (channels_.empty()) return;
    QMenu menu(this);
    addExportActions(menu, exporting());
    menu.exec(event->globalPos());
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
