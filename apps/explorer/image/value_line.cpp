#include "image/value_line.h"

#include <QPainter>
#include <algorithm>

#include "base/theme.h"

namespace emca::explorer {
namespace {

constexpr int kRow = 20, kName = 84, kColumn = 94, kGap = 5;

QColor inkColor(ValueLine::Ink ink, const ThemeColors& c) {
    switch (ink) {
        case ValueLine::Ink::red: return c.red;
        case ValueLine::Ink::green: return c.green;
        case ValueLine::Ink::blue: return c.blue;
        case ValueLine::Ink::plain: return c.text;
        case ValueLine::Ink::muted: break;
    }
    return c.mutedText;
}

}  // namespace

ValueLine::ValueLine(Theme& theme, QWidget* parent) : QWidget(parent), theme_(theme) {
    connect(&theme_, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    setRowCount(1);
}

void ValueLine::setRowCount(int rows) { setFixedHeight(rows * kRow + 2); }

void ValueLine::setRows(const std::vector<Row>& rows) {
    if (rows == rows_) return;
    rows_ = rows;
    update();
}

int ValueLine::widthOf(const Value& value, const QFontMetrics& metrics) const {
    return metrics.horizontalAdvance(value.label) + (value.label.isEmpty() ? 0 : kGap) + metrics.horizontalAdvance(value.number);
}

int ValueLine::paintValue(QPainter& painter, const Value& value, int x, const QRect& box) const {
    const ThemeColors& c = theme_.colors();
    const QFontMetrics metrics(painter.font());
    painter.setPen(inkColor(value.ink, c));
    painter.drawText(QRect(x, box.top(), box.right() - x, box.height()), Qt::AlignLeft | Qt::AlignVCenter, value.label);
    if (!value.label.isEmpty()) x += metrics.horizontalAdvance(value.label) + kGap;
    painter.setPen(value.warns ? c.warning : c.text);
    painter.drawText(QRect(x, box.top(), box.right() - x, box.height()), Qt::AlignLeft | Qt::AlignVCenter, value.number);
    return x + metrics.horizontalAdvance(value.number);
}

void ValueLine::paintRow(QPainter& painter, const Row& row, const QRect& box) const {
    const QFontMetrics metrics(painter.font());
    painter.setPen(row.muted ? theme_.colors().mutedText : theme_.colors().text);
    painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(row.name, Qt::ElideRight, kName - kGap));
    int x = box.left() + kName, end = x;
    for (const Value& value : row.values) {
        x = std::max(x, end + kGap);
        if (x + widthOf(value, metrics) > box.right()) return;
        end = paintValue(painter, value, x, box);
        x += kColumn;
    }
    int right = box.right();
    for (auto value = row.remarks.rbegin(); value != row.remarks.rend(); ++value) {
        const int left = right - widthOf(*value, metrics);
        if (left < end + Spacing::medium) return;
        paintValue(painter, *value, left, box);
        right = left - Spacing::large;
    }
}

void ValueLine::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setFont(theme_.numberFont());
    int y = 2;
    for (const Row& row : rows_) {
        paintRow(painter, row, QRect(Spacing::medium, y, width() - 2 * Spacing::medium, kRow));
        y += kRow;
    }
}

}  // namespace emca::explorer
