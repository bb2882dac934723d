#include "plots/bar_histogram.h"

#include <QMouseEvent>
#include <QToolTip>

#include "base/qt_compat.h"

namespace emca::explorer {

BarHistogram::BarHistogram(const ScatterContent& content, const std::vector<double>& values, const Theme& theme, QWidget* parent)
    : QWidget(parent), content_(content), theme_(theme), values_(values) {
    setMouseTracking(true);
}

void BarHistogram::count(analysis::ValueRange range, std::size_t bins) {
    all_ = analysis::histogram(values_, range, bins);
    selected_ = histogramOfSelected();
}

analysis::Histogram BarHistogram::histogramOfSelected() const {
    std::vector<double> chosen;
    chosen.reserve(content_.selected.size());
    for (const std::uint32_t i : content_.selected) chosen.push_back(values_[i]);
    return analysis::histogram(chosen, all_.range, all_.binCount());
}

void BarHistogram::mousePressEvent(QMouseEvent* event) {
    const int bar = event->button() == Qt::LeftButton ? barAt(positionOf(*event)) : -1;
    if (bar < 0) return QWidget::mousePressEvent(event);
    const double low = all_.lower(std::size_t(bar)), high = all_.upper(std::size_t(bar));
    const bool last = std::size_t(bar) + 1 == all_.binCount();
    QVector<quint32> points;
    for (std::uint32_t i = 0; i < values_.size(); ++i)
        if (values_[i] >= low && (values_[i] < high || (last && values_[i] <= high))) points.append(i);
    emit barClicked(points, event->modifiers() & (Qt::ShiftModifier | Qt::ControlModifier));
}

void BarHistogram::mouseMoveEvent(QMouseEvent* event) {
    const int bar = barAt(positionOf(*event));
    if (bar != hovered_) {
        hovered_ = bar;
        update();
    }
    if (bar < 0) return QToolTip::hideText();
    QToolTip::showText(globalPositionOf(*event), tip(std::size_t(bar)), this);
}

void BarHistogram::leaveEvent(QEvent*) {
    hovered_ = -1;
    update();
}

}  // namespace emca::explorer
