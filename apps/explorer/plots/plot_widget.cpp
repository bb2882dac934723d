#include "plots/plot_widget.h"

#include <QApplication>
#include <QClipboard>
#include <QKeyEvent>
#include <QMenu>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "plots/marginal_histogram.h"
#include "plots/scatter_plot.h"
#include "plots/top_histogram.h"

namespace emca::explorer {
namespace {

/// A value as its axis says it.
QString valueText(double value, const PlotAxis& axis) {
    const bool whole = std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15;
    if (whole && value >= 0 && value < axis.names.size()) return axis.names[int(value)];
    if (whole && axis.integral) return toQString(analysis::formatInteger(static_cast<std::int64_t>(value)));
    return toQString(analysis::formatNumber(value));
}

/// A field of a CSV file, quoted where it must be (RFC 4180).
QString field(const QString& text) {
    if (!text.contains(QLatin1Char(',')) && !text.contains(QLatin1Char('"')) && !text.contains(QLatin1Char('\n'))) return text;
    return QLatin1Char('"') + QString(text).replace(QLatin1String("\""), QLatin1String("\"\"")) + QLatin1Char('"');
}

}  // namespace

PlotWidget::PlotWidget(Theme& theme, QWidget* parent) : QWidget(parent), plot_(new ScatterPlot(theme, this)), top_(new TopHistogram(plot_->content(), theme, this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(top_);
    layout->addWidget(plot_, 1);
    top_->hide();
    plot_->setMeanShown(false);
    plot_->histogram()->setCounted(tr("value"), tr("values"));
    plot_->setDescription([this](std::uint32_t index) { return describe(index); });
    setFocusProxy(plot_);
    connect(plot_, &ScatterPlot::contentChanged, this, [this] {
        if (top_->isVisibleTo(this)) top_->refresh(plot_->canvas()->mapTo(this, QPoint(0, 0)).x());
    });
    const auto area = [this](const QVector<quint32>& indices, bool add) {
        std::vector<PlotPoint> points;
        for (const quint32 index : indices) points.push_back(pointOf(index));
        if (selected_) selected_(points, add);
    };
    connect(plot_, &ScatterPlot::areaSelected, this, area);
    connect(top_, &TopHistogram::barClicked, this, area);
    connect(plot_, &ScatterPlot::clicked, this, [this](std::uint32_t index, Qt::KeyboardModifiers modifiers) {
        if (clicked_) clicked_(pointOf(index), modifiers);
    });
    connect(plot_, &ScatterPlot::hovered, this, [this](std::optional<std::uint32_t> index) {
        if (hovered_) hovered_(index ? std::optional(pointOf(*index)) : std::nullopt);
    });
    connect(plot_, &ScatterPlot::logToggled, this, &PlotWidget::changeLog);
    connect(plot_, &ScatterPlot::zoomResetRequested, plot_, &ScatterPlot::resetZoom);
    connect(plot_, &ScatterPlot::menuRequested, this, &PlotWidget::showMenu);
}

PlotWidget::~PlotWidget() = default;

void PlotWidget::setAxes(const PlotAxis& x, const PlotAxis& y) {
    plot_->setAxes(x, y);
    plot_->setLogAllowed(y.names.isEmpty());
    if (!y.names.isEmpty()) plot_->setLog(false);
    top_->setIntegral(plot_->xAxis().integral);
}

void PlotWidget::setSeries(std::vector<PlotSeries> series) {
    names_.clear();
    first_ = {0};
    std::vector<double> xs, ys;
    std::vector<ScatterPlot::Group> groups;
    for (PlotSeries& one : series) {
        one.xs.resize(one.ys.size());
        xs.insert(xs.end(), one.xs.begin(), one.xs.end());
        ys.insert(ys.end(), one.ys.begin(), one.ys.end());
        const auto last = static_cast<std::uint32_t>(xs.size());
        groups.push_back({first_.back(), last, one.color, one.connected});
        names_.push_back(one.name);
        first_.push_back(last);
    }
    plot_->setColor(series.size() == 1 ? series.front().color : &ThemeColors::data);
    plot_->setPoints(std::move(xs), std::move(ys), std::move(groups));
}

bool PlotWidget::holds(PlotPoint point) const {
    return point.series < names_.size() && point.point < first_[point.series + 1] - first_[point.series];
}

std::uint32_t PlotWidget::indexOf(PlotPoint point) const { return first_[point.series] + point.point; }

PlotPoint PlotWidget::pointOf(std::uint32_t index) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), index);
    const auto series = static_cast<std::uint32_t>(after - first_.begin() - 1);
    return {series, index - first_[series]};
}

