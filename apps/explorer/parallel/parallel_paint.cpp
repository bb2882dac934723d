// How ParallelCanvas is drawn.
#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "base/bubble.h"
#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "parallel/parallel_canvas.h"
#include "plots/plot_axis.h"
#include "plots/points_item.h"

namespace emca::explorer {
namespace {

QColor withAlpha(QColor color, double alpha) {
    color.setAlphaF(alpha);
    return color;
}

constexpr double kDimmed = 0.38;

}  // namespace

void ParallelCanvas::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), theme_.colors().ground);
    if (axes_.size() == 0) return;
    painter.setRenderHint(QPainter::Antialiasing);
    paintLines(painter);
    if (!exporting_) paintHovered(painter);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (drag_ == Drag::axis && i == dragAxis_) continue;
        paintAxis(painter, i, frame_.x(i));
    }
    if (drag_ == Drag::axis) {
        // The axis in the hand, over where it would go.
        const QRectF room(mouse_.x() - 26, 0, 52, frame_.canvas().height());
        painter.fillRect(room, withAlpha(theme_.colors().hoverSurface, 0.6));
        paintAxis(painter, dragAxis_, mouse_.x());
        const double x = frame_.x(frame_.nearestAxis(mouse_.x()));
        painter.setPen(QPen(theme_.colors().accent, 2, Qt::DotLine));
        painter.drawLine(QPointF(x, ParallelFrame::kHeader), QPointF(x, frame_.end()));
    }
    if (exporting_) return;
    paintHoveredDots(painter);
    if (!bubble_.isEmpty()) paintBubble(painter, theme_, bubble_, mouse_, 16, size());
}

void ParallelCanvas::paintLines(QPainter& painter) {
    const ThemeColors& c = theme_.colors();
    const bool marked = !selected_.empty() || axes_.hasBrushes();
    if (keepsShapes(painter) && lines_.lines() <= kMostLines) {
        drawAllLines(painter, lines_, withAlpha(c.data, lineOpacity(lines_.lines()) * (marked ? kDimmed : 1)), 1);
        drawLines(painter, lines_, selected_, withAlpha(c.selected, lineOpacity(selected_.size() / 4)), 1.25);
    } else {
        if (!pictures_.allFresh) {
            ++drawnLayers_;
            pictures_.all = linePicture(lines_, std::nullopt, c.data, devicePixelRatioF());
            pictures_.allFresh = true;
        }
        if (!pictures_.markedFresh) {
            pictures_.marked = selected_.empty() ? QImage() : linePicture(lines_, std::span<const Index>(selected_), c.selected, devicePixelRatioF());
            pictures_.markedFresh = true;
        }
        const auto draw = [&](const QImage& image) {
            // Cells of a density are larger than pixels.
            painter.setRenderHint(QPainter::SmoothPixmapTransform, image.devicePixelRatio() < 1);
            if (!image.isNull()) painter.drawImage(QRectF(QPointF(0, 0), QSizeF(image.size()) / image.devicePixelRatio()), image);
        };
        painter.setOpacity(marked ? kDimmed : 1);
        draw(pictures_.all);
        painter.setOpacity(1);
        draw(pictures_.marked);
    }
    if (current_ && *current_ < lines_.lines()) {
        const Index path = *current_;
        drawLines(painter, lines_, {&path, 1}, withAlpha(c.halo, 0.9), 5);
        drawLines(painter, lines_, {&path, 1}, c.selected, 2.5);
    }
}

void ParallelCanvas::paintAxis(QPainter& painter, std::size_t i, double x) const {
    const ThemeColors& c = theme_.colors();
    const bool current = !exporting_ && currentAxis() == i;
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(QPen(current ? c.text : c.mutedText, 1));
    const double at = std::round(x);
    painter.drawLine(QPointF(at, frame_.top()), QPointF(at, frame_.bottom()));
    painter.setRenderHint(QPainter::Antialiasing);
    if (!axes_[i].isEmpty()) {
        if (x == frame_.x(i)) paintBrushes(painter, i);
        paintTicks(painter, i, at);
    }
    paintRows(painter, i, at);
    paintHeader(painter, i, x);
}

