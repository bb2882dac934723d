#include "paths/path_tree.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QScopedValueRollback>
#include <QToolButton>
#include <algorithm>

#include "base/grouped.h"
#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/table_text.h"
#include "base/theme.h"
#include "base/view_keys.h"
#include "paths/path_tree_delegate.h"
#include "paths/path_tree_model.h"
#include "paths/path_tree_view.h"
#include "paths/value_rules.h"

namespace emca::explorer {

using client::PathId;
using client::SelectionPart;

namespace {

struct Ordering {
    const char* text;
    PathOrder order;
    bool descending;
};
constexpr Ordering kOrderings[] = {
    {"Sample ↑", PathOrder::sample, false},      {"Sample ↓", PathOrder::sample, true},
    {"Luminance ↓", PathOrder::luminance, true}, {"Luminance ↑", PathOrder::luminance, false},
    {"Depth ↓", PathOrder::depth, true},         {"Depth ↑", PathOrder::depth, false},
};

QToolButton* textButton(const QString& text, const QString& tip, bool checkable) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(checkable);
    button->setFocusPolicy(Qt::NoFocus);
    return button;
}

}  // namespace

PathTree::PathTree(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent),
      dataset_(dataset),
      selection_(selection),
      theme_(theme),
      model_(new PathTreeModel(this)),
      delegate_(new PathTreeDelegate(theme, this)),
      view_(new PathTreeView(*model_, theme, this)),
      overlay_(new StateOverlay(theme, view_)),
      count_(new QLabel),
      all_(textButton(tr("All"), tr("Show all paths"), true)),
      selected_(textButton(tr("Selected"), tr("Show only the selected paths"), true)),
      order_(new QComboBox),
      find_(new QLineEdit),
      datasetListening_(dataset,
                        [this](std::uint32_t parts) {
                            if (parts & client::DatasetPart::meshes) {
                                model_->setMeshes(dataset_.meshes());
                                view_->viewport()->update();
                            }
                            if (parts & client::DatasetPart::currentTrace) reload();
                        }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (SelectionPart::paths | SelectionPart::currentPath | SelectionPart::vertex)) follow();
      }) {
    view_->setItemDelegate(delegate_);
    model_->setMeshes(dataset_.meshes());
    buildHeader();
    connect(view_, &PathTreeView::rowsChosen, this, &PathTree::adopt);
    connect(view_, &QWidget::customContextMenuRequested, this, &PathTree::showMenu);
    const auto repaint = [this] { view_->viewport()->update(); };
    connect(&theme_, &Theme::themeChanged, this, repaint);
    connect(&theme_, &Theme::toneMapChanged, this, repaint);
    setFocusProxy(view_);
    setViewKeys(*view_, tr("Paths"), {{"Ctrl+C", tr("Copy the selected paths, or the vertex, as text")}, {"Ctrl+F", tr("Find keys")},
        {"Esc", tr("Show all keys again, or select nothing")}, {"Up", tr("Row above")}, {"Down", tr("Row below")}});
    reload();
}

void PathTree::buildHeader() {
    count_->setProperty("role", "muted");
    count_->setMinimumWidth(40);
    for (const Ordering& ordering : kOrderings) order_->addItem(QString::fromUtf8(ordering.text));
    order_->setToolTip(tr("Order of the paths"));
    order_->setFocusPolicy(Qt::ClickFocus);
    find_->setPlaceholderText(tr("Find keys"));
    find_->setToolTip(tr("Show only values whose name contains this, at every vertex"));
    find_->setClearButtonEnabled(true);
    find_->setMinimumWidth(80);
    find_->setMaximumWidth(116);
    auto* expand =
        textButton(QStringLiteral("▾"), tr("Expand: the selected paths whole, or all paths to their vertices"), false);
    auto* collapse = textButton(QStringLiteral("▸"), tr("Collapse all paths"), false);

    for (QToolButton* button : {expand, collapse}) button->setFixedWidth(Spacing::control);

    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::small, Spacing::tiny);
    bar->setSpacing(Spacing::tiny);
    bar->addWidget(all_);
    bar->addWidget(selected_);
    bar->addWidget(count_, 1);
    bar->addWidget(expand);
    bar->addWidget(collapse);
    bar->addWidget(order_);
    bar->addWidget(find_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(view_, 1);

    connect(all_, &QToolButton::clicked, this, &PathTree::showAll);
    connect(selected_, &QToolButton::clicked, this, &PathTree::inspectSelected);
    connect(expand, &QToolButton::clicked, this, &PathTree::expand);
    connect(collapse, &QToolButton::clicked, this, &PathTree::collapse);
    connect(find_, &QLineEdit::textChanged, this, &PathTree::filterKeys);
    connect(order_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int i) {
        model_->setOrder(kOrderings[i].order, kOrderings[i].descending);
        reveal();
    });
}

