#include "window/layout_plan.h"

#include <QCoreApplication>
#include <QMainWindow>
#include <QVariant>
#include <algorithm>

#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("emca::explorer::LayoutPlan", text); }

const QStringList kPlots{"plots-rgb", "plots-luminance", "plots-depth", "plots-parallel"};
// Few enough for a narrow edge to show all of their tabs. What was done stands with the paths, what belongs to the selected
// vertex with its values.
const QStringList kTools{"outliers", "filter", "region", "surfaces", "sceneOptions"};
const QStringList kPaths{"paths", "history", "notes"};
const QStringList kVertex{"vertex", "plugin-intersection-data", "plugin-light-probe", "plugin-spherical-mixture"};

using Cell = LayoutPlan::Cell;
using Row = LayoutPlan::Row;
using Column = LayoutPlan::Column;

Row row(double height, std::vector<Cell> cells) { return {std::move(cells), height}; }
Column column(double width, std::vector<Row> rows) { return {std::move(rows), width}; }
Cell cell(QStringList docks, double width = 1) { return {std::move(docks), width, false}; }
Cell withRest(QStringList docks, double width = 1) { return {std::move(docks), width, true}; }

LayoutPlan standard() {
    LayoutPlan plan{"default", tr("Default"), tr("Image and plots at the left, scene and values at the right, tools at the edge"), {}, true};
    plan.columns = {column(0.4, {row(0.56, {cell({"image"})}), row(0.44, {cell(kPlots)})}),
                    column(0.6, {row(0.58, {cell({"scene"}, 0.68), withRest(kTools, 0.32)}), row(0.42, {cell(kPaths, 0.54), cell(kVertex, 0.46)})})};
    return plan;
}

/// From the pixel that is too bright to the vertex that made it: what stands out, beside its plot, path and values.
LayoutPlan fireflyHunt() {
    LayoutPlan plan{"firefly", tr("Firefly hunt"), tr("Outliers and luminance beside the image; the path, its vertices and values large"), {}, false};
    plan.columns = {column(0.3, {row(0.5, {cell({"image"})}), row(0.5, {cell({"plots-luminance", "plots-rgb", "plots-depth", "plots-parallel"})})}),
                    column(0.42, {row(0.5, {cell({"scene"})}), row(0.5, {cell({"paths"})})}),
                    column(0.28, {row(0.5, {withRest({"outliers", "filter", "history", "notes"})}), row(0.5, {cell(kVertex)})})};
    return plan;
}

/// Two images or two pixels: the image takes half of the window, the history is at hand.
LayoutPlan compare() {
    LayoutPlan plan{"compare", tr("Compare"), tr("The image large, the pixels of before at hand, plots and scene for both of them"), {}, false};
    plan.columns = {column(0.52, {row(1, {cell({"image"})})}),
                    column(0.48, {row(0.5, {withRest({"history", "filter", "outliers"}, 0.4), cell({"scene"}, 0.6)}),
                                  row(0.5, {cell({"plots-luminance", "plots-rgb", "plots-depth", "plots-parallel"})})})};
    return plan;
}

/// For a projector: few things, large, and the words that belong to them.
LayoutPlan teaching() {
    LayoutPlan plan{"teaching", tr("Teaching"), tr("A large scene, the image, the values of a vertex, and notes"), {}, false};
    plan.columns = {column(0.32, {row(0.42, {cell({"image"})}), row(0.36, {cell({"vertex", "plugin-intersection-data", "paths"})}), row(0.22, {withRest({"notes", "history"})})}),
                    column(0.68, {row(1, {cell({"scene"})})})};
    return plan;
}

using Group = std::vector<PanelDock*>;

struct Placed {
    std::vector<std::pair<Group, double>> cells;
    double height = 1;
    PanelDock* first() const { return cells.front().first.front(); }
};
struct PlacedColumn {
    std::vector<Placed> rows;
    double width = 1;
    PanelDock* first() const { return rows.front().first(); }
};

PanelDock* find(const Group& docks, const QString& name) {
    const auto found = std::ranges::find_if(docks, [&](PanelDock* dock) { return dock->objectName() == name; });
    return found == docks.end() ? nullptr : *found;
}

/// The plan with the docks that there are. \param unnamed  those that join the cell of the rest
std::vector<PlacedColumn> resolved(const Group& docks, const LayoutPlan& plan, const Group& unnamed) {
    std::vector<PlacedColumn> columns;
    for (const LayoutPlan::Column& column : plan.columns) {
        PlacedColumn placedColumn{{}, column.width};
        for (const LayoutPlan::Row& row : column.rows) {
            Placed placed{{}, row.height};
            for (const LayoutPlan::Cell& cell : row.cells) {
                Group group;
                for (const QString& name : cell.docks)
                    if (PanelDock* dock = find(docks, name)) group.push_back(dock);
                if (cell.rest) group.insert(group.end(), unnamed.begin(), unnamed.end());
                if (!group.empty()) placed.cells.emplace_back(std::move(group), cell.width);
            }
            if (!placed.cells.empty()) placedColumn.rows.push_back(std::move(placed));
        }
        if (!placedColumn.rows.empty()) columns.push_back(std::move(placedColumn));
    }
    return columns;
}