void ParallelCanvas::label(QPainter& painter, QPointF at, const QString& text, const QColor& color) const {
    // Lines end at the label and go on behind it, the selected one, too.
    const QFontMetricsF metrics(theme_.smallNumberFont());
    const double width = metrics.horizontalAdvance(text);
    const QRectF box(at.x() - width, at.y() - metrics.height() / 2, width, metrics.height());
    painter.setPen(Qt::NoPen);
    painter.setBrush(withAlpha(theme_.colors().ground, 0.94));
    painter.drawRoundedRect(box.adjusted(-3, 0, 2, 0), 3, 3);
    painter.setFont(theme_.smallNumberFont());
    painter.setPen(color);
    painter.drawText(box.adjusted(-1, 0, 1, 0), Qt::AlignRight | Qt::AlignVCenter, text);
}

void ParallelCanvas::paintTicks(QPainter& painter, std::size_t i, double x) const {
    const ThemeColors& c = theme_.colors();
    const ParallelAxis& axis = axes_[i];
    const auto mark = [&](double y, bool major) {
        painter.setRenderHint(QPainter::Antialiasing, false);
        painter.setPen(QPen(c.mutedText, 1));
        painter.drawLine(QPointF(x - (major ? 4 : 2), std::round(y)), QPointF(x, std::round(y)));
        painter.setRenderHint(QPainter::Antialiasing);
    };
    const double length = frame_.bottom() - frame_.top();
    if (axis.isText()) {
        const std::size_t count = axis.values.categories.size();
        const double each = length / double(count);
        const std::size_t step = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(15 / each)));   // labels that would overlap
        const QFontMetricsF metrics(theme_.smallNumberFont());
        const double room = i == 0 ? frame_.x(0) - 8 : frame_.spacing() * 0.55;
        for (std::size_t k = 0; k < count; k += step) {
            const double y = frame_.position(axis, double(k));
            mark(y, true);
            QString text = toQString(axis.values.categories[k]);
            if (text.isEmpty()) text = tr("(empty)");
            label(painter, {x - 7, y}, metrics.elidedText(text, Qt::ElideRight, room), c.text);
        }
        return;
    }
    const int room = std::clamp(int(length / 34), 2, 8);
    const bool whole = axis.values.integral && !axis.isLog();
    for (const analysis::Tick& tick : whole ? analysis::integerTicks(axis.scale.range, room) : analysis::ticks(axis.scale.range, room)) {
        const double y = frame_.position(axis, tick.value);
        if (y < frame_.top() - 0.5 || y > frame_.bottom() + 0.5) continue;
        mark(y, tick.major);
        // Whole numbers in full, however large, as in the other plots.
        const bool full = whole && std::abs(tick.value) < 1e9;
        if (tick.major) label(painter, {x - 7, y}, full ? QLocale(QLocale::English).toString(qlonglong(std::llround(tick.value))) : tickText(tick.label), c.text);
    }
}

void ParallelCanvas::paintRows(QPainter& painter, std::size_t i, double x) const {
    const ThemeColors& c = theme_.colors();
    const ParallelAxis& axis = axes_[i];
    const bool flipped = axis.wish.flipped;
    const auto beyond = [&](std::uint32_t count, bool up, bool larger) {
        if (count == 0) return;
        const double y = up ? frame_.topRowCenter() : frame_.bottomRowCenter(), s = up ? 1 : -1;
        QPainterPath arrow;
        arrow.moveTo(x, y - 5 * s);
        arrow.lineTo(x + 4.5, y + 3.5 * s);
        arrow.lineTo(x - 4.5, y + 3.5 * s);
        arrow.closeSubpath();
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.mutedText);
        painter.drawPath(arrow);
        // One value is said; of several, how they compare with the scale.
        const double nearest = larger ? axis.scale.leastAbove : axis.scale.greatestBelow;
        const QString sign = larger ? QStringLiteral("≥ ") : QStringLiteral("≤ ");
        label(painter, {x - 8, y}, (count == 1 ? QString() : sign) + tickText(analysis::formatNumber(nearest)), c.mutedText);
    };
    beyond(axis.scale.above, !flipped, true);
    beyond(axis.scale.below, flipped, false);
    const auto place = [&](bool there, double y, const QString& text, const QColor& color) {
        if (!there) return;
        painter.setPen(Qt::NoPen);
        painter.setBrush(color);
        painter.drawEllipse(QPointF(x, y), 2.5, 2.5);
        label(painter, {x - 7, y}, text, color);
    };
    place(axis.scale.nan > 0, frame_.nanCenter(), QStringLiteral("NaN"), c.warning);
    place(axis.scale.missing > 0, frame_.missingCenter(), frame_.spacing() < 90 ? tr("none") : tr("not recorded"), c.mutedText);
}

