#include "data_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QIcon>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QToolButton>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>

#include "emca/analysis/format.h"
#include "emca/analysis/tone_map.h"

namespace emca::intersection_data {

using client::DatasetPart;
using client::SelectionPart;
using explorer::ColorRole;
using explorer::PlotPoint;
using explorer::PlotSeries;
using explorer::Spacing;
using explorer::ThemeColors;

namespace {

constexpr int kLowest = 104, kLowestSquare = 240;   // heights of a plot over depth, and of one that has both histograms
constexpr int kChosenAtFirst = 3;

QString qt(const std::string& text) { return QString::fromStdString(text); }

struct Channel {
    const char* name;
    ColorRole color;
};
std::vector<Channel> channelsOf(Kind kind) {
    if (kind == Kind::color) return {{"red", &ThemeColors::red}, {"green", &ThemeColors::green}, {"blue", &ThemeColors::blue}};
    if (kind == Kind::vector) return {{"x", &ThemeColors::axisX}, {"y", &ThemeColors::axisY}, {"z", &ThemeColors::axisZ}};
    return {{"", &ThemeColors::data}};
}

}  // namespace

DataPanel::DataPanel(explorer::PluginContext& context) : context_(context) {
    setObjectName("intersectionData");
    chosen_ = context_.setting("chosen").toStringList();
    log_ = context_.setting("log", false).toBool();
    makeControls();
    dataset_ = context_.onDataset([this](std::uint32_t parts) {
        if (parts & DatasetPart::currentTrace) reload();
    });
    selection_ = context_.onSelection([this](std::uint32_t parts) {
        if (parts & (SelectionPart::paths | SelectionPart::currentPath)) {
            if (currentPath() != path_) return reload();
        }
        if (parts & SelectionPart::vertex) showVertex();
        if (parts & SelectionPart::hover) showHovered();
    });
    look_ = context_.onLook([this] {
        restyle();
        showVertex();
    });
    settings_ = context_.onSettings([this] {
        chosen_ = context_.setting("chosen").toStringList();
        setLog(context_.setting("log", false).toBool());
        splitter_->restoreState(context_.setting("splitter").toByteArray());
        reload();
    });
    reload();
}

void DataPanel::makeControls() {
    title_ = new QLabel;
    title_->setObjectName("dataTitle");
    title_->setMinimumWidth(40);
    logButton_ = new QToolButton;
    logButton_->setText(tr("Log"));
    logButton_->setCheckable(true);
    logButton_->setChecked(log_);
    logButton_->setFocusPolicy(Qt::NoFocus);
    logButton_->setToolTip(tr("Logarithmic values in all plots (L in a plot: in that one)"));
    connect(logButton_, &QToolButton::clicked, this, &DataPanel::setLog);
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::medium, Spacing::tiny, Spacing::small, Spacing::tiny);
    bar->addWidget(title_, 1);
    bar->addWidget(logButton_);

    list_ = new QTreeWidget;
    list_->setObjectName("quantities");
    list_->setColumnCount(2);
    list_->setHeaderLabels({tr("Quantity"), tr("At the vertex")});
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setToolTip(tr("Choose what is plotted; Ctrl and Shift choose several"));
    list_->header()->setStretchLastSection(true);
    list_->header()->resizeSection(0, 124);
    list_->setIconSize(QSize(20, 12));
    connect(list_, &QTreeWidget::itemSelectionChanged, this, &DataPanel::choose);

    column_ = new QWidget;
    rows_ = new QVBoxLayout(column_);
    rows_->setContentsMargins(Spacing::tiny, Spacing::small, 0, Spacing::tiny);
    rows_->setSpacing(Spacing::small);
    scroll_ = new QScrollArea;
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setWidgetResizable(true);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll_->setWidget(column_);
    column_->setAutoFillBackground(true);
    restyle();

    splitter_ = new QSplitter;
    splitter_->addWidget(list_);
    splitter_->addWidget(scroll_);
    splitter_->setStretchFactor(0, 0);
    splitter_->setStretchFactor(1, 1);
    splitter_->setSizes({212, 340});
    splitter_->restoreState(context_.setting("splitter").toByteArray());
    connect(splitter_, &QSplitter::splitterMoved, this, &DataPanel::keepSettings);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(splitter_, 1);
}

