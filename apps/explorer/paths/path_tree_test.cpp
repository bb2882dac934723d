#include "paths/path_tree.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QLineEdit>
#include <QScrollBar>
#include <QTest>

#include "base/path_ids.h"
#include "base/theme.h"
#include "paths/path_tree_model.h"
#include "paths/path_tree_view.h"
#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

using client::PathId;
using test::fakePaths;

class PathTreeTest : public testing::Test {
  protected:
    PathTreeTest() : tree(dataset, selection, theme) {
        tree.resize(600, 420);
        tree.show();
        dataset.addTrace(test::traceOf(fakePaths({.samples = 64, .vertices = 0, .firefly = 17})));
        listening.emplace(selection, [this](std::uint32_t) { ++notifications; });
    }
    PathId id(std::int64_t sample) const { return {{174, 169}, sample, 0}; }
    const PathSet& paths() const { return dataset.paths(); }
    PathTreeView& view() { return tree.view(); }
    void click(const QModelIndex& index, Qt::KeyboardModifiers modifiers = {}) {
        ASSERT_TRUE(index.isValid());
        view().scrollTo(index);
        QTest::mouseClick(view().viewport(), Qt::LeftButton, modifiers, view().visualRect(index).center());
    }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    PathTree tree;
    std::optional<SelectionListening> listening;
    int notifications = 0;
};

TEST_F(PathTreeTest, ClickSelectsThatPathAndTellsOnce) {
    click(tree.model().pathIndex(5));
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(5)});
    EXPECT_EQ(selection.state().currentPath, id(5));
    EXPECT_EQ(notifications, 1);
    click(tree.model().pathIndex(9), Qt::ControlModifier);
    EXPECT_EQ(selection.state().paths, (std::vector<PathId>{id(5), id(9)}));
    EXPECT_EQ(notifications, 2);
    click(tree.model().pathIndex(12), Qt::ShiftModifier);
    EXPECT_EQ(selection.state().paths, (std::vector<PathId>{id(5), id(9), id(10), id(11), id(12)}));
    EXPECT_EQ(notifications, 3);
}

TEST_F(PathTreeTest, ClickOnAVertexSelectsIt) {
    view().expandPaths();
    const Index vertex = paths().vertices(2).first + 1;
    click(tree.model().vertexIndex(vertex));
    EXPECT_EQ(selection.state().vertex, vertexId(paths(), vertex));
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(2)});
    EXPECT_EQ(notifications, 1);
}

TEST_F(PathTreeTest, KeysStepThroughRows) {
    click(tree.model().pathIndex(5));
    QTest::keyClick(&view(), Qt::Key_Down);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(6)});
    QTest::keyClick(&view(), Qt::Key_Escape);
    EXPECT_TRUE(selection.state().paths.empty());
}

TEST_F(PathTreeTest, FollowsOtherViewsWithoutAnswering) {
    selection.setPaths({id(3), id(4), id(40)});
    EXPECT_EQ(notifications, 1);
    EXPECT_EQ(view().selectionModel()->selectedRows().size(), 3);
    const Index vertex = paths().vertices(40).first + 1;
    selection.setVertex(vertexId(paths(), vertex));
    EXPECT_EQ(notifications, 2);
    const QModelIndex row = tree.model().vertexIndex(vertex);
    EXPECT_EQ(view().currentIndex(), row);
    EXPECT_TRUE(view().isExpanded(row.parent()));
    EXPECT_TRUE(view().viewport()->rect().contains(view().visualRect(row).center()));
    selection.clearPaths();
    EXPECT_TRUE(view().selectionModel()->selectedRows().isEmpty());
    EXPECT_EQ(notifications, 3);
}

TEST_F(PathTreeTest, InspectsSelectedPathsAndShowsAllAgain) {
    EXPECT_EQ(tree.countText(), "64 paths");
    selection.setPaths({id(3), id(17)});
    tree.inspectSelected();
    EXPECT_EQ(tree.model().rowCount(), 2);
    EXPECT_EQ(tree.countText(), "2 of 64 paths");
    click(tree.model().pathIndex(17));  // choosing among them does not drop the others
    EXPECT_EQ(tree.model().rowCount(), 2);
    selection.setPaths({id(20), id(21), id(22)});  // another view's choice replaces them
    EXPECT_EQ(tree.model().rowCount(), 3);
    tree.showAll();
    EXPECT_EQ(tree.model().rowCount(), 64);
}