std::optional<std::vector<Index>> PathTree::wanted() const {
    if (!inspecting_) return std::nullopt;
    return findPaths(dataset_.paths(), inspected_);
}

void PathTree::reload() {
    const PathTreeView::Arrangement before = view_->arrangement();
    {
        const QScopedValueRollback<bool> guard(selecting_, true);
        model_->setPaths(dataset_.paths(), wanted());
        view_->restore(before);
    }
    selectRows();
    updateState();
}

void PathTree::showAll() {
    inspecting_ = false;
    reload();
    reveal();
}

void PathTree::inspectSelected() {
    inspecting_ = true;
    inspected_ = selection_.state().paths;
    reload();
    reveal();
}

void PathTree::updateState() {
    all_->setChecked(!inspecting_);
    selected_->setChecked(inspecting_);
    count_->setText(countText());
    if (dataset_.paths().empty()) {
        const bool traced = !dataset_.current().empty();
        overlay_->showEmpty(
            traced ? tr("No paths") : tr("Paths of a pixel"),
            traced ? tr("The renderer recorded no path for this pixel") : tr("Click a pixel in the image"));
    } else if (model_->shown().empty()) {
        overlay_->showEmpty(tr("Nothing selected"), tr("Select paths in a plot or in the 3D view"),
                            tr("Show all paths"), [this] { showAll(); });
    } else {
        overlay_->clear();
    }
}

QString PathTree::countText() const {
    const std::size_t total = dataset_.paths().pathCount();
    const QString noun = total == 1 ? tr("path") : tr("paths");
    if (!inspecting_) return grouped(total) + QLatin1Char(' ') + noun;
    return tr("%1 of %2 %3").arg(grouped(model_->shown().size()), grouped(total), noun);
}

void PathTree::follow() {
    if (written_ && selection_.state() == *written_) return;  // our own change coming back
    written_.reset();
    const std::vector<PathId>& paths = selection_.state().paths;
    if (inspecting_ && !paths.empty() && paths != inspected_) {
        inspected_ = paths;
        reload();
    } else {
        selectRows();
    }
    reveal();
}

void PathTree::selectRows() {
    const QScopedValueRollback<bool> guard(selecting_, true);
    const client::Selection::State& state = selection_.state();
    const PathSet& paths = model_->paths();
    std::vector<Index> positions = findPaths(paths, state.paths);
    QModelIndex vertex, current;
    if (state.currentPath)
        if (const auto path = findPath(paths, *state.currentPath)) current = model_->pathIndex(*path);
    if (state.vertex)
        if (const auto position = findVertex(paths, *state.vertex)) vertex = model_->vertexIndex(*position);
    if (vertex.isValid()) std::erase(positions, model_->pathOf(vertex));  // its row stands for the path
    QItemSelection rows = view_->rowsOf(positions);
    if (vertex.isValid())
        rows.append(QItemSelectionRange(vertex, vertex.siblingAtColumn(PathTreeModel::kColumnCount - 1)));
    QItemSelectionModel* selected = view_->selectionModel();
    selected->reset();  // Qt compares old ranges with new ones pair by pair; from nothing it is linear
    if (vertex.isValid()) current = vertex;
    if (current.isValid()) selected->setCurrentIndex(current, QItemSelectionModel::NoUpdate);
    selected->select(rows, QItemSelectionModel::Select);
    view_->viewport()->update();
}

void PathTree::reveal() {
    const QModelIndex current = view_->currentIndex();
    if (current.isValid()) {
        view_->scrollTo(current);  // opens its parents
        return;
    }
    const QItemSelection rows = view_->selectionModel()->selection();
    if (!rows.isEmpty()) view_->scrollTo(rows.first().topLeft());
}

void PathTree::adopt() {
    if (selecting_) return;
    client::Selection::State state = selection_.state();
    const PathSet& paths = model_->paths();
    std::vector<Index> positions;
    const QItemSelection rows = view_->selectionModel()->selection();
    for (const QItemSelectionRange& range : rows)
        for (int row = range.top(); row <= range.bottom(); ++row)
            positions.push_back(model_->pathOf(model_->index(row, 0, range.parent())));
    std::sort(positions.begin(), positions.end());
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    state.paths = pathIds(paths, positions);
    state.vertex.reset();
    const QModelIndex current = view_->currentIndex();
    if (current.isValid() && view_->selectionModel()->isSelected(current)) {
        state.currentPath = pathId(paths, model_->pathOf(current));
        if (const auto vertex = model_->vertexOf(current)) state.vertex = vertexId(paths, *vertex);
    } else if (state.paths.size() == 1) {
        state.currentPath = state.paths.front();
    }
    if (state.currentPath && !std::binary_search(state.paths.begin(), state.paths.end(), *state.currentPath))
        state.currentPath.reset();
    written_ = state;
    selection_.set(std::move(state));
}

