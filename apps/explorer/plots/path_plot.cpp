#include "plots/path_plot.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>
#include <QToolButton>
#include <algorithm>

#include "base/bar_button.h"
#include "base/filter_menu.h"
#include "base/grouped.h"
#include "base/path_ids.h"
#include "base/plot_export.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/table_text.h"
#include "base/text_line.h"
#include "emca/analysis/format.h"
#include "plots/marginal_histogram.h"

namespace emca::explorer {

using client::PathId;
using client::SelectionPart;

PathPlot::PathPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, std::vector<PathPlotRow> rows,
                   QWidget* parent)
    : QWidget(parent),
      dataset_(dataset),
      selection_(selection),
      theme_(theme),
      area_(new QWidget),
      logButton_(barButton(tr("Log"), tr("Logarithmic values (L)"))),
      resetButton_(barButton(tr("Reset zoom"), tr("Show all paths again (double click, Home)"))),
      summary_(new TextLine(theme, Qt::AlignRight, true)),
      overlay_(new StateOverlay(theme, area_)),
      datasetListening_(dataset,
                        [this](std::uint32_t parts) {
                            if (parts & client::DatasetPart::currentTrace) reload();
                        }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (SelectionPart::paths | SelectionPart::currentPath)) select();
          if (parts & SelectionPart::hover) hover();
      }) {
    logButton_->setCheckable(true);
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::medium, Spacing::tiny);
    bar->setSpacing(Spacing::tiny);
    bar->addWidget(logButton_);
    bar->addWidget(resetButton_);
    bar->addWidget(summary_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(area_, 1);
    area_->setAutoFillBackground(true);
    const auto restyle = [this] {
        QPalette ground = area_->palette();
        ground.setColor(QPalette::Window, theme_.colors().ground);
        area_->setPalette(ground);
    };
    restyle();
    connect(&theme_, &Theme::themeChanged, this, restyle);
    connect(logButton_, &QToolButton::clicked, this, &PathPlot::setLog);
    connect(resetButton_, &QToolButton::clicked, this, &PathPlot::resetZoom);
    bool anyLog = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        anyLog |= rows[i].log;
        addRow(std::move(rows[i]));
    }
    logButton_->setVisible(anyLog);
    reload();
}

PathPlot::~PathPlot() = default;

void PathPlot::addRow(PathPlotRow spec) {
    auto row = std::make_unique<Row>();
    row->spec = std::move(spec);
    row->plot = new ScatterPlot(theme_, area_);
    row->plot->setLogAllowed(row->spec.log);
    row->plot->setMeanShown(row->spec.mean);
    row->plot->setColor(row->spec.color);
    row->plot->setAxes({tr("sample index"), {}, true, false}, row->spec.axis);
    Row& added = *row;
    row->plot->setDescription([this, &added](std::uint32_t point) { return describe(added, point); });
    connectRow(added);
    rows_.push_back(std::move(row));
}

void PathPlot::connectRow(Row& row) {
    ScatterPlot* plot = row.plot;
    connect(plot, &ScatterPlot::clicked, this, [this, &row](std::uint32_t point, Qt::KeyboardModifiers modifiers) {
        const PathId id = pathId(dataset_.paths(), row.series.paths[point]);
        if (modifiers & (Qt::ShiftModifier | Qt::ControlModifier)) {
            selection_.togglePath(id);
        } else {
            selection_.setPaths({id});
        }
    });
    connect(plot, &ScatterPlot::areaSelected, this,
            [this, &row](const QVector<quint32>& points, bool add) { choose(row, points, add); });
    connect(plot, &ScatterPlot::hovered, this, [this, &row](std::optional<std::uint32_t> point) {
        if (!point) return selection_.setHovered(std::nullopt);
        // Depth 0 is the camera: the path as a whole.
        selection_.setHovered(client::VertexId{pathId(dataset_.paths(), row.series.paths[*point]), 0, Subpath::camera});
    });
    connect(plot, &ScatterPlot::menuRequested, this,
            [this, &row](const QPoint& at, std::optional<std::uint32_t> point) { showMenu(row, at, point); });
    connect(plot, &ScatterPlot::logToggled, this, [this] { setLog(!log_); });
    connect(plot, &ScatterPlot::clearRequested, this, [this] { selection_.clearPaths(); });
    connect(plot, &ScatterPlot::zoomResetRequested, this, &PathPlot::resetZoom);
    connect(plot, &ScatterPlot::zoomChanged, this, [this, plot] {
        for (const auto& other : rows_) other->plot->setXZoom(plot->xZoom());
        updateState();
    });
    connect(plot, &ScatterPlot::axisWidthChanged, this, &PathPlot::alignAxes);
}