void DataPanel::restyle() {
    // By palette: a style sheet would reach into the plots.
    QPalette ground = column_->palette();
    ground.setColor(QPalette::Window, context_.colors().ground);
    column_->setPalette(ground);
}

void DataPanel::keepSettings() {
    context_.setSetting("chosen", chosen_);
    context_.setSetting("log", log_);
    context_.setSetting("splitter", splitter_->saveState());
}

// Data -------------------------------------------------------------------------------------------

std::optional<Index> DataPanel::currentPath() const {
    const PathSet& paths = context_.dataset().paths();
    const client::Selection::State& state = context_.selection().state();
    std::optional<client::PathId> id = state.currentPath;
    if (!id && !state.paths.empty()) id = state.paths.front();
    return id ? paths.findPath(id->pixel, id->sample, id->part) : std::nullopt;
}

client::VertexId DataPanel::idOf(Index vertex) const {
    const PathSet& paths = context_.dataset().paths();
    const Index path = paths.pathOf(vertex);
    return {{paths.pixel(path), paths.sample(path), paths.part(path)}, paths.depthIndex(vertex), paths.subpath(vertex)};
}

std::optional<Index> DataPanel::vertexAt(const std::optional<client::VertexId>& id) const {
    if (!id) return std::nullopt;
    const PathSet& paths = context_.dataset().paths();
    const auto path = paths.findPath(id->path.pixel, id->path.sample, id->path.part);
    return path && path == path_ ? paths.findVertex(*path, id->depth, id->subpath) : std::nullopt;
}

void DataPanel::reload() {
    path_ = currentPath();
    stale_ = !isVisible();
    if (stale_) return;   // behind another tab: what is not seen costs nothing
    const PathSet& paths = context_.dataset().paths();
    quantities_ = path_ ? quantitiesOf(paths, *path_) : std::vector<Quantity>();
    if (paths.empty()) context_.showEmpty(tr("Data of a path"), tr("Click a pixel in the image"));
    else if (!path_) context_.showEmpty(tr("Data of a path"), tr("Select a path in a plot, in the tree or in the scene"));
    else if (quantities_.empty()) context_.showEmpty(tr("No data"), tr("The renderer recorded no values at the vertices of this path (addIntersectionData)"));
    else context_.showContent();
    title_->setText(path_ ? tr("Path %1, %2 quantities").arg(paths.sample(*path_)).arg(quantities_.size()) : QString());
    fillList();
    plotChosen();
}

void DataPanel::fillList() {
    filling_ = true;
    const int scrolled = list_->verticalScrollBar()->value();
    list_->clear();
    bool any = false;
    for (const Quantity& quantity : quantities_) {
        auto* row = new QTreeWidgetItem(list_, {qt(quantity.name), QString()});
        row->setToolTip(0, quantity.unit.empty() ? qt(quantity.name) : qt(quantity.name) + QStringLiteral(", ") + qt(quantity.unit));
        row->setFont(1, context_.numberFont());
        row->setSelected(chosen_.contains(qt(quantity.name)));
        any |= row->isSelected();
    }
    for (int row = 0; !any && row < std::min(kChosenAtFirst, list_->topLevelItemCount()); ++row) list_->topLevelItem(row)->setSelected(true);
    list_->verticalScrollBar()->setValue(scrolled);
    filling_ = false;
}

void DataPanel::choose() {
    if (filling_) return;
    chosen_.clear();
    for (int row = 0; row < list_->topLevelItemCount(); ++row)
        if (list_->topLevelItem(row)->isSelected()) chosen_ << list_->topLevelItem(row)->text(0);
    keepSettings();
    plotChosen();
}

// Plots ------------------------------------------------------------------------------------------

explorer::Plot& DataPanel::plotAt(std::size_t row) {
    while (plots_.size() <= row) {
        plots_.push_back(&context_.makePlot(column_));
        rows_->addWidget(plots_.back()->widget(), 1);
        connectPlot(plots_.size() - 1);
    }
    return *plots_[row];
}

void DataPanel::connectPlot(std::size_t row) {
    plots_[row]->onClick([this, row](PlotPoint point, Qt::KeyboardModifiers) {
        context_.selectVertex(idOf(shown_[row].vertices[point.series][point.point]));
    });
    plots_[row]->onArea([this, row](const std::vector<PlotPoint>& points, bool) {
        if (!points.empty()) context_.selectVertex(idOf(shown_[row].vertices[points.front().series][points.front().point]));
    });
    plots_[row]->onHover([this, row](std::optional<PlotPoint> point) {
        context_.hover(point ? std::optional(idOf(shown_[row].vertices[point->series][point->point])) : std::nullopt);
    });
    plots_[row]->setDescription([this, row](PlotPoint point) { return describe(shown_[row], point); });
    plots_[row]->onLog([this] { placePlots(); });
}

