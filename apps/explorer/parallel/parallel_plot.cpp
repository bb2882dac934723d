#include "parallel/parallel_plot.h"

#include <QApplication>
#include <QClipboard>
#include <QCompleter>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "base/bar_button.h"
#include "base/grouped.h"
#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/text_line.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "parallel/parallel_canvas.h"
#include "paths/completing_field.h"

namespace emca::explorer {

using client::PathId;
using client::SelectionPart;

ParallelPlot::ParallelPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme), canvas_(new ParallelCanvas(axes_, theme)), add_(new CompletingField),
      filter_(barButton(tr("To filter"), tr("Makes rules of the filter out of what is marked"))),
      clear_(barButton(tr("Clear marks"), tr("Forgets what is marked on the axes, and selects nothing (Esc)"))),
      usual_(barButton(tr("Usual axes"), tr("Brings back the axes that this view began with"))),
      summary_(new TextLine(theme, Qt::AlignRight, true)), overlay_(new StateOverlay(theme, canvas_)),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if (parts & client::DatasetPart::currentTrace) reload();
      }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (SelectionPart::paths | SelectionPart::currentPath)) select();
          if (parts & SelectionPart::hover) hover();
      }) {
    build();
    connectCanvas();
    axes_.setWishes(ParallelAxes::defaults());
    reload();
}

ParallelPlot::~ParallelPlot() = default;

void ParallelPlot::build() {
    add_->setPlaceholderText(tr("+ axis: a quantity"));
    add_->setToolTip(tr("Adds an axis: a quantity of paths, or an expression such as max(v.roughness). Enter adds it."));
    add_->setClearButtonEnabled(false);
    add_->setFixedWidth(220);
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::medium, Spacing::tiny);
    bar->setSpacing(Spacing::tiny);
    bar->addWidget(add_);
    bar->addWidget(usual_);
    bar->addWidget(filter_);
    bar->addWidget(clear_);
    bar->addWidget(summary_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(canvas_, 1);
    suggest();
    connect(add_, &QLineEdit::returnPressed, this, &ParallelPlot::addTyped);
    // A choice out of the list is meant as it is.
    if (auto* completer = add_->findChild<QCompleter*>())
        connect(completer, qOverload<const QString&>(&QCompleter::activated), this, &ParallelPlot::addTyped, Qt::QueuedConnection);
    connect(add_, &QLineEdit::textEdited, this, [this] {
        problem_.clear();
        updateState();
    });
    connect(usual_, &QToolButton::clicked, this, [this] { setAxes(ParallelAxes::defaults()); });
    connect(filter_, &QToolButton::clicked, this, [this] { filterByBrushes(); });
    connect(clear_, &QToolButton::clicked, this, &ParallelPlot::clearBrushes);
}

void ParallelPlot::connectCanvas() {
    canvas_->setDescription([this](Index path) { return describe(path); });
    connect(canvas_, &ParallelCanvas::brushed, this, [this](bool finished) {
        if (finished) takeBrushes();
        updateState();
    });
    connect(canvas_, &ParallelCanvas::clicked, this, [this](Index path, Qt::KeyboardModifiers modifiers) {
        const PathId id = pathId(axes_.paths(), path);
        if (modifiers & (Qt::ShiftModifier | Qt::ControlModifier)) selection_.togglePath(id);
        else selection_.setPaths({id});
    });
    connect(canvas_, &ParallelCanvas::hovered, this, [this](std::optional<Index> path) {
        if (!path) return selection_.setHovered(std::nullopt);
        // Depth 0 is the camera: the path as a whole.
        selection_.setHovered(client::VertexId{pathId(axes_.paths(), *path), 0, Subpath::camera});
    });
    connect(canvas_, &ParallelCanvas::axesChanged, this, [this] {
        updateState();
        emit layoutChanged();
    });
    connect(canvas_, &ParallelCanvas::clearRequested, this, &ParallelPlot::clearBrushes);
    connect(canvas_, &ParallelCanvas::menuRequested, this, &ParallelPlot::showMenu);
    connect(canvas_, &ParallelCanvas::addRequested, this, [this] { add_->setFocus(Qt::ShortcutFocusReason); });
}

QString ParallelPlot::layoutText() const { return toText(axes_.wishes()); }

void ParallelPlot::setLayoutText(const QString& text) {
    const std::vector<AxisWish> wishes = wishesFrom(text);
    setAxes(wishes.empty() ? ParallelAxes::defaults() : wishes);
}