void PathTree::expand() {
    std::vector<Index> chosen = findPaths(model_->paths(), selection_.state().paths);
    // Whole paths have dozens of rows each: for a few. All of them open to their vertices.
    constexpr std::size_t kFew = 256;
    if (chosen.empty() || chosen.size() > kFew) {
        view_->expandPaths();
    } else {
        for (const Index path : chosen)
            if (const QModelIndex row = model_->pathIndex(path); row.isValid()) view_->expandWhole(row);
    }
    reveal();
}

void PathTree::collapse() { view_->collapseAll(); }

void PathTree::setKeyFilter(const QString& text) { find_->setText(text); }

void PathTree::filterKeys(const QString& text) {
    const QScopedValueRollback<bool> guard(selecting_, true);
    PathTreeView::Arrangement arrangement = view_->arrangement();
    if (!text.isEmpty() && arrangement.expanded.empty() && !model_->shown().empty()) {
        const auto& current = selection_.state().currentPath;
        const std::optional<Index> path = current ? findPath(model_->paths(), *current) : std::nullopt;
        const Index shown = path && model_->pathIndex(*path).isValid() ? *path : model_->shown().front();
        arrangement.expanded.push_back({pathId(model_->paths(), shown), {}});
    }
    delegate_->setHighlight(text);
    model_->setFilter(text);
    view_->restore(arrangement);
    if (!text.isEmpty())
        for (const auto& expanded : arrangement.expanded)
            if (const auto path = findPath(model_->paths(), expanded.path))
                if (const QModelIndex row = model_->pathIndex(*path); row.isValid()) view_->expandWhole(row);
    selectRows();
}

void PathTree::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) {
        if (!find_->text().isEmpty()) {
            find_->clear();
        } else {
            selection_.clearPaths();
        }
    } else if (event->matches(QKeySequence::Copy)) {
        copyAsText();
    } else if (event->matches(QKeySequence::Find)) {
        find_->setFocus();
        find_->selectAll();
    } else {
        QWidget::keyPressEvent(event);
        return;
    }
    event->accept();
}

void PathTree::showMenu(const QPoint& position) {
    const QModelIndex index = view_->indexAt(position);
    QMenu menu(this);
    if (index.isValid()) {
        const PathId id = pathId(model_->paths(), model_->pathOf(index));
        menu.addAction(tr("Select only this path"), this, [this, id] { selection_.setPaths({id}); });
        menu.addAction(tr("Show only this path"), this, [this, id] {
            selection_.setPaths({id});
            inspectSelected();
        });
        menu.addAction(tr("Expand whole path"), this, [this, id] {
            if (const auto path = findPath(model_->paths(), id)) view_->expandWhole(model_->pathIndex(*path));
        });
        menu.addSeparator();
        const std::optional<Entry> entry = model_->entryOf(index);
        const std::optional<Index> vertex = model_->vertexOf(index);
        addFilterMenu(menu, entry ? rulesFor(model_->paths(), *entry) : vertex ? rulesForVertex(model_->paths(), *vertex) : std::vector<ValueRule>(),
                      [this](const query::Rule& rule) { emit filterWanted(rule); });
        QAction* copy = menu.addAction(tr("Copy value"), this, [this, index] { copyValue(index); });
        copy->setEnabled(!index.data(PathTreeModel::kFullTextRole).toString().isEmpty());
        menu.addAction(tr("Copy as text"), this, &PathTree::copyAsText, QKeySequence::Copy);
        addTableExport(menu, *view_);
        menu.addSeparator();
    }
    menu.addAction(inspecting_ ? tr("Show all paths") : tr("Show selected paths"), this,
                   [this] { inspecting_ ? showAll() : inspectSelected(); });
    menu.exec(view_->viewport()->mapToGlobal(position));
}

void PathTree::copyValue(const QModelIndex& index) {
    QApplication::clipboard()->setText(index.data(PathTreeModel::kFullTextRole).toString());
}

void PathTree::copyAsText() {
    QString text;
    const client::Selection::State& state = selection_.state();
    const PathSet& paths = model_->paths();
    const std::optional<Index> vertex = state.vertex ? findVertex(paths, *state.vertex) : std::nullopt;
    if (vertex && state.paths.size() == 1) {
        text = vertexAsText(paths, *vertex, model_->meshes());
    } else {
        for (const Index path : findPaths(paths, state.paths)) text += pathAsText(paths, path, model_->meshes());
    }
    if (!text.isEmpty()) QApplication::clipboard()->setText(text);
}

}  // namespace emca::explorer