void DataPanel::plotChosen() {
    shown_.clear();
    for (int row = 0; row < list_->topLevelItemCount(); ++row) {
        if (!list_->topLevelItem(row)->isSelected()) continue;
        Shown shown;
        shown.quantity = static_cast<std::size_t>(row);
        shown.plot = &plotAt(shown_.size());
        fillPlot(shown, quantities_[shown.quantity]);
        shown_.push_back(std::move(shown));
    }
    for (std::size_t i = 0; i < plots_.size(); ++i) plots_[i]->widget()->setVisible(i < shown_.size());
    placePlots();
    showVertex();
}

void DataPanel::fillPlot(Shown& shown, const Quantity& quantity) {
    const QString name = qt(quantity.name);
    const bool isPoint = quantity.kind == Kind::point, isSpectrum = quantity.kind == Kind::spectrum;
    shown.overDepth = !isPoint && !isSpectrum;
    explorer::PlotAxis x{tr("depth"), {}, true, false, {}}, y{name, qt(quantity.unit), quantity.integral, quantity.kind == Kind::color, {}};
    for (const std::string& word : quantity.words) y.names << qt(word);
    if (isPoint) {
        x = {name + QStringLiteral(" x"), {}, quantity.integral, false, {}};
        y.quantity = name + QStringLiteral(" y");
    } else if (isSpectrum) {
        x = {tr("entry"), {}, true, false, {}};
    }
    shown.plot->setLog(false);
    shown.plot->setAxes(x, y);
    shown.plot->setHistograms(isPoint, isPoint || quantity.kind == Kind::text);
    shown.plot->setSeries(seriesOf(shown, quantity));
    shown.plot->setLog(log_);
    shown.plot->widget()->setMinimumHeight(isPoint ? kLowestSquare : kLowest);
}

std::vector<PlotSeries> DataPanel::seriesOf(Shown& shown, const Quantity& quantity) const {
    const PathSet& paths = context_.dataset().paths();
    std::vector<PlotSeries> series;
    shown.vertices.clear();
    const auto add = [&](const QString& name, ColorRole color) {
        series.push_back({name, color, {}, {}, quantity.kind != Kind::text && quantity.words.empty()});
        shown.vertices.emplace_back();
    };
    const auto put = [&](double x, double y, Index vertex) {
        series.back().xs.push_back(x);
        series.back().ys.push_back(y);
        shown.vertices.back().push_back(vertex);
    };
    if (quantity.kind == Kind::spectrum) {
        for (const Entry& entry : quantity.entries) {
            add(tr("vertex %1").arg(paths.depthIndex(entry.vertex)), &ThemeColors::data);
            for (std::size_t i = 0; i < entry.numbers.size(); ++i) put(double(i), entry.numbers[i], entry.vertex);
        }
        return series;
    }
    // The subpath from a light has depths of its own, and so curves of its own.
    for (const Subpath subpath : {Subpath::camera, Subpath::light}) {
        const bool there = std::any_of(quantity.entries.begin(), quantity.entries.end(), [&](const Entry& e) { return paths.subpath(e.vertex) == subpath; });
        if (!there) continue;
        const QString of = subpath == Subpath::light ? tr("from the light ") : QString();
        if (quantity.kind == Kind::point) {
            add(of, subpath == Subpath::light ? &ThemeColors::emitter : &ThemeColors::data);
            for (const Entry& entry : quantity.entries)
                if (paths.subpath(entry.vertex) == subpath) put(entry.numbers[0], entry.numbers[1], entry.vertex);
            continue;
        }
        const auto channels = channelsOf(quantity.kind);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const bool light = subpath == Subpath::light && channels.size() == 1;
            add(of + QLatin1String(channels[c].name), light ? &ThemeColors::emitter : channels[c].color);
            for (const Entry& entry : quantity.entries)
                if (paths.subpath(entry.vertex) == subpath) put(double(paths.depthIndex(entry.vertex)), entry.numbers[c], entry.vertex);
        }
    }
    return series;
}