void ParallelPlot::setAxes(const std::vector<AxisWish>& wishes) {
    const bool marked = axes_.hasBrushes();
    axes_.setWishes(wishes);
    if (marked) selection_.clearPaths();
    taken_.reset();
    canvas_->reload();
    updateState();
    emit layoutChanged();
}

Result<void> ParallelPlot::addAxis(const AxisWish& wish) {
    if (stale_ && isVisible()) reload();
    const Result<void> added = axes_.add(wish);
    if (!added) return added;
    canvas_->reload();
    canvas_->setCurrentAxis(axes_.size() - 1);
    updateState();
    emit layoutChanged();
    return {};
}

void ParallelPlot::addTyped() {
    const QString text = add_->text().trimmed();
    if (text.isEmpty()) return;
    const Result<void> added = addAxis({text});
    problem_ = added ? QString() : toQString(added.error().message);
    if (added) add_->clear();
    updateState();
}

void ParallelPlot::suggest() {
    add_->setChoicesLater([this] {
        std::vector<CompletingField::Choice> choices;
        for (AxisSuggestion& suggestion : axisSuggestions(dataset_.paths()))
            choices.push_back({std::move(suggestion.expression), std::move(suggestion.meaning)});
        return choices;
    });
}

void ParallelPlot::reload() {
    stale_ = !isVisible();
    if (stale_) return;
    taken_.reset();
    axes_.setPaths(dataset_.paths());
    suggest();
    canvas_->reload();
    select();
}

void ParallelPlot::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) reload();
}

void ParallelPlot::select() {
    if (stale_) return;
    const client::Selection::State& state = selection_.state();
    if (taken_ && state.paths != *taken_) {
        // Another view selected something else: the marks no longer say what is selected.
        taken_.reset();
        axes_.clearBrushes();
        canvas_->update();
    }
    canvas_->setSelected(findPaths(axes_.paths(), state.paths), state.currentPath ? findPath(axes_.paths(), *state.currentPath) : std::nullopt);
    updateState();
}

void ParallelPlot::hover() {
    if (stale_) return;
    const std::optional<client::VertexId>& hovered = selection_.hovered();
    canvas_->setHovered(hovered ? findPath(axes_.paths(), hovered->path) : std::nullopt);
}

void ParallelPlot::takeBrushes() {
    if (!axes_.hasBrushes()) {
        taken_.reset();
        selection_.clearPaths();
        return select();
    }
    std::vector<PathId> ids = pathIds(axes_.paths(), axes_.brushed());
    taken_ = ids;
    selection_.setPaths(std::move(ids));
    select();
}

void ParallelPlot::clearBrushes() {
    axes_.clearBrushes();
    taken_.reset();
    selection_.clearPaths();
    canvas_->update();
    updateState();
}

void ParallelPlot::filterByBrushes(std::size_t axis) {
    const QString query = axes_.condition(axis);
    if (query.isEmpty()) return;
    const auto rules = axes_.rules(axis);
    emit filterWanted(rules ? *rules : std::vector<query::Rule>{}, query);
}

void ParallelPlot::toggleLog() {
    if (const auto axis = canvas_->currentAxis()) return canvas_->toggleLog(*axis);
    for (std::size_t i = 0; i < axes_.size(); ++i)
        if (axes_[i].unit.startsWith(QLatin1String("W"))) canvas_->toggleLog(i);
}

QString ParallelPlot::summaryText() const {
    if (!problem_.isEmpty()) return problem_;
    const PathSet& paths = axes_.paths();
    if (paths.empty()) return {};
    QString text = tr("%1 %2").arg(grouped(paths.pathCount()), paths.pathCount() == 1 ? tr("path") : tr("paths"));
    if (axes_.hasBrushes()) return text + tr(", %1 marked").arg(grouped(axes_.brushed().size()));
    const std::size_t selected = findPaths(paths, selection_.state().paths).size();
    return selected > 0 ? text + tr(", %1 selected").arg(grouped(selected)) : text;
}

void ParallelPlot::updateState() {
    summary_->setText(summaryText());
    summary_->setToolTip(problem_);
    filter_->setEnabled(axes_.hasBrushes());
    clear_->setEnabled(axes_.hasBrushes());
    usual_->setEnabled(axes_.wishes() != ParallelAxes::defaults());
    if (dataset_.paths().empty()) {
        const bool traced = !dataset_.current().empty();
        overlay_->showEmpty(traced ? tr("No paths") : tr("Paths of a pixel"),
                            traced ? tr("The renderer recorded no path for this pixel") : tr("Click a pixel in the image"));
    } else if (axes_.size() == 0) {
        overlay_->showEmpty(tr("No axes"), tr("Add a quantity above, such as luminance or max(v.depth)"), tr("Usual axes"),
                            [this] { setAxes(ParallelAxes::defaults()); });
    } else {
        overlay_->clear();
    }
}