void PathPlot::reload() {
    const PathSet& paths = dataset_.paths();
    // Sample indices of several pixels are the same numbers: their paths stand one pixel after the other.
    const bool several = severalPixels(paths);
    if (several != several_) {
        several_ = several;
        for (const auto& row : rows_) row->plot->setAxes({several ? tr("path, pixel after pixel") : tr("sample index"), {}, true, false}, row->spec.axis);
    }
    for (const auto& row : rows_) {
        row->series = row->spec.series(paths);
        row->shown = !row->spec.optional || !row->series.values.empty();
        std::vector<double> samples;
        samples.reserve(row->series.size());
        for (const Index path : row->series.paths) samples.push_back(several ? double(path) : static_cast<double>(paths.sample(path)));
        row->plot->setVisible(row->shown);
        row->plot->setPoints(std::move(samples), row->series.values);
    }
    placeRows();
    select();
}

std::optional<std::uint32_t> PathPlot::pointOf(const Row& row, Index path) const {
    const auto at = std::lower_bound(row.series.paths.begin(), row.series.paths.end(), path);
    if (at == row.series.paths.end() || *at != path) return std::nullopt;
    return static_cast<std::uint32_t>(at - row.series.paths.begin());
}

void PathPlot::select() {
    const PathSet& paths = dataset_.paths();
    const client::Selection::State& state = selection_.state();
    const std::vector<Index> chosen = findPaths(paths, state.paths);
    const std::optional<Index> current = state.currentPath ? findPath(paths, *state.currentPath) : std::nullopt;
    for (const auto& row : rows_) {
        std::vector<std::uint32_t> points;
        points.reserve(chosen.size());
        for (const Index path : chosen)
            if (const auto point = pointOf(*row, path)) points.push_back(*point);
        row->plot->setSelected(std::move(points), current ? pointOf(*row, *current) : std::nullopt);
    }
    updateState();
}

void PathPlot::hover() {
    const std::optional<client::VertexId>& hovered = selection_.hovered();
    const std::optional<Index> path = hovered ? findPath(dataset_.paths(), hovered->path) : std::nullopt;
    for (const auto& row : rows_) row->plot->setHovered(path ? pointOf(*row, *path) : std::nullopt);
}

void PathPlot::choose(const Row& row, const QVector<quint32>& points, bool add) {
    std::vector<PathId> ids;
    if (add) ids = selection_.state().paths;
    for (const quint32 point : points) ids.push_back(pathId(dataset_.paths(), row.series.paths[point]));
    selection_.setPaths(std::move(ids));
}

void PathPlot::setLog(bool log) {
    log_ = log;
    logButton_->setChecked(log);
    for (const auto& row : rows_) row->plot->setLog(log);
    updateState();
}

void PathPlot::resetZoom() {
    for (const auto& row : rows_) row->plot->resetZoom();
    updateState();
}