QString DataPanel::describe(const Shown& shown, PlotPoint point) const {
    const PathSet& paths = context_.dataset().paths();
    const Quantity& quantity = quantities_[shown.quantity];
    const Index vertex = shown.vertices[point.series][point.point];
    QString text = tr("depth %1").arg(paths.depthIndex(vertex));
    if (paths.subpath(vertex) == Subpath::light) text += tr(", from the light");
    return text + QLatin1Char('\n') + qt(quantity.name) + QStringLiteral("  ") + qt(quantity.valueAt(vertex));
}

void DataPanel::placePlots() {
    double width = 0;
    std::size_t lowest = shown_.size();
    for (std::size_t i = 0; i < shown_.size(); ++i) {
        width = std::max(width, shown_[i].plot->axisWidth());
        if (shown_[i].overDepth) lowest = i;
    }
    for (std::size_t i = 0; i < shown_.size(); ++i) {
        shown_[i].plot->setAxisWidth(width);
        // One scale for those below each other; what stands between has other axes.
        const bool below = i + 1 < shown_.size() && shown_[i + 1].overDepth;
        shown_[i].plot->setXLabelsShown(!shown_[i].overDepth || i == lowest || !below);
    }
}

void DataPanel::setLog(bool log) {
    log_ = log;
    logButton_->setChecked(log);
    for (const Shown& shown : shown_) shown.plot->setLog(log);
    placePlots();
    keepSettings();
}

// Linking ----------------------------------------------------------------------------------------

std::vector<PlotPoint> DataPanel::pointsOf(const Shown& shown, std::optional<Index> vertex) const {
    std::vector<PlotPoint> points;
    for (std::uint32_t s = 0; vertex && s < shown.vertices.size(); ++s)
        for (std::uint32_t p = 0; p < shown.vertices[s].size(); ++p)
            if (shown.vertices[s][p] == *vertex) points.push_back({s, p});
    return points;
}

void DataPanel::showVertex() {
    if (stale_) return;
    const auto vertex = vertexAt(context_.selection().state().vertex);
    for (const Shown& shown : shown_) shown.plot->setSelected(pointsOf(shown, vertex), std::nullopt);
    filling_ = true;
    list_->setHeaderLabels({tr("Quantity"), vertex ? tr("At depth %1").arg(context_.dataset().paths().depthIndex(*vertex)) : tr("At the vertex")});
    for (int row = 0; row < list_->topLevelItemCount() && row < int(quantities_.size()); ++row) {
        const Quantity& quantity = quantities_[static_cast<std::size_t>(row)];
        const QString text = vertex ? qt(quantity.valueAt(*vertex)) : QString();
        QTreeWidgetItem* item = list_->topLevelItem(row);
        item->setText(1, text);
        item->setToolTip(1, text);
        item->setIcon(1, vertex && quantity.kind == Kind::color && !text.isEmpty() ? swatch(quantity, *vertex) : QIcon());
        const bool odd = text.contains(QLatin1String("NaN")) || text.contains(QLatin1String("Infinity"));
        item->setForeground(1, odd ? context_.colors().warning : context_.colors().text);
    }
    filling_ = false;
}

void DataPanel::showHovered() {
    if (stale_) return;
    const auto vertex = vertexAt(context_.selection().hovered());
    for (const Shown& shown : shown_) {
        const auto points = pointsOf(shown, vertex);
        shown.plot->setHovered(points.empty() ? std::nullopt : std::optional(points.front()));
    }
}

QIcon DataPanel::swatch(const Quantity& quantity, Index vertex) const {
    const auto entry = std::find_if(quantity.entries.rbegin(), quantity.entries.rend(), [&](const Entry& e) { return e.vertex == vertex; });
    if (entry == quantity.entries.rend()) return {};
    const Color value{float(entry->numbers[0]), float(entry->numbers[1]), float(entry->numbers[2])};
    const analysis::Color8 shown = analysis::ToneMapper(context_.toneMap()).color(value);
    QPixmap picture(list_->iconSize());
    picture.fill(QColor(shown.r, shown.g, shown.b));
    QPainter painter(&picture);
    painter.setPen(context_.colors().border);
    painter.drawRect(picture.rect().adjusted(0, 0, -1, -1));
    return QIcon(picture);
}

void DataPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) {
        reload();
        showHovered();
    }
}

void DataPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    placePlots();
}

}  // namespace emca::intersection_data
