#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <vector>

class QMainWindow;

namespace emca::explorer {

class PanelDock;

/// Where docks are: columns of rows of cells, each cell a group of tabs whose first one is in front. Shares need not add
/// up to 1. Docks that do not exist are left out, as are cells, rows and columns without any.
struct LayoutPlan {
    struct Cell {
        QStringList docks;
        double width = 1;       ///< share of the row
        bool rest = false;      ///< docks that the plan does not name join here
    };
    struct Row {
        std::vector<Cell> cells;
        double height = 1;      ///< share of the column
    };
    struct Column {
        std::vector<Row> rows;
        double width = 1;       ///< share of the window
    };
    QString name, title, meaning;   ///< of the saved state; for people; what it is for
    std::vector<Column> columns;
    bool showsRest = false;         ///< else docks that are not named are hidden
};

/// Default, Firefly hunt, Compare, Teaching.
const std::vector<LayoutPlan>& layoutPlans();

/// Moves every dock to its place. Those of no plan wait hidden where they will appear, unless the plan shows them.
void arrange(QMainWindow& window, const std::vector<PanelDock*>& docks, const LayoutPlan& plan);

/// Into the group of tabs in which tools are: for docks that came after a layout was saved.
void placeWithTools(QMainWindow& window, const std::vector<PanelDock*>& docks, PanelDock& dock);

}  // namespace emca::explorer
