// "Filter by this value", "Show only" and "Copy" on the thing under the cursor, wherever it is shown.
#include <gtest/gtest.h>

#include <QClipboard>
#include <QMenu>
#include <QTableView>
#include <QTimer>
#include <functional>

#include "base/path_ids.h"
#include "paths/filter_panel.h"
#include "paths/outlier_model.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/path_tree_model.h"
#include "paths/path_tree_view.h"
#include "paths/rule_row.h"
#include "paths/value_rules.h"
#include "paths/vertex_table.h"
#include "paths/vertex_table_model.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "testing/program.h"

namespace emca::explorer {
namespace {

class FilterMenuTest : public MainWindowTest {
  protected:
    void SetUp() override {
        program = std::make_unique<Program>(settingsFile());
        connectTo(*program);
        program->selection.setPixel(Pixel{7, 5});
        ASSERT_TRUE(waitFor([&] { return paths().pathCount() == 4 && program->window->isSettled(); }));
    }
    const PathSet& paths() const { return program->dataset.paths(); }
    FilterPanel& filter() { return *program->window->views().filter; }

    /// Opens a context menu and does something in it; the menu runs a loop of its own.
    void inMenu(const std::function<void()>& open, const std::function<void(QMenu&)>& act) {
        bool done = false;
        QTimer::singleShot(0, program->window.get(), [&] {
            EXPECT_TRUE(waitFor([] { return qobject_cast<QMenu*>(QApplication::activePopupWidget()) != nullptr; }));
            if (auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())) act(*menu);
            done = true;
            // Whatever is still open would run for ever.
            while (QWidget* popup = QApplication::activePopupWidget()) popup->close();
        });
        open();
        EXPECT_TRUE(waitFor([&] { return done; }));
        QApplication::setActiveWindow(program->window.get());
    }
    static QAction* find(QMenu& menu, const QString& begin) {
        for (QAction* action : menu.actions())
            if (action->text().startsWith(begin)) return action;
        return nullptr;
    }
    /// Chooses a condition of "Filter by this value".
    void filterBy(const std::function<void()>& open, const QString& begin) {
        inMenu(open, [&](QMenu& menu) {
            auto* below = menu.findChild<QMenu*>("filterByValue");
            ASSERT_TRUE(below) << "no filter in the menu";
            QAction* action = find(*below, begin);
            ASSERT_TRUE(action) << begin.toStdString() << ", but " << (below->actions().isEmpty() ? "" : below->actions().front()->text().toStdString());
            action->trigger();
        });
    }
    std::function<void()> menuAt(QAbstractItemView& view, const QModelIndex& index) {
        return [&view, index] {
            view.scrollTo(index);
            emit view.customContextMenuRequested(view.visualRect(index).center());
        };
    }
    std::unique_ptr<Program> program;
};

TEST_F(FilterMenuTest, ValuesOfTheTree) {
    PathTree& tree = *program->window->views().paths;
    tree.view().expandAll();
    // The luminance of the strong path, sample 2.
    const QModelIndex info = tree.model().groupIndex(2, false);
    QModelIndex luminance;
    for (int row = 0; row < tree.model().rowCount(info); ++row)
        if (const QModelIndex at = tree.model().index(row, 0, info); at.data().toString() == "luminance") luminance = at;
    ASSERT_TRUE(luminance.isValid());
    filterBy(menuAt(tree.view(), luminance), "luminance ≥");
    EXPECT_EQ(filter().rowCount(), 1u);
    EXPECT_EQ(filter().countText(), "1 of 4 paths") << filter().queryText().toStdString();
    EXPECT_FALSE(filter().visibleRegion().isEmpty()) << "the filter is in front";
    // What is computed from floats is found again by "=".
    filterBy(menuAt(tree.view(), luminance), "luminance =");
    EXPECT_EQ(filter().countText(), "1 of 4 paths") << filter().queryText().toStdString();
    EXPECT_EQ(filter().rowCount(), 2u);
    inMenu(menuAt(tree.view(), tree.model().pathIndex(1)), [&](QMenu& menu) {
        ASSERT_TRUE(find(menu, "Show only this path"));
        find(menu, "Show only this path")->trigger();
    });
    EXPECT_EQ(tree.model().rowCount(), 1);
}

TEST_F(FilterMenuTest, CellsOfTheVertexTable) {
    const Index vertex = paths().vertices(2).first + 1;
    program->selection.setVertex(vertexId(paths(), vertex));
    VertexTable& table = *program->window->views().vertex;
    QTableView& view = *table.findChild<QTableView*>();
    int row = -1;
    for (int r = 0; r < table.model().rowCount(); ++r)
        if (table.model().quantity(r) == "throughput") row = r;
    ASSERT_GE(row, 0);
    filterBy(menuAt(view, table.model().index(row, VertexTableModel::kThis)), "luminance(v.throughput) ≥");
    EXPECT_EQ(filter().queryText(), "any(luminance(v.throughput) >= 16)") << filter().queryText().toStdString();
    EXPECT_EQ(filter().countText(), "1 of 4 paths");
    inMenu(menuAt(view, table.model().index(row, VertexTableModel::kThis)), [&](QMenu& menu) {
        ASSERT_TRUE(find(menu, "Copy value"));
        find(menu, "Copy value")->trigger();
    });
    EXPECT_TRUE(QApplication::clipboard()->text().contains("16"));
}

TEST_F(FilterMenuTest, PointsOfPlotsAndOutliers) {
    program->window->showDock("plots-depth");
    ScatterPlot& row = program->window->views().plots[2].widget->row(0);
    const auto onPoint = [&] { emit row.menuRequested(row.mapToGlobal(row.rect().center()), 2u); };
    filterBy(onPoint, "depth ≥");
    EXPECT_EQ(filter().countText(), "4 of 4 paths");
    inMenu(onPoint, [&](QMenu& menu) { find(menu, "Show only this path")->trigger(); });
    EXPECT_EQ(program->selection.state().paths, (std::vector<client::PathId>{{{7, 5}, 2, 0}}));
    EXPECT_EQ(program->window->views().paths->model().rowCount(), 1);
    EXPECT_EQ(program->window->views().scene->options().paths, PathChoice::selected) << "in all views";

    OutlierPanel& outliers = *program->window->views().outliers;
    program->window->showDock("outliers");
    analysis::OutlierOptions options = outliers.options();
    options.deviations = 1;
    outliers.setOptions(options);
    ASSERT_EQ(outliers.model().rowCount(), 1);
    QTest::qWait(30);
    filter().clear();
    filterBy(menuAt(outliers.table(), outliers.model().index(0, 0)), "luminance ≥");
    EXPECT_EQ(filter().countText(), "1 of 4 paths");
}

TEST_F(FilterMenuTest, EveryOfferedConditionHoldsForItsOwnPath) {
    for (Index path = 0; path < paths().pathCount(); ++path) {
        std::vector<Entry> entries;
        appendPathInfo(paths(), path, {}, entries);
        appendPathData(paths(), path, {}, entries);
        for (Index v = paths().vertices(path).first; v < paths().vertices(path).last; ++v) appendVertexEntries(paths(), v, {}, entries);
        for (const Entry& entry : entries)
            for (const ValueRule& offered : rulesFor(paths(), entry)) {
                const auto text = query::toQuery(offered.rule, paths());
                ASSERT_TRUE(text) << offered.title.toStdString();
                const auto query = query::Query::parse(*text);
                ASSERT_TRUE(query) << *text;
                const auto matches = query->select(paths());
                ASSERT_TRUE(matches) << *text;
                EXPECT_TRUE(std::ranges::binary_search(matches->paths, path)) << *text << " for path " << path;
            }
    }
}

}  // namespace
}  // namespace emca::explorer