void PathPlot::updateState() {
    const PathSet& paths = dataset_.paths();
    const bool anything =
        std::any_of(rows_.begin(), rows_.end(), [](const auto& row) { return row->series.size() > 0; });
    resetButton_->setEnabled(
        std::any_of(rows_.begin(), rows_.end(), [](const auto& row) { return row->plot->isZoomed(); }));
    if (paths.empty()) {
        const bool traced = !dataset_.current().empty();
        overlay_->showEmpty(
            traced ? tr("No paths") : tr("Paths of a pixel"),
            traced ? tr("The renderer recorded no path for this pixel") : tr("Click a pixel in the image"));
        summary_->setText({});
        return;
    }
    if (!anything) {
        overlay_->showEmpty(tr("No final estimates"),
                            tr("The renderer recorded no final estimate for the %1 paths of this pixel")
                                .arg(grouped(paths.pathCount())));
    } else {
        overlay_->clear();
    }
    QString text = tr("%1 %2").arg(grouped(paths.pathCount()), paths.pathCount() == 1 ? tr("path") : tr("paths"));
    const std::size_t selected = findPaths(paths, selection_.state().paths).size();
    if (selected > 0) text += tr(", %1 selected").arg(grouped(selected));
    summary_->setText(text);
}

void PathPlot::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    layout()->activate();
    placeRows();
}

void PathPlot::placeRows() {
    std::vector<ScatterPlot*> shown;
    for (const auto& row : rows_)
        if (row->shown) shown.push_back(row->plot);
    if (shown.empty()) return;
    for (ScatterPlot* plot : shown) {
        plot->setXLabelsShown(plot == shown.back());
        plot->histogram()->setCaption(plot == shown.back() ? tr("paths") : QString());
    }
    // The lowest row has the labels of x besides; all canvases are equally high.
    constexpr int kGap = Spacing::small;
    const int count = static_cast<int>(shown.size()), labels = shown.back()->xAxisHeight();
    const int height = area_->height() - 2 * Spacing::tiny, each = (height - labels - kGap * (count - 1)) / count;
    int top = Spacing::tiny;
    for (ScatterPlot* plot : shown) {
        const int own = plot == shown.back() ? height + Spacing::tiny - top : each;
        plot->setGeometry(Spacing::tiny, top, area_->width() - Spacing::tiny, own);
        top += own + kGap;
    }
    alignAxes();
}

void PathPlot::alignAxes() {
    if (aligning_) return;
    const QScopedValueRollback<bool> guard(aligning_, true);
    double width = 0;
    for (const auto& row : rows_)
        if (row->shown) width = std::max(width, row->plot->axisWidth());
    for (const auto& row : rows_) row->plot->setAxisWidth(width);
}

QString PathPlot::describe(const Row& row, std::uint32_t point) const {
    const PathSet& paths = dataset_.paths();
    const Index path = row.series.paths[point];
    QString text = tr("sample %1").arg(toQString(analysis::formatInteger(paths.sample(path))));
    if (paths.part(path) != 0) text += tr(", part %1").arg(paths.part(path));
    if (severalPixels(paths)) text += QLatin1Char(' ') + toQString(analysis::formatPixel(paths.pixel(path)));
    const auto valueOf = [](const Row& of, std::uint32_t i) {
        const double value = of.series.values[i];
        return toQString(of.spec.axis.integral ? analysis::formatInteger(std::int64_t(value))
                                               : analysis::formatNumber(value));
    };
    for (const auto& other : rows_)
        if (const auto there = pointOf(*other, path); there && other->shown)
            text += QStringLiteral("\n%1  %2").arg(other->spec.axis.quantity, valueOf(*other, *there));
    const ScatterContent& content = row.plot->content();
    std::size_t here = 0;
    for (std::size_t i = 0; i < content.xs.size(); ++i)
        here += content.xs[i] == content.xs[point] && content.ys[i] == content.ys[point];
    if (here > 1) text += tr("\nand %1 more here").arg(grouped(here - 1));
    return text;
}

