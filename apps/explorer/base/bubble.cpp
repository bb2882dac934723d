#include "base/bubble.h"

#include <QPainter>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {

void paintBubble(QPainter& painter, const Theme& theme, const QString& text, QPointF at, double gap, QSize within) {
    constexpr double kSide = 9, kAbove = 5, kBorder = 2;
    const ThemeColors& c = theme.colors();
    const QFont font = theme.smallNumberFont();
    const QRectF words = QFontMetricsF(font).boundingRect(QRectF(0, 0, 460, 400), Qt::AlignLeft, text);
    QRectF box(at.x() + gap, at.y() - words.height() / 2 - kAbove, words.width() + 2 * kSide, words.height() + 2 * kAbove);
    if (box.right() > within.width() - kBorder) box.moveRight(at.x() - gap);
    box.moveLeft(std::max(kBorder, box.left()));
    box.moveTop(std::clamp(box.top(), kBorder, std::max(kBorder, within.height() - box.height() - kBorder)));
    painter.setPen(QPen(c.border, 1));
    painter.setBrush(c.raised);
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), Spacing::radius, Spacing::radius);
    painter.setFont(font);
    painter.setPen(c.text);
    painter.drawText(box.adjusted(kSide, kAbove, -kSide, -kAbove), Qt::AlignLeft | Qt::AlignVCenter, text);
}

}  // namespace emca::explorer