void PlotWidget::setSelected(const std::vector<PlotPoint>& points, std::optional<PlotPoint> current) {
    std::vector<std::uint32_t> indices;
    for (const PlotPoint point : points)
        if (holds(point)) indices.push_back(indexOf(point));
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    plot_->setSelected(std::move(indices), current && holds(*current) ? std::optional(indexOf(*current)) : std::nullopt);
}

void PlotWidget::setHovered(std::optional<PlotPoint> point) {
    plot_->setHovered(point && holds(*point) ? std::optional(indexOf(*point)) : std::nullopt);
}

void PlotWidget::setLog(bool log) { plot_->setLog(log); }
bool PlotWidget::isLog() const { return plot_->isLog(); }

void PlotWidget::changeLog() {
    plot_->setLog(!plot_->isLog());
    if (logChanged_) logChanged_();
}

void PlotWidget::setHistograms(bool alongX, bool alongY) {
    top_->setVisible(alongX);
    plot_->histogram()->setVisible(alongY);
    if (alongX) top_->refresh(plot_->canvas()->mapTo(this, QPoint(0, 0)).x());
}

void PlotWidget::setXLabelsShown(bool shown) { plot_->setXLabelsShown(shown); }
double PlotWidget::axisWidth() const { return plot_->axisWidth(); }
void PlotWidget::setAxisWidth(double width) { plot_->setAxisWidth(width); }
void PlotWidget::setDescription(std::function<QString(PlotPoint)> description) { description_ = std::move(description); }

QString PlotWidget::describe(std::uint32_t index) const {
    if (description_) return description_(pointOf(index));
    const ScatterContent& content = plot_->content();
    QString text = QStringLiteral("%1  %2\n%3  %4")
                       .arg(plot_->xAxis().quantity, valueText(content.xs[index], plot_->xAxis()), plot_->yAxis().quantity,
                            valueText(content.ys[index], plot_->yAxis()));
    const QString& name = names_[pointOf(index).series];
    if (names_.size() > 1 && !name.isEmpty()) text += QStringLiteral(" (%1)").arg(name);
    return text;
}

QString PlotWidget::csv() const {
    const bool named = names_.size() > 1;
    QString text = (named ? QStringLiteral("series,") : QString()) + field(plot_->xAxis().title()) + QLatin1Char(',') + field(plot_->yAxis().title()) + QLatin1Char('\n');
    const auto full = [](double value, const PlotAxis& axis) {
        return axis.names.isEmpty() ? toQString(analysis::formatFull(value)) : field(valueText(value, axis));
    };
    for (std::uint32_t i = 0; i < plot_->content().xs.size(); ++i) {
        if (named) text += field(names_[pointOf(i).series]) + QLatin1Char(',');
        text += full(plot_->content().xs[i], plot_->xAxis()) + QLatin1Char(',') + full(plot_->content().ys[i], plot_->yAxis()) + QLatin1Char('\n');
    }
    return text;
}

Result<void> PlotWidget::exportTo(const QString& file) { return exportTo(file, 2); }

Result<void> PlotWidget::exportTo(const QString& file, int scale) { return writeExport(exporting(), file, scale); }

void PlotWidget::showMenu(const QPoint& position, std::optional<std::uint32_t> index) {
    QMenu menu(this);
    if (index) {
        const double value = plot_->content().ys[*index];
        const QString text = plot_->yAxis().names.isEmpty() ? toQString(analysis::formatFull(value)) : valueText(value, plot_->yAxis());
        menu.addAction(tr("Copy value"), this, [text] { QApplication::clipboard()->setText(text); });
        menu.addSeparator();
    }
    addExportActions(menu, exporting());
    menu.addSeparator();
    if (plot_->yAxis().names.isEmpty()) {
        QAction* log = menu.addAction(tr("Logarithmic values"), this, &PlotWidget::changeLog);
        log->setCheckable(true);
        log->setChecked(isLog());
    }
    menu.addAction(tr("Reset zoom"), plot_, &ScatterPlot::resetZoom)->setEnabled(plot_->isZoomed());
    menu.exec(position);
}

PlotExport PlotWidget::exporting() {
    return {this, this, plot_->yAxis().quantity, [this](bool on) { plot_->setExporting(on); },
            [this] { return csv(); }, [this](const QString& sentence) { emit message(sentence); }};
}

bool PlotWidget::event(QEvent* event) { return claimExportKeys(*event) || QWidget::event(event); }

void PlotWidget::keyPressEvent(QKeyEvent* event) {
    if (handleExportKeys(*event, exporting())) event->accept();
    else QWidget::keyPressEvent(event);
}

}  // namespace emca::explorer
