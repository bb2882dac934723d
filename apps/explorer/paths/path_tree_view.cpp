#include "paths/path_tree_view.h"

#include <QHeaderView>
#include <QPainter>
#include <QScrollBar>
#include <algorithm>
#include <utility>

#include "base/path_ids.h"
#include "base/theme.h"
#include "paths/path_tree_model.h"
#include "paths/value_cells.h"

namespace emca::explorer {

using Kind = PathTreeModel::Node::Kind;

PathTreeView::PathTreeView(PathTreeModel& model, Theme& theme, QWidget* parent)
    : QTreeView(parent), model_(model), theme_(theme) {
    setModel(&model);
    setUniformRowHeights(true);  // else every row is measured
    setAllColumnsShowFocus(true);
    setSelectionMode(ExtendedSelection);
    setSelectionBehavior(SelectRows);
    setHorizontalScrollMode(ScrollPerPixel);
    setContextMenuPolicy(Qt::CustomContextMenu);
    setIndentation(14);
    setAnimated(false);
    setExpandsOnDoubleClick(true);
    setFrameShape(NoFrame);
    header()->setStretchLastSection(false);
    header()->setSectionResizeMode(PathTreeModel::kItem, QHeaderView::Stretch);
    header()->setSectionResizeMode(PathTreeModel::kValue, QHeaderView::Interactive);
    header()->setSectionResizeMode(PathTreeModel::kSwatch, QHeaderView::Fixed);
    header()->setMinimumSectionSize(40);
    header()->resizeSection(PathTreeModel::kValue, 3 * numberCellWidth(theme.numberFont()) + 68);
    header()->resizeSection(PathTreeModel::kSwatch, 54);
    const auto restyle = [this] {
        // The style fills the branches of selected rows with the highlight.
        QPalette colors = palette();
        colors.setColor(QPalette::Highlight, theme_.colors().selectedRow);
        setPalette(colors);
    };
    restyle();
    connect(&theme, &Theme::themeChanged, this, restyle);
}

PathTreeView::Arrangement PathTreeView::arrangement() const {
    Arrangement result;
    const PathSet& paths = model_.paths();
    for (const Index path : model_.shown()) {
        const QModelIndex row = model_.pathIndex(path);
        if (!isExpanded(row)) continue;
        Arrangement::Expanded expanded{pathId(paths, path), {}};
        for (const bool dataGroup : {false, true}) {
            const QModelIndex group = model_.groupIndex(path, dataGroup);
            if (group.isValid() && isExpanded(group))
                expanded.children.push_back({false, dataGroup, 0, Subpath::camera});
        }
        const IndexRange vertices = paths.vertices(path);
        for (Index v = vertices.first; v < vertices.last; ++v)
            if (isExpanded(model_.vertexIndex(v)))
                expanded.children.push_back({true, false, paths.depthIndex(v), paths.subpath(v)});
        result.expanded.push_back(std::move(expanded));
    }
    if (const QModelIndex top = indexAt(QPoint(2, 2)); top.isValid()) {
        result.topPath = pathId(paths, model_.pathOf(top));
        if (const std::optional<Index> vertex = model_.vertexOf(top)) result.topVertex = vertexId(paths, *vertex);
    }
    result.horizontal = horizontalScrollBar()->value();
    return result;
}

void PathTreeView::restore(const Arrangement& arrangement) {
    // Right after a reset the layout is still pending, so that each expansion is one entry in a set.
    const PathSet& paths = model_.paths();
    for (const Arrangement::Expanded& expanded : arrangement.expanded) {
        const std::optional<Index> path = findPath(paths, expanded.path);
        const QModelIndex row = path ? model_.pathIndex(*path) : QModelIndex();
        if (!row.isValid()) continue;
        setExpanded(row, true);
        for (const Arrangement::Child& child : expanded.children) {
            if (!child.vertex) {
                setExpanded(model_.groupIndex(*path, child.dataGroup), true);
            } else if (const auto vertex = paths.findVertex(*path, child.depth, child.subpath)) {
                setExpanded(model_.vertexIndex(*vertex), true);
            }
        }
    }
    QModelIndex top;
    if (arrangement.topVertex)
        if (const auto vertex = findVertex(paths, *arrangement.topVertex)) top = model_.vertexIndex(*vertex);
    if (!top.isValid() && arrangement.topPath)
        if (const auto path = findPath(paths, *arrangement.topPath)) top = model_.pathIndex(*path);
    if (top.isValid() && (!arrangement.topVertex || isExpanded(top.parent()) || !top.parent().isValid()))
        scrollTo(top, PositionAtTop);
    horizontalScrollBar()->setValue(arrangement.horizontal);
}

void PathTreeView::expandPaths() {
    // Each expansion with a finished layout would insert rows; with a pending one it is an entry in a set.
    scheduleDelayedItemsLayout();
    for (const Index path : model_.shown()) setExpanded(model_.pathIndex(path), true);
    executeDelayedItemsLayout();
}

void PathTreeView::expandWhole(const QModelIndex& path) {
    scheduleDelayedItemsLayout();
    setExpanded(path, true);
    for (int row = 0; row < model_.rowCount(path); ++row) setExpanded(model_.index(row, 0, path), true);
    executeDelayedItemsLayout();
}

QItemSelection PathTreeView::rowsOf(const std::vector<Index>& paths) const {
    std::vector<int> rows;
    rows.reserve(paths.size());
    for (const Index path : paths)
        if (const QModelIndex index = model_.pathIndex(path); index.isValid()) rows.push_back(index.row());
    std::sort(rows.begin(), rows.end());
    QItemSelection selection;
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last + 1 < rows.size() && rows[last + 1] == rows[last] + 1) ++last;
        selection.append(QItemSelectionRange(model_.index(rows[first], 0),
                                             model_.index(rows[last], PathTreeModel::kColumnCount - 1)));
        first = last + 1;
    }
    return selection;
}

void PathTreeView::drawRow(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    QTreeView::drawRow(painter, option, index);
    if (!selectionModel()->isSelected(index)) return;
    // Selected paths and vertices are orange in every view.
    painter->fillRect(QRect(option.rect.left(), option.rect.top() + 2, 3, option.rect.height() - 4),
                      theme_.colors().selected);
}

template <typename Handler>
void PathTreeView::inOne(Handler handler) {
    ++handling_;
    handler();
    if (--handling_ == 0 && std::exchange(changed_, false)) emit rowsChosen();
}

void PathTreeView::chosen() {
    if (handling_ > 0) {
        changed_ = true;
    } else {
        emit rowsChosen();
    }
}

void PathTreeView::mousePressEvent(QMouseEvent* event) {
    inOne([&] { QTreeView::mousePressEvent(event); });
}
void PathTreeView::mouseMoveEvent(QMouseEvent* event) {
    inOne([&] { QTreeView::mouseMoveEvent(event); });
}
void PathTreeView::mouseReleaseEvent(QMouseEvent* event) {
    inOne([&] { QTreeView::mouseReleaseEvent(event); });
}
void PathTreeView::keyPressEvent(QKeyEvent* event) {
    inOne([&] { QTreeView::keyPressEvent(event); });
}

void PathTreeView::selectionChanged(const QItemSelection& selected, const QItemSelection& deselected) {
    QTreeView::selectionChanged(selected, deselected);
    chosen();
}

void PathTreeView::currentChanged(const QModelIndex& current, const QModelIndex& previous) {
    QTreeView::currentChanged(current, previous);
    chosen();
}

}  // namespace emca::explorer