TEST_F(PathTreeTest, ReloadKeepsExpansionScrollAndSelection) {
    view().setExpanded(tree.model().pathIndex(17), true);
    view().setExpanded(tree.model().vertexIndex(*paths().findVertex(17, 3)), true);
    selection.setPaths({id(17), id(30)});
    view().scrollTo(tree.model().pathIndex(25), QAbstractItemView::PositionAtTop);
    const QModelIndex top = view().indexAt(QPoint(2, 2));
    const Index topPath = tree.model().pathOf(top);
    ASSERT_GT(view().verticalScrollBar()->value(), 0);
    // Twice as many samples of the same pixel: the first 64 are the same paths.
    dataset.addTrace(test::traceOf(fakePaths({.samples = 128, .vertices = 0, .firefly = 17})));
    ASSERT_EQ(tree.model().rowCount(), 128);
    EXPECT_TRUE(view().isExpanded(tree.model().pathIndex(17)));
    EXPECT_TRUE(view().isExpanded(tree.model().vertexIndex(*paths().findVertex(17, 3))));
    EXPECT_FALSE(view().isExpanded(tree.model().pathIndex(18)));
    EXPECT_EQ(tree.model().pathOf(view().indexAt(QPoint(2, 2))), topPath);
    EXPECT_EQ(selection.state().paths, (std::vector<PathId>{id(17), id(30)}));
    EXPECT_EQ(view().selectionModel()->selectedRows().size(), 2);
}

TEST_F(PathTreeTest, TypingFindsKeysAtEveryVertexOfTheCurrentPath) {
    selection.setPaths({id(17)});
    auto* find = tree.findChild<QLineEdit*>();
    ASSERT_NE(find, nullptr);
    QTest::keyClicks(find, "pdf");
    const auto vertices = paths().vertices(17);
    for (Index v = vertices.first; v < vertices.last; ++v) {
        const QModelIndex row = tree.model().vertexIndex(v);
        EXPECT_TRUE(view().isExpanded(row));
        ASSERT_EQ(tree.model().rowCount(row), 1);
        EXPECT_EQ(tree.model().index(0, 0, row).data().toString(), "bsdf pdf");
    }
    QTest::keyClick(find, Qt::Key_Escape);
    EXPECT_TRUE(find->text().isEmpty());
}

TEST_F(PathTreeTest, CopiesSelectedPathsAsTextInFull) {
    selection.setPaths({id(17)});
    QTest::keyClick(&view(), Qt::Key_C, Qt::ControlModifier);
    const QString text = QApplication::clipboard()->text();
    EXPECT_TRUE(text.startsWith("Path 17 (174, 169)\n  final estimate: ")) << text.toStdString();
    EXPECT_TRUE(text.contains("3 · transmit specular · tinted glass\n"));
    EXPECT_TRUE(text.contains("bsdf pdf: 4.2e-06\n"));
}

TEST_F(PathTreeTest, StaysUsableWithManySelectedRanges) {
    dataset.addTrace(test::traceOf(fakePaths({.samples = 65536, .vertices = 8})));
    std::vector<PathId> every;
    for (std::int64_t sample = 0; sample < 65536; sample += 2) every.push_back(id(sample));
    selection.setPaths(every);
    selection.setPaths({id(1), id(3)});
    EXPECT_EQ(view().selectionModel()->selectedRows().size(), 2);
    view().expandPaths();
    EXPECT_TRUE(view().isExpanded(tree.model().pathIndex(65535)));
}

TEST(PathTree, EmptyWithoutPaths) {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    PathTree tree(dataset, selection, theme);
    tree.resize(600, 420);
    tree.show();
    EXPECT_EQ(tree.countText(), "0 paths");
    dataset.addTrace(test::traceOf({}));
    tree.inspectSelected();
    tree.expand();
    tree.setKeyFilter("pdf");
    tree.showAll();
    EXPECT_EQ(tree.model().rowCount(), 0);
}

}  // namespace
}  // namespace emca::explorer
