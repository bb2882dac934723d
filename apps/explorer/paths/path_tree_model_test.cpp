#include "paths/path_tree_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QTreeView>
#include <limits>
#include <set>
#include <unordered_map>

#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

using test::fakePaths;
using test::pathsWithEstimates;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Depth-first over all rows.
template <typename Visit>
void visitAll(const QAbstractItemModel& model, const QModelIndex& parent, Visit visit) {
    for (int row = 0; row < model.rowCount(parent); ++row) {
        const QModelIndex index = model.index(row, 0, parent);
        visit(index);
        visitAll(model, index, visit);
    }
}

TEST(PathTreeModel, ObeysTheRulesOfItemModels) {
    PathTreeModel model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    model.setPaths(fakePaths({.samples = 12, .vertices = 3}));
    model.setOrder(PathOrder::luminance, true);
    model.setFilter("pdf");
    model.setFilter({});
    model.setPaths(fakePaths({.samples = 12, .vertices = 3}), std::vector<Index>{7, 2});
    model.setPaths({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(PathTreeModel, EveryIndexFindsItsParentAndItself) {
    PathTreeModel model;
    model.setPaths(fakePaths({.samples = 40, .vertices = 0}));
    int rows = 0;
    visitAll(model, {}, [&](const QModelIndex& index) {
        ++rows;
        const QModelIndex parent = model.parent(index);
        ASSERT_EQ(model.index(index.row(), 0, parent), index);
        ASSERT_EQ(model.sibling(index.row(), 2, index), model.index(index.row(), 2, parent));
    });
    EXPECT_GT(rows, 40 * 10);
}

TEST(PathTreeModel, ShowsEveryValueOfEveryVertex) {
    const PathSet paths = fakePaths({.samples = 30, .vertices = 5, .firefly = 4});
    PathTreeModel model;
    model.setPaths(paths);
    std::size_t contributions = 0, nextEvents = 0, data = 0, vertices = 0;
    visitAll(model, {}, [&](const QModelIndex& index) {
        if (model.node(index).kind == PathTreeModel::Node::Kind::vertex) ++vertices;
        const auto entry = model.entryOf(index);
        if (!entry) return;
        contributions += entry->kind == Entry::Kind::contribution;
        nextEvents += entry->kind == Entry::Kind::nextEvent;
        data += entry->kind == Entry::Kind::data;
    });
    EXPECT_EQ(vertices, paths.vertexCount());
    EXPECT_EQ(contributions, paths.columns().contributions.size());
    EXPECT_EQ(nextEvents, paths.columns().nextEvents.size());
    std::size_t recorded = 0;
    for (const Column& column : paths.userColumns()) recorded += column.count;
    EXPECT_EQ(data, recorded);
}

TEST(PathTreeModel, SaysWhatHappenedAtAVertex) {
    const PathSet paths = fakePaths({.samples = 8, .vertices = 6, .firefly = 3});
    PathTreeModel model;
    model.setPaths(paths);
    const Index vertex = *paths.findVertex(3, 3);
    const QModelIndex row = model.vertexIndex(vertex);
    EXPECT_EQ(row.data().toString(), "3 · transmit specular · tinted glass");
    EXPECT_EQ(model.pathOf(row), 3u);
    EXPECT_EQ(model.vertexOf(row), vertex);
    EXPECT_EQ(row.parent(), model.pathIndex(3));
}

TEST(PathTreeModel, MarksWhatIsNotFinite) {
    PathTreeModel model;
    model.setPaths(pathsWithEstimates({Color(1), Color(kNaN, 1, 1), Color(0, kInfinity, 0)}));
    EXPECT_EQ(model.index(0, 0).data(PathTreeModel::kToneRole).toInt(), int(Tone::normal));
    EXPECT_EQ(model.index(1, 0).data(PathTreeModel::kToneRole).toInt(), int(Tone::warning));
    EXPECT_EQ(model.index(2, 0).data(PathTreeModel::kToneRole).toInt(), int(Tone::warning));
    EXPECT_TRUE(model.index(1, 1).data().toString().contains("NaN"));
}

TEST(PathTreeModel, PathsWithoutFinalEstimateAreShown) {
    PathTreeModel model;
    model.setPaths(fakePaths({.samples = 3, .estimates = false}));
    ASSERT_EQ(model.rowCount(), 3);
    EXPECT_EQ(model.index(0, 1).data().toString(), "no final estimate");
    EXPECT_FALSE(model.index(0, 2).data(PathTreeModel::kColorRole).isValid());
}

TEST(PathTreeModel, SortsAndKeepsPersistentRows) {
    PathTreeModel model;
    model.setPaths(pathsWithEstimates({Color(2), Color(kNaN, 0, 0), Color(0.5f), Color(9), Color(2)}, {3, 1, 2}));
    const QPersistentModelIndex brightest = model.pathIndex(3), child = model.index(0, 0, model.pathIndex(2));
    const auto order = [&] {
        std::vector<Index> paths;
        for (int row = 0; row < model.rowCount(); ++row) paths.push_back(model.pathOf(model.index(row, 0)));
        return paths;
    };
    model.setOrder(PathOrder::luminance, true);
    EXPECT_EQ(order(), (std::vector<Index>{1, 3, 0, 4, 2}));  // NaN first, equal ones by sample
    EXPECT_EQ(brightest.row(), 1);
    EXPECT_EQ(model.pathOf(child), 2u);
    EXPECT_EQ(child.parent(), model.pathIndex(2));
    model.setOrder(PathOrder::depth, false);
    EXPECT_EQ(order(), (std::vector<Index>{1, 4, 2, 0, 3}));
    model.setOrder(PathOrder::sample, true);
    EXPECT_EQ(order(), (std::vector<Index>{4, 3, 2, 1, 0}));
}

TEST(PathTreeModel, FilterKeepsTheRowsOfMatchingKeysAlone) {
    PathTreeModel model;
    model.setPaths(fakePaths({.samples = 5, .vertices = 4}));
    model.setFilter("PDF");
    int values = 0;
    visitAll(model, {}, [&](const QModelIndex& index) {
        if (!model.entryOf(index)) return;
        ++values;
        EXPECT_EQ(index.data().toString(), "bsdf pdf");
    });
    EXPECT_EQ(values, 5 * 4);
    EXPECT_EQ(model.rowCount(model.pathIndex(0)), 4);  // no empty groups
}

TEST(PathTreeModel, LightSubpathsAndSamplesWithGapsAreNamed) {
    PathTreeModel model;
    model.setPaths(fakePaths({.samples = 2, .vertices = 1, .firstSample = 1000000}));
    EXPECT_EQ(model.index(1, 0).data().toString(), "Path 1000001");
}

/// Counts how often a view asks.
class CountingModel : public PathTreeModel {
  public:
    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override {
        ++calls;
        return PathTreeModel::index(row, column, parent);
    }
    int rowCount(const QModelIndex& parent = {}) const override {
        ++calls;
        return PathTreeModel::rowCount(parent);
    }
    QVariant data(const QModelIndex& index, int role) const override {
        ++calls;
        return PathTreeModel::data(index, role);
    }
    mutable std::size_t calls = 0;
};

std::size_t callsToExpandAndCollapse(std::uint32_t samples) {
    CountingModel model;
    QTreeView view;
    view.setUniformRowHeights(true);
    view.setModel(&model);
    view.resize(600, 420);
    view.show();
    model.setPaths(fakePaths({.samples = samples, .vertices = 8}));
    model.calls = 0;
    view.expandAll();
    view.collapseAll();
    return model.calls;
}

TEST(PathTreeModel, ExpandingAllIsLinearInTheNumberOfPaths) {
    const std::size_t few = callsToExpandAndCollapse(128), many = callsToExpandAndCollapse(1024);
    EXPECT_LT(double(many), double(few) * 8 * 1.2) << few << " calls for 128 paths, " << many << " for 1,024";
}

TEST(PathTreeModel, FillingAViewDoesNotVisitThePaths) {
    CountingModel model;
    QTreeView view;
    view.setUniformRowHeights(true);
    view.setModel(&model);
    view.resize(600, 420);
    view.show();
    const PathSet few = fakePaths({.samples = 64, .vertices = 8}), many = fakePaths({.samples = 8192, .vertices = 8});
    model.setPaths(few);
    view.grab();
    model.calls = 0;
    model.setPaths(many);
    view.grab();
    // Each row is asked for a constant number of times and nothing below it is.
    EXPECT_LT(model.calls, many.pathCount() * 8u);
}

TEST(PathTreeModel, IndicesDoNotCollideInQtsHash) {
    PathTreeModel model;
    model.setPaths(fakePaths({.samples = 512, .vertices = 8}));
    // Buckets as in QHash: the hash modulo the number of buckets, about as many as there are entries.
    constexpr unsigned kBuckets = 131101;
    std::unordered_map<unsigned, int> buckets;
    int rows = 0;
    visitAll(model, {}, [&](const QModelIndex& index) {
        ++rows;
        ++buckets[static_cast<unsigned>(qHash(index)) % kBuckets];
    });
    int longest = 0;
    for (const auto& [bucket, count] : buckets) longest = std::max(longest, count);
    // A perfectly random hash has a longest chain of about 8 here.
    EXPECT_LE(longest, 16) << rows << " rows";
}

}  // namespace
}  // namespace emca::explorer
