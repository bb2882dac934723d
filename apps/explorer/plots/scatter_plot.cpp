#include "plots/scatter_plot.h"

#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_widget.h>
#include <QHBoxLayout>
#include <QLocale>
#include <QScopedValueRollback>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/view_keys.h"
#include "emca/analysis/format.h"
#include "plots/marginal_histogram.h"
#include "plots/mean_label.h"
#include "plots/plot_axis.h"
#include "plots/plot_overlay.h"

namespace emca::explorer {

using analysis::ValueRange;

namespace {

/// All of x with equal room at both ends; whole numbers get half of one.
ValueRange rangeOfX(const std::vector<double>& xs, bool integral) {
    const std::vector<double> sorted = analysis::sortedFinite(xs);
    if (sorted.empty()) return {0, 1, false};
    const double margin = integral ? 0.5 : (sorted.back() - sorted.front()) * 0.01;
    return ValueRange{sorted.front() - margin, sorted.back() + margin, false}.repaired();
}

std::vector<analysis::Tick> ticksOf(const ValueRange& range, bool integral, double room, double each) {
    const int count = std::clamp(static_cast<int>(room / each), 2, 10);
    if (!integral) return analysis::ticks(range, count);
    std::vector<analysis::Tick> ticks = analysis::integerTicks(range, count);
    for (analysis::Tick& tick : ticks)  // whole numbers in full, however large
        if (tick.major && std::abs(tick.value) < 1e9)
            tick.label = QLocale(QLocale::English).toString(qlonglong(std::llround(tick.value))).toStdString();
    return ticks;
}

/// Words in the place of numbers; long ones are cut.
void nameTicks(std::vector<analysis::Tick>& ticks, const QStringList& names, const Theme& theme, std::vector<EdgeLabel>& labels) {
    if (names.isEmpty()) return;
    constexpr int kWidest = 150;  // pixels
    const QFontMetrics metrics(theme.smallNumberFont());
    for (analysis::Tick& tick : ticks) {
        tick.label.clear();
        if (tick.value >= 0 && tick.value < names.size())
            labels.push_back({tick.value, metrics.elidedText(names[int(tick.value)], Qt::ElideRight, kWidest), {}});
    }
}

}  // namespace

ScatterPlot::ScatterPlot(Theme& theme, QWidget* parent)
    : QWidget(parent),
      theme_(theme),
      plot_(new QwtPlot(this)),
      histogram_(new MarginalHistogram(content_, theme, this)),
      overlay_(new PlotOverlay(content_, theme, plot_->canvas())),
      points_(new PointsItem(content_, theme)),
      mean_(new MeanLabel(content_, theme, this)) {
    plot_->setAutoReplot(false);
    plot_->plotLayout()->setAlignCanvasToScales(true);
    plot_->plotLayout()->setSpacing(0);
    plot_->setAxisScaleDraw(QwtPlot::yLeft, new PlotAxisDraw);
    plot_->setAxisScaleDraw(QwtPlot::xBottom, new PlotAxisDraw);
    auto* canvas = static_cast<QwtPlotCanvas*>(plot_->canvas());
    canvas->setFrameStyle(QFrame::NoFrame);
    canvas->setFocusIndicator(QwtPlotCanvas::NoFocusIndicator);
    canvas->setFocusPolicy(Qt::NoFocus);
    canvas->setCursor(Qt::ArrowCursor);
    canvas->setMouseTracking(true);
    // Items belong to the plot, which deletes them.
    (new GridItem(content_, theme))->attach(plot_);
    points_->attach(plot_);
    for (QWidget* widget : {static_cast<QWidget*>(canvas), static_cast<QWidget*>(plot_->axisWidget(QwtPlot::yLeft)),
                            static_cast<QWidget*>(plot_->axisWidget(QwtPlot::xBottom))})
        widget->installEventFilter(this);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(plot_, 1);
    layout->addWidget(mean_);
    layout->addWidget(histogram_);
    setFocusPolicy(Qt::StrongFocus);
    setViewKeys(*this, tr("Plots"), {{"L", tr("Logarithmic values")}, {"R", tr("Select in a rectangle")}, {"Home", tr("Show everything again")}});
    setAutoFillBackground(true);
    connect(&theme_, &Theme::themeChanged, this, &ScatterPlot::restyle);
    connect(histogram_, &MarginalHistogram::barClicked, this, &ScatterPlot::areaSelected);
    findRanges();
    restyle();
}

ScatterPlot::~ScatterPlot() = default;

QWidget* ScatterPlot::canvas() const { return plot_->canvas(); }

void ScatterPlot::colorGroups() {
    content_.groups.clear();
    for (const Group& group : groups_) content_.groups.push_back({group.first, group.last, theme_.colors().*group.color, group.connected});
    if (!groups_.empty()) ++content_.version;
}

void ScatterPlot::restyle() {
    content_.color = theme_.colors().*role_;
    colorGroups();
    QPalette ground = palette();
    ground.setColor(QPalette::Window, theme_.colors().ground);
    setPalette(ground);
    plot_->setPalette(ground);
    static_cast<QwtPlotCanvas*>(plot_->canvas())->setPalette(ground);
    styleAxis(*plot_, QwtPlot::yLeft, yAxis_.title(), theme_);
    styleAxis(*plot_, QwtPlot::xBottom, xLabels_ ? xAxis_.title() : QString(), theme_);
    layoutFrame();
}

void ScatterPlot::setAxes(const PlotAxis& x, const PlotAxis& y) {
    xAxis_ = x;
    yAxis_ = y;
    xAxis_.integral |= !x.names.isEmpty();
    yAxis_.integral |= !y.names.isEmpty();
    histogram_->setIntegral(yAxis_.integral);
    histogram_->setNames(y.names);
    findRanges();
    restyle();
}

void ScatterPlot::setColor(ColorRole role) {
    role_ = role;
    restyle();
}

void ScatterPlot::setDescription(std::function<QString(std::uint32_t)> description) {
    description_ = std::move(description);
}

void ScatterPlot::setPoints(std::vector<double> xs, std::vector<double> ys) { setPoints(std::move(xs), std::move(ys), {}); }

void ScatterPlot::setPoints(std::vector<double> xs, std::vector<double> ys, std::vector<Group> groups) {
    groups_ = std::move(groups);
    colorGroups();
    content_.xs = std::move(xs);
    content_.ys = std::move(ys);
    content_.xs.resize(content_.ys.size());
    ++content_.version;
    content_.selected.clear();
    content_.current.reset();
    hovered_.reset();
    hoveredHere_ = false;
    findRanges();
    const auto left = [](const std::optional<ValueRange>& zoom, const std::vector<double>& values) {
        return !zoom ||
               std::any_of(values.begin(), values.end(), [&](double v) { return v >= zoom->min && v <= zoom->max; });
    };
    if (!left(xZoom_, content_.xs)) xZoom_.reset();
    if (!left(yZoom_, content_.ys)) yZoom_.reset();
    layoutFrame();
}

void ScatterPlot::setSelected(std::vector<std::uint32_t> points, std::optional<std::uint32_t> current) {
    if (points == content_.selected && current == content_.current) return;
    const bool dimmer = points.empty() != content_.selected.empty();
    QRegion changed = overlay_->markedRegion();
    content_.selected = std::move(points);
    content_.current = current;
    changed += overlay_->markedRegion();
    if (dimmer) {
        replotCanvas();
        overlay_->update();
    } else {
        overlay_->update(changed);
    }
    histogram_->refreshSelected();
    emit contentChanged();
}

void ScatterPlot::replotCanvas() {
    // Qwt's own replot() lays the axes out besides, which no selection changes.
    static_cast<QwtPlotCanvas*>(plot_->canvas())->replot();
}

void ScatterPlot::setHovered(std::optional<std::uint32_t> point) {
    if (point == hovered_) return;
    hovered_ = point;
    showHovered();
}

void ScatterPlot::setLog(bool log) {
    if (log == log_ || (log && !logAllowed_)) return;
    log_ = log;
    yZoom_.reset();
    findRanges();
    layoutFrame();
}

void ScatterPlot::setMeanShown(bool shown) {
    meanShown_ = shown;
    mean_->setVisible(shown);
    findRanges();
    refresh();
}

void ScatterPlot::resetZoom() {
    xZoom_.reset();
    yZoom_.reset();
    layoutFrame();
}

void ScatterPlot::setXZoom(std::optional<ValueRange> range) {
    if (range == xZoom_) return;
    xZoom_ = range;
    layoutFrame();
}

void ScatterPlot::setXLabelsShown(bool shown) {
    if (shown == xLabels_) return;
    xLabels_ = shown;
    plot_->enableAxis(QwtPlot::xBottom, shown);
    restyle();
}

double ScatterPlot::axisWidth() const {
    auto* draw = plot_->axisScaleDraw(QwtPlot::yLeft);
    const double minimum = draw->minimumExtent();
    draw->setMinimumExtent(0);
    const double natural = draw->extent(plot_->axisFont(QwtPlot::yLeft));
    draw->setMinimumExtent(minimum);
    return natural;
}

void ScatterPlot::setAxisWidth(double width) {
    if (width == axisWidth_) return;
    axisWidth_ = width;
    auto* draw = plot_->axisScaleDraw(QwtPlot::yLeft);
    draw->setMinimumExtent(width);
    // The only call that makes Qwt place the title anew without changing anything else.
    plot_->axisWidget(QwtPlot::yLeft)->setLabelAlignment(draw->labelAlignment());
    plot_->updateLayout();
}

int ScatterPlot::xAxisHeight() const { return xLabels_ ? plot_->axisWidget(QwtPlot::xBottom)->sizeHint().height() : 0; }

QString ScatterPlot::hoverText() const { return overlay_->text(); }

void ScatterPlot::setExporting(bool exporting) {
    static_cast<QwtPlotCanvas*>(plot_->canvas())->setPaintAttribute(QwtPlotCanvas::BackingStore, !exporting);
}

void ScatterPlot::findRanges() {
    xFull_ = rangeOfX(content_.xs, xAxis_.integral);
    analysis::RobustRangeOptions options;
    options.log = log_;
    options.includeZero = yAxis_.includeZero && !log_;
    if (yAxis_.integral && !log_) {
        // Whole numbers: each gets a row of the same height.
        yFull_ = analysis::robustRange(content_.ys, options).range;
        yFull_ = {std::floor(yFull_.min + 0.5) - 0.5, std::floor(yFull_.max + 0.5) + 0.5, false};
    } else {
        yFull_ = analysis::robustRange(content_.ys, options).range;
    }
    content_.mean.reset();
    const analysis::Summary summary = analysis::summarize(content_.ys);
    if (meanShown_ && summary.finite > 1) content_.mean = summary.mean;
}

void ScatterPlot::layoutFrame() {
    if (layingOut_) return;  // a resize that comes of the loop below, which looks for it
    {
        const QScopedValueRollback<bool> guard(layingOut_, true);
        // Qwt narrows the canvas for labels that stick out, and then other labels do. Each round lets fewer stand at the
        // right end, so that this ends.
        for (const int room : {2, 16, 64, 128}) {
            const QSize before = plot_->canvas()->size();
            layoutFrame(room);
            if (plot_->canvas()->size() == before) break;
        }
    }
    emit axisWidthChanged();
}

void ScatterPlot::layoutFrame(int roomAtTheRight) {
    const QSizeF size = plot_->canvas()->contentsRect().size();
    const ValueRange x = xZoom_.value_or(xFull_), y = yZoom_.value_or(yFull_);
    const PlotFrame::Rows rows = PlotFrame::rowsFor(content_.ys, y);
    content_.frame = PlotFrame(size, x, y, rows);
    const PlotFrame& frame = content_.frame;
    content_.xTicks = ticksOf(x, xAxis_.integral, frame.x().end - frame.x().start, 80);
    content_.yTicks = ticksOf(y, yAxis_.integral && !log_, frame.y().start - frame.y().end, 20);
    // A label that would stick out at the right would make this canvas narrower than those above it, too.
    const QFontMetrics metrics(theme_.smallNumberFont());
    for (analysis::Tick& tick : content_.xTicks)
        if (frame.x().pixel(tick.value) + metrics.horizontalAdvance(tickText(tick.label)) / 2.0 > size.width() - roomAtTheRight)
            tick.label.clear();
    std::vector<EdgeLabel> edges;
    nameTicks(content_.yTicks, yAxis_.names, theme_, edges);
    const auto edge = [&](PlotRow row, const QString& text, const QColor& color) {
        edges.push_back({frame.y().value(frame.center(row)), text, color});
    };
    const bool common = log_ && std::any_of(content_.ys.begin(), content_.ys.end(), [](double v) { return v <= 0; });
    if (rows.below && common) edge(PlotRow::below, QStringLiteral("≤ 0"), {});
    if (rows.nan) edge(PlotRow::nan, QStringLiteral("NaN"), theme_.colors().warning);
    applyAxis(*plot_, QwtPlot::yLeft, frame.spannedY(), content_.yTicks, std::move(edges));
    applyAxis(*plot_, QwtPlot::xBottom, frame.spannedX(), content_.xTicks, {});
    refresh();
}

void ScatterPlot::refresh() {
    plot_->replot();
    const QPoint top = plot_->canvas()->mapTo(this, QPoint(0, 0));
    histogram_->setCanvas(top.y(), plot_->canvas()->height());
    histogram_->refresh();
    mean_->setCanvasTop(top.y());
    overlay_->setGeometry(plot_->canvas()->rect());
    overlay_->update();
    showHovered();
    emit contentChanged();
}

void ScatterPlot::showHovered() {
    std::optional<QPointF> at;
    QString text;
    if (hovered_ && *hovered_ < content_.xs.size()) {
        const std::uint32_t i = *hovered_;
        at = content_.frame.place(content_.xs[i], content_.ys[i]);
        if (hoveredHere_ && description_) text = description_(i);
        if (hoveredHere_ && !description_)
            text = QStringLiteral("%1  %2\n%3  %4")
                       .arg(xAxis_.quantity, toQString(analysis::formatNumber(content_.xs[i])), yAxis_.quantity,
                            toQString(analysis::formatNumber(content_.ys[i])));
    }
    overlay_->setHovered(at, PointsItem::radius(content_.xs.size()) + 2.5, text);
}

void ScatterPlot::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    plot_->updateLayout();
    layoutFrame();
}

}  // namespace emca::explorer
