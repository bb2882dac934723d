#include "paths/value_cells.h"

#include <QApplication>
#include <QFontMetrics>
#include <QPainter>
#include <QStyleOptionViewItem>

#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {

namespace {

/// Between cells; the sign of the longest numbers may reach into it.
constexpr int kGap = 8;

}  // namespace

int numberCellWidth(const QFont& font) {
    return QFontMetrics(font).horizontalAdvance(QStringLiteral("1.234e-05")) + kGap;
}

void paintNumbers(QPainter& painter, const QRect& rect, const QStringList& numbers, const QColor& color,
                  const Theme& theme) {
    const QFont font = theme.numberFont();
    painter.setFont(font);
    const int cell = numberCellWidth(font);
    for (int i = 0; i < numbers.size(); ++i) {
        const bool word = analysis::isNonFiniteWord(numbers[i].toStdString());
        painter.setPen(word ? theme.colors().warning : color);
        painter.drawText(QRect(rect.left() + i * cell - kGap, rect.top(), cell, rect.height()),
                         Qt::AlignRight | Qt::AlignVCenter, numbers[i]);
    }
}

QColor toneColor(Tone tone, const ThemeColors& c, const QColor& normal) {
    switch (tone) {
        case Tone::warning:
            return c.warning;
        case Tone::visible:
            return c.nextEventVisible;
        case Tone::occluded:
            return c.nextEventOccluded;
        case Tone::normal:
            break;
    }
    return normal;
}

void paintRowBackground(QPainter& painter, const QStyleOptionViewItem& option) {
    QStyleOptionViewItem background = option;
    background.state &= ~QStyle::State_HasFocus;
    const QStyle* style = option.widget ? option.widget->style() : QApplication::style();
    style->drawPrimitive(QStyle::PE_PanelItemViewItem, &background, &painter, option.widget);
}

}  // namespace emca::explorer
