#include "plots/mean_label.h"

#include <QPainter>
#include <algorithm>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "plots/points_item.h"

namespace emca::explorer {

MeanLabel::MeanLabel(const ScatterContent& content, const Theme& theme, QWidget* parent)
    : QWidget(parent), content_(content), theme_(theme) {
    setFixedWidth(sizeHint().width());
}

QSize MeanLabel::sizeHint() const {
    return {QFontMetrics(theme_.smallNumberFont()).horizontalAdvance(QStringLiteral("1.234e-05")) + 8, 60};
}

void MeanLabel::setCanvasTop(int top) {
    top_ = top;
    update();
}

void MeanLabel::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const ThemeColors& c = theme_.colors();
    painter.fillRect(rect(), c.ground);
    if (!content_.mean) return;
    const PlotFrame& frame = content_.frame;
    const PlotRow row = frame.row(*content_.mean);
    const double at = row == PlotRow::inside ? frame.y().pixel(*content_.mean)
                      : row == PlotRow::above ? frame.y().end : frame.y().start;
    const QFontMetricsF words(theme_.smallFont()), numbers(theme_.smallNumberFont());
    const double height = words.height() + numbers.height() - 2;
    const double top = std::clamp(top_ + at - height / 2, double(top_), std::max<double>(top_, top_ + frame.canvas().height() - height));
    const QString arrow = row == PlotRow::above ? QStringLiteral("↑ ") : row == PlotRow::below ? QStringLiteral("↓ ") : QString();
    painter.setFont(theme_.smallFont());
    painter.setPen(c.mutedText);
    painter.drawText(QRectF(4, top, width() - 4, words.height()), Qt::AlignLeft | Qt::AlignVCenter, arrow + tr("mean"));
    painter.setFont(theme_.smallNumberFont());
    painter.setPen(c.text);
    painter.drawText(QRectF(4, top + words.height() - 2, width() - 4, numbers.height()), Qt::AlignLeft | Qt::AlignVCenter,
                     toQString(analysis::formatNumber(*content_.mean)));
}

}  // namespace emca::explorer