Group notNamed(const Group& docks, const LayoutPlan& plan) {
    QStringList named;
    for (const auto& column : plan.columns)
        for (const auto& row : column.rows)
            for (const auto& cell : row.cells) named += cell.docks;
    Group rest;
    for (PanelDock* dock : docks)
        if (!named.contains(dock->objectName())) rest.push_back(dock);
    return rest;
}

/// Splits go from the outside in, so that columns hold rows and rows hold cells.
void split(QMainWindow& window, const std::vector<PlacedColumn>& columns) {
    window.addDockWidget(Qt::LeftDockWidgetArea, columns.front().first());
    for (std::size_t c = 1; c < columns.size(); ++c) window.splitDockWidget(columns[c - 1].first(), columns[c].first(), Qt::Horizontal);
    for (const PlacedColumn& column : columns) {
        for (std::size_t r = 1; r < column.rows.size(); ++r) window.splitDockWidget(column.rows[r - 1].first(), column.rows[r].first(), Qt::Vertical);
        for (const Placed& row : column.rows) {
            for (std::size_t k = 1; k < row.cells.size(); ++k)
                window.splitDockWidget(row.cells[k - 1].first.front(), row.cells[k].first.front(), Qt::Horizontal);
            for (const auto& [group, share] : row.cells)
                for (std::size_t t = 1; t < group.size(); ++t) window.tabifyDockWidget(group[t - 1], group[t]);
        }
    }
}

void resize(QMainWindow& window, const std::vector<PlacedColumn>& columns) {
    double all = 0;
    for (const PlacedColumn& column : columns) all += column.width;
    const double width = window.width(), height = window.height() - 120;   // menus, tools and status
    const auto widths = [&](const Placed& row, double room, QList<QDockWidget*>& docks, QList<int>& sizes) {
        double shares = 0;
        for (const auto& [group, share] : row.cells) shares += share;
        for (const auto& [group, share] : row.cells) {
            docks << group.front();
            sizes << static_cast<int>(room * share / shares);
        }
    };
    QList<QDockWidget*> docks;
    QList<int> sizes;
    for (const PlacedColumn& column : columns) widths(column.rows.front(), width * column.width / all, docks, sizes);
    window.resizeDocks(docks, sizes, Qt::Horizontal);
    for (const PlacedColumn& column : columns) {
        for (std::size_t r = 1; r < column.rows.size(); ++r) {
            docks.clear();
            sizes.clear();
            widths(column.rows[r], width * column.width / all, docks, sizes);
            if (docks.size() > 1) window.resizeDocks(docks, sizes, Qt::Horizontal);
        }
        double shares = 0;
        for (const Placed& row : column.rows) shares += row.height;
        docks.clear();
        sizes.clear();
        for (const Placed& row : column.rows) {
            docks << row.first();
            sizes << static_cast<int>(height * row.height / shares);
        }
        if (docks.size() > 1) window.resizeDocks(docks, sizes, Qt::Vertical);
    }
}

}  // namespace

const std::vector<LayoutPlan>& layoutPlans() {
    static const std::vector<LayoutPlan> plans{standard(), fireflyHunt(), compare(), teaching()};
    return plans;
}

void arrange(QMainWindow& window, const Group& docks, const LayoutPlan& plan) {
    const Group unnamed = notNamed(docks, plan);
    const auto columns = resolved(docks, plan, unnamed);
    if (columns.empty()) return;
    for (PanelDock* dock : docks) {
        window.removeDockWidget(dock);
        dock->setFloating(false);
    }
    split(window, columns);
    for (PanelDock* dock : docks) dock->setVisible(plan.showsRest || std::ranges::find(unnamed, dock) == unnamed.end());
    for (PanelDock* dock : docks)
        if (dock->property("hiddenAtFirst").toBool()) dock->hide();
    resize(window, columns);
    for (const PlacedColumn& column : columns)
        for (const Placed& row : column.rows)
            for (const auto& [group, share] : row.cells) group.front()->raise();
}

void placeWithTools(QMainWindow& window, const Group& docks, PanelDock& dock) {
    dock.setFloating(false);
    for (const QString& tool : kTools) {
        PanelDock* there = find(docks, tool);
        if (!there || there == &dock || there->isFloating() || !there->isVisibleTo(&window)) continue;
        window.tabifyDockWidget(there, &dock);
        return;
    }
    window.addDockWidget(Qt::RightDockWidgetArea, &dock);
}

}  // namespace emca::explorer