void ParallelCanvas::paintHeader(QPainter& painter, std::size_t i, double x) const {
    const ThemeColors& c = theme_.colors();
    const ParallelAxis& axis = axes_[i];
    const QRectF header = frame_.header(i).translated(x - frame_.x(i), 0).adjusted(4, 4, -4, 0);
    const QFontMetricsF metrics(theme_.smallFont());
    const bool current = !exporting_ && currentAxis() == i;
    // At the borders a title keeps to its axis as far as it fits.
    const auto put = [&](const QString& whole, double top, const QFont& font, const QColor& color) {
        const QFontMetricsF own(font);
        const QString text = own.elidedText(whole, Qt::ElideRight, header.width());
        const double width = own.horizontalAdvance(text), left = std::clamp(x - width / 2, header.left(), std::max(header.left(), header.right() - width));
        painter.setFont(font);
        painter.setPen(color);
        painter.drawText(QRectF(left, top, width + 2, own.height()), Qt::AlignLeft | Qt::AlignVCenter, text);
    };
    put(axis.wish.expression, header.top(), theme_.smallNumberFont(), axis.isEmpty() ? c.mutedText : c.text);
    if (current && hoveredAxis_ == i && drag_ == Drag::none) return paintChips(painter, i);
    QStringList notes;
    if (axis.isEmpty()) notes += tr("not recorded");
    else if (!axis.unit.isEmpty()) notes += axis.unit;
    if (axis.isLog()) notes += tr("log");
    if (axis.wish.flipped) notes += QStringLiteral("↓");
    put(notes.join(QStringLiteral(" · ")), header.top() + metrics.height() + 1, theme_.smallFont(), c.mutedText);
}

void ParallelCanvas::paintChips(QPainter& painter, std::size_t i) const {
    const ThemeColors& c = theme_.colors();
    const auto chip = [&](Chip which, const QString& text, bool checked, bool enabled) {
        const QRectF box = chipRect(i, which);
        const bool under = box.contains(mouse_) && enabled;
        painter.setPen(QPen(checked ? c.accent : c.border, 1));
        painter.setBrush(under ? c.hoverSurface : c.raised);
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
        painter.setFont(theme_.smallFont());
        painter.setPen(!enabled ? c.border : checked ? c.accent : c.text);
        painter.drawText(box, Qt::AlignCenter, text);
    };
    chip(Chip::log, tr("log"), axes_[i].isLog(), !axes_[i].isText());
    chip(Chip::flip, QStringLiteral("↕"), axes_[i].wish.flipped, true);
    chip(Chip::remove, QStringLiteral("×"), false, true);
}

void ParallelCanvas::paintBrushes(QPainter& painter, std::size_t i) const {
    const ThemeColors& c = theme_.colors();
    const auto band = [&](const QRectF& box) {
        painter.setPen(QPen(c.selected, 1.5));
        painter.setBrush(withAlpha(c.selected, 0.28));
        painter.drawRoundedRect(box, 3, 3);
    };
    for (const query::Brush& brush : axes_[i].brushes) {
        if (const QRectF box = frame_.brushRect(i, axes_[i], brush); !box.isEmpty()) band(box);
        if (brush.nan) band(frame_.rowRect(i, frame_.nanCenter()));
        if (brush.missing) band(frame_.rowRect(i, frame_.missingCenter()));
    }
}

void ParallelCanvas::paintHovered(QPainter& painter) const {
    if (!hovered_ || *hovered_ >= lines_.lines()) return;
    const ThemeColors& c = theme_.colors();
    const Index path = *hovered_;
    drawLines(painter, lines_, {&path, 1}, withAlpha(c.halo, 0.9), 4.5);
    drawLines(painter, lines_, {&path, 1}, c.hover, 1.75);
}

void ParallelCanvas::paintHoveredDots(QPainter& painter) const {
    if (!hovered_ || *hovered_ >= lines_.lines()) return;
    const ThemeColors& c = theme_.colors();
    const Index path = *hovered_;
    painter.setPen(QPen(c.halo, 1));
    painter.setBrush(c.hover);
    for (std::size_t i = 0; i < lines_.xs.size(); ++i) painter.drawEllipse(QPointF(lines_.xs[i], double(lines_.ys[i][path])), 3, 3);
}

}  // namespace emca::explorer