void PathPlot::showMenu(const Row& row, const QPoint& position, std::optional<std::uint32_t> point) {
    QMenu menu(this);
    if (point) {
        const PathId id = pathId(dataset_.paths(), row.series.paths[*point]);
        const double value = row.series.values[*point];
        menu.addAction(tr("Select only this path"), this, [this, id] { selection_.setPaths({id}); });
        menu.addAction(tr("Show only this path"), this, [this, id] { emit showOnlyWanted(id); });
        if (!row.spec.query.empty())
            addFilterMenu(menu, rulesForNumber(row.spec.query, value), [this](const query::Rule& rule) { emit filterWanted(rule); });
        menu.addAction(tr("Copy value"), this,
                       [value] { QApplication::clipboard()->setText(toQString(analysis::formatFull(value))); });
        menu.addSeparator();
    }
    addExportActions(menu, exporting());
    menu.addAction(tr("Copy histograms"), this, [this] {
        QApplication::clipboard()->setText(tabsFromCsv(histogramCsv()));
        emit message(tr("Copied the histograms"));
    });
    menu.addSeparator();
    if (row.spec.log) {
        QAction* log = menu.addAction(tr("Logarithmic values"), this, [this] { setLog(!log_); });
        log->setCheckable(true);
        log->setChecked(log_);
    }
    menu.addAction(tr("Reset zoom"), this, &PathPlot::resetZoom)->setEnabled(resetButton_->isEnabled());
    menu.exec(position);
}

PlotExport PathPlot::exporting() {
    return {this, area_, rows_.front()->spec.axis.quantity, [this](bool on) { for (const auto& row : rows_) row->plot->setExporting(on); },
            [this] { return csv(); }, [this](const QString& sentence) { emit message(sentence); }};
}

bool PathPlot::event(QEvent* event) { return claimExportKeys(*event) || QWidget::event(event); }

void PathPlot::keyPressEvent(QKeyEvent* event) {
    if (handleExportKeys(*event, exporting())) event->accept();
    else QWidget::keyPressEvent(event);
}

Result<void> PathPlot::exportTo(const QString& file, int scale) { return writeExport(exporting(), file, scale); }

QString PathPlot::csv() const {
    const PathSet& paths = dataset_.paths();
    QString text = QStringLiteral("pixel x,pixel y,sample,part");
    for (const auto& row : rows_)
        if (row->shown) text += QLatin1Char(',') + row->spec.axis.quantity;
    text += QLatin1Char('\n');
    for (Index path = 0; path < paths.pathCount(); ++path) {
        text += QStringLiteral("%1,%2,%3,%4")
                    .arg(paths.pixel(path).x)
                    .arg(paths.pixel(path).y)
                    .arg(paths.sample(path))
                    .arg(paths.part(path));
        for (const auto& row : rows_) {
            if (!row->shown) continue;
            text += QLatin1Char(',');
            if (const auto point = pointOf(*row, path)) {
                const double value = row->series.values[*point];
                // The recorded values are floats: their shortest text, not that of a double.
                text += toQString(analysis::formatFull(static_cast<float>(value)));
            }
        }
        text += QLatin1Char('\n');
    }
    return text;
}

QString PathPlot::histogramCsv() const {
    QString text = QStringLiteral("quantity,from,to,paths,selected\n");
    const auto full = [](double value) { return toQString(analysis::formatFull(value)); };
    for (const auto& row : rows_) {
        if (!row->shown) continue;
        const analysis::Histogram &all = row->plot->histogram()->bars(), &chosen = row->plot->histogram()->selectedBars();
        const auto line = [&](const QString& from, const QString& to, std::uint64_t paths, std::uint64_t selected) {
            text += QStringLiteral("%1,%2,%3,%4,%5\n").arg(row->spec.axis.quantity, from, to).arg(paths).arg(selected);
        };
        const bool some = chosen.binCount() == all.binCount();
        if (all.below + all.negativeInfinite > 0)
            line({}, full(all.range.min), all.below + all.negativeInfinite, some ? chosen.below + chosen.negativeInfinite : 0);
        for (std::size_t i = 0; i < all.binCount(); ++i) line(full(all.lower(i)), full(all.upper(i)), all.counts[i], some ? chosen.counts[i] : 0);
        if (all.above + all.positiveInfinite > 0)
            line(full(all.range.max), {}, all.above + all.positiveInfinite, some ? chosen.above + chosen.positiveInfinite : 0);
        if (all.nan > 0) line(QStringLiteral("NaN"), QStringLiteral("NaN"), all.nan, some ? chosen.nan : 0);
    }
    return text;
}

}  // namespace emca::explorer
