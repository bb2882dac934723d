#include "scene_overlay.h"

#include <QLinearGradient>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>

namespace emca::explorer {
namespace {

QColor translucent(QColor color, double alpha) {
    color.setAlphaF(alpha);
    return color;
}

void box(QPainter& p, const QRectF& rect, const ThemeColors& c, double alpha) {
    p.setPen(QPen(translucent(c.border, 0.8), 1));
    p.setBrush(translucent(c.panel, alpha));
    p.drawRoundedRect(rect.adjusted(0.5, 0.5, -0.5, -0.5), Spacing::radius, Spacing::radius);
}

/// Text with a thin outline in the colour of the ground, readable over lines.
void outlined(QPainter& p, QPointF baseline, const QString& text, const QColor& ink, const QColor& outline) {
    QPainterPath path;
    path.addText(baseline, p.font(), text);
    p.setBrush(Qt::NoBrush);
    p.setPen(QPen(translucent(outline, 0.9), 3, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    p.drawPath(path);
    p.setPen(ink);
    p.drawText(baseline, text);
}

void paintLabels(QPainter& p, const OverlayContent& content, const Theme& theme) {
    const ThemeColors& c = theme.colors();
    std::vector<QRectF> taken;
    for (const OverlayContent::Label& label : content.labels) {
        QFont font = theme.smallNumberFont();
        font.setBold(label.strong);
        p.setFont(font);
        const QFontMetricsF metrics(font);
        const double w = metrics.horizontalAdvance(label.text), h = metrics.height();
        QRectF rect(label.at.x() + (label.strong ? 11 : 6), label.at.y() - h - (label.strong ? 4 : 1), w, h);
        if (label.strong) rect.adjust(-1, -1, 9, 1);
        if (std::ranges::any_of(taken, [&](const QRectF& other) { return other.intersects(rect); })) continue;
        taken.push_back(rect);
        if (label.strong) {
            p.setPen(QPen(translucent(c.halo, 0.9), 1.5));
            p.setBrush(c.selected);
            p.drawRoundedRect(rect, rect.height() / 2, rect.height() / 2);
            p.setPen(theme.isDark() ? c.ground : QColor(Qt::white));
            p.drawText(rect, Qt::AlignCenter, label.text);
        } else {
            outlined(p, {rect.x(), rect.y() + metrics.ascent()}, label.text, c.text, c.halo);
        }
    }
}

void paintLegend(QPainter& p, QSizeF size, const OverlayContent& content, const Theme& theme) {
    if (content.legend.empty()) return;
    const ThemeColors& c = theme.colors();
    p.setFont(theme.smallFont());
    const QFontMetricsF metrics(p.font());
    constexpr double kMark = 22, kPad = 8, kRow = 18;
    double w = 0;
    for (const auto& entry : content.legend) w = std::max(w, metrics.horizontalAdvance(entry.text));
    const double h = kRow * static_cast<double>(content.legend.size()) + 2 * (kPad - 3);
    const QRectF rect(12, size.height() - 12 - h, w + kMark + 2 * kPad + 6, h);
    box(p, rect, c, 0.72);
    double y = rect.y() + kPad - 3 + kRow / 2;
    for (const auto& entry : content.legend) {
        const double x = rect.x() + kPad;
        QPen pen(entry.color, 2.5, Qt::SolidLine, Qt::RoundCap);
        if (entry.mark == OverlayContent::Mark::dashes) {
            pen.setCapStyle(Qt::FlatCap);
            pen.setDashPattern({2.4, 1.5});
        }
        p.setPen(pen);
        if (entry.mark == OverlayContent::Mark::dot) {
            p.setPen(Qt::NoPen);
            p.setBrush(entry.color);
            p.drawEllipse(QPointF(x + kMark / 2, y), 5, 5);
        } else if (entry.mark == OverlayContent::Mark::square) {
            p.setPen(Qt::NoPen);
            p.setBrush(entry.color);
            p.drawRoundedRect(QRectF(x + kMark / 2 - 5, y - 5, 10, 10), 2, 2);
        } else if (entry.mark == OverlayContent::Mark::ramp) {
            QLinearGradient gradient(x, y, x + kMark, y);
            const double last = std::max<double>(1, double(entry.ramp.size()) - 1);
            for (std::size_t i = 0; i < entry.ramp.size(); ++i) gradient.setColorAt(double(i) / last, entry.ramp[i]);
            p.setPen(Qt::NoPen);
            p.setBrush(gradient);
            p.drawRoundedRect(QRectF(x, y - 4, kMark, 8), 2, 2);
        } else {
            p.drawLine(QPointF(x + 1, y), QPointF(x + kMark - 1, y));
        }
        p.setPen(c.text);
        p.drawText(QRectF(x + kMark + 6, y - kRow / 2, w + 4, kRow), Qt::AlignVCenter | Qt::AlignLeft, entry.text);
        y += kRow;
    }
}

void paintAxes(QPainter& p, QSizeF size, const OverlayContent& content, const Theme& theme) {
    if (content.axes.empty()) return;
    constexpr double kLength = 26;
    const QPointF centre(size.width() - 46, 46);
    QFont font = theme.smallFont();
    font.setBold(true);
    p.setFont(font);
    std::vector<const OverlayContent::Axis*> order;
    for (const OverlayContent::Axis& axis : content.axes) order.push_back(&axis);
    std::ranges::sort(order, {}, &OverlayContent::Axis::towardsEye);   // far ones first
    for (const OverlayContent::Axis* axis : order) {
        const QPointF end = centre + axis->to * kLength;
        const QColor ink = translucent(axis->color, axis->towardsEye < -0.2 ? 0.55 : 1);
        p.setPen(QPen(translucent(theme.colors().halo, 0.6), 4, Qt::SolidLine, Qt::RoundCap));
        p.drawLine(centre, end);
        p.setPen(QPen(ink, 2.2, Qt::SolidLine, Qt::RoundCap));
        p.drawLine(centre, end);
        const QPointF at = centre + axis->to * (kLength + 9);
        const double w = p.fontMetrics().horizontalAdvance(axis->name);
        outlined(p, at + QPointF(-w / 2, p.fontMetrics().ascent() / 2.0 - 1), axis->name, ink, theme.colors().halo);
    }
}

void paintCard(QPainter& p, QSizeF size, const OverlayContent::Card& card, const Theme& theme) {
    const ThemeColors& c = theme.colors();
    const QFont titleFont = theme.strongFont(), keyFont = theme.smallFont(), valueFont = theme.smallNumberFont();
    const QFontMetricsF titles(titleFont), keys(keyFont), values(valueFont);
    constexpr double kPad = 10, kGap = 14, kLimit = 300;
    double keyWidth = 0, valueWidth = 0;
    for (const auto& [key, value] : card.rows) {
        keyWidth = std::max(keyWidth, keys.horizontalAdvance(key));
        valueWidth = std::max(valueWidth, std::min(values.horizontalAdvance(value), kLimit));
    }
    const double row = std::max(keys.height(), values.height()) + 2;
    const double w = std::max(titles.horizontalAdvance(card.title), card.rows.empty() ? 0 : keyWidth + kGap + valueWidth) + 2 * kPad;
    const double h = titles.height() + 2 * (kPad - 2) + row * static_cast<double>(card.rows.size()) + (card.rows.empty() ? 0 : 3);
    double x = card.at.x() + 18, y = card.at.y() + 18;
    if (x + w > size.width() - 6) x = card.at.x() - 18 - w;
    if (y + h > size.height() - 6) y = card.at.y() - 18 - h;
    const QRectF rect(std::max(6.0, x), std::max(6.0, y), w, h);
    box(p, rect, c, 0.94);
    double top = rect.y() + kPad - 2;
    p.setFont(titleFont);
    p.setPen(c.text);
    p.drawText(QPointF(rect.x() + kPad, top + titles.ascent()), card.title);
    top += titles.height() + 3;
    for (const auto& [key, value] : card.rows) {
        p.setFont(keyFont);
        p.setPen(c.mutedText);
        p.drawText(QRectF(rect.x() + kPad, top, keyWidth + 2, row), Qt::AlignVCenter | Qt::AlignLeft, key);
        p.setFont(valueFont);
        p.setPen(value.contains("NaN") || value.contains("Infinity") ? c.warning : c.text);
        p.drawText(QRectF(rect.x() + kPad + keyWidth + kGap, top, valueWidth + 2, row), Qt::AlignVCenter | Qt::AlignLeft,
                   values.elidedText(value, Qt::ElideRight, kLimit));
        top += row;
    }
}

void paintTexts(QPainter& p, QSizeF size, const OverlayContent& content, const Theme& theme) {
    const ThemeColors& c = theme.colors();
    p.setFont(theme.smallFont());
    const QFontMetricsF metrics(p.font());
    if (!content.caption.isEmpty())
        outlined(p, {size.width() - 12 - metrics.horizontalAdvance(content.caption), size.height() - 14}, content.caption,
                 c.mutedText, c.sceneBottom);
    if (content.hint.isEmpty()) return;
    const double w = metrics.horizontalAdvance(content.hint) + 24;
    const QRectF rect((size.width() - w) / 2, 12, w, metrics.height() + 10);
    box(p, rect, c, 0.85);
    p.setPen(c.text);
    p.drawText(rect, Qt::AlignCenter, content.hint);
}

}  // namespace

void paintOverlay(QPainter& painter, QSizeF size, const OverlayContent& content, const Theme& theme) {
    painter.setRenderHint(QPainter::Antialiasing);
    if (content.ring) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(translucent(theme.colors().halo, 0.85), 5));
        painter.drawEllipse(*content.ring, 10, 10);
        painter.setPen(QPen(theme.colors().hover, 2.4));
        painter.drawEllipse(*content.ring, 10, 10);
    }
    paintLabels(painter, content, theme);
    paintLegend(painter, size, content, theme);
    paintAxes(painter, size, content, theme);
    paintTexts(painter, size, content, theme);
    if (content.rectangle) {
        const ThemeColors& c = theme.colors();
        painter.setPen(QPen(c.accent, 1));
        painter.setBrush(translucent(c.accent, 0.14));
        painter.drawRect(content.rectangle->adjusted(0.5, 0.5, -0.5, -0.5));
    }
    if (content.card) paintCard(painter, size, *content.card, theme);
}

SceneOverlay::SceneOverlay(Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
}

void SceneOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    paintOverlay(painter, size(), content, theme_);
}

}  // namespace emca::explorer