QString ParallelPlot::describe(Index path) const {
    const PathSet& paths = axes_.paths();
    QString text = tr("sample %1").arg(toQString(analysis::formatInteger(paths.sample(path))));
    if (paths.part(path) != 0) text += tr(", part %1").arg(paths.part(path));
    if (severalPixels(paths)) text += QLatin1Char(' ') + toQString(analysis::formatPixel(paths.pixel(path)));
    for (const ParallelAxis& axis : axes_.all()) {
        if (axis.wish.expression == QLatin1String("sample")) continue;
        text += QStringLiteral("\n%1  %2").arg(axis.wish.expression, axis.valueText(path));
        if (!axis.unit.isEmpty() && axis.values.known[path]) text += ' ' + axis.unit;
    }
    return text;
}

void ParallelPlot::addAxisActions(QMenu& menu, std::size_t i) {
    const ParallelAxis& axis = axes_[i];
    menu.addSection(axis.wish.expression);
    menu.addAction(tr("Filter by this range"), this, [this, i] { filterByBrushes(i); })->setEnabled(!axis.brushes.empty());
    menu.addAction(tr("Clear its marks"), this, [this, i] {
        axes_.setBrushes(i, {});
        canvas_->update();
        takeBrushes();
    })->setEnabled(!axis.brushes.empty());
    menu.addSeparator();
    QAction* log = menu.addAction(tr("Logarithmic"), this, [this, i] { canvas_->toggleLog(i); }, QKeySequence("L"));
    log->setCheckable(true);
    log->setChecked(axis.isLog());
    log->setEnabled(!axis.isText());
    QAction* flip = menu.addAction(tr("Upside down"), this, [this, i] { canvas_->toggleFlipped(i); }, QKeySequence("I"));
    flip->setCheckable(true);
    flip->setChecked(axis.wish.flipped);
    menu.addAction(tr("Move to the left"), this, [this, i] { canvas_->moveAxis(i, i - 1); }, QKeySequence("Shift+Left"))->setEnabled(i > 0);
    menu.addAction(tr("Move to the right"), this, [this, i] { canvas_->moveAxis(i, i + 1); }, QKeySequence("Shift+Right"))->setEnabled(i + 1 < axes_.size());
    menu.addAction(tr("Remove axis"), this, [this, i] { canvas_->removeAxis(i); }, QKeySequence::Delete);
    menu.addSeparator();
}

void ParallelPlot::showMenu(const QPoint& position, std::optional<std::size_t> axis, std::optional<Index> path) {
    QMenu menu(this);
    if (axis) addAxisActions(menu, *axis);
    if (path) {
        const PathId id = pathId(axes_.paths(), *path);
        const QString values = describe(*path);
        menu.addAction(tr("Select only this path"), this, [this, id] { selection_.setPaths({id}); });
        menu.addAction(tr("Copy its values"), this, [values] { QApplication::clipboard()->setText(values); });
        menu.addSeparator();
    }
    if (!axis) {
        menu.addAction(tr("Filter by what is marked"), this, [this] { filterByBrushes(); })->setEnabled(axes_.hasBrushes());
        menu.addAction(tr("Clear marks"), this, &ParallelPlot::clearBrushes, QKeySequence("Esc"))->setEnabled(axes_.hasBrushes());
        menu.addAction(tr("Usual axes"), this, [this] { setAxes(ParallelAxes::defaults()); });
        menu.addSeparator();
    }
    addExportActions(menu, exporting());
    menu.exec(position);
}

PlotExport ParallelPlot::exporting() {
    return {this, canvas_, QStringLiteral("parallel-coordinates"), [this](bool on) { canvas_->setExporting(on); },
            [this] { return csv(); }, [this](const QString& sentence) { emit message(sentence); }};
}

Result<void> ParallelPlot::exportTo(const QString& file, int scale) { return writeExport(exporting(), file, scale); }

bool ParallelPlot::event(QEvent* event) { return claimExportKeys(*event) || QWidget::event(event); }

void ParallelPlot::keyPressEvent(QKeyEvent* event) {
    if (handleExportKeys(*event, exporting())) event->accept();
    else QWidget::keyPressEvent(event);
}

}  // namespace emca::explorer
