#include "paths/vertex_table.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QTableView>
#include <QTest>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "paths/test_paths.h"
#include "paths/vertex_table_model.h"

namespace emca::explorer {
namespace {

using test::fakePaths;
using M = VertexTableModel;

int rowOf(const M& model, const QString& quantity) {
    for (int row = 0; row < model.rowCount(); ++row)
        if (model.quantity(row) == quantity) return row;
    ADD_FAILURE() << "no row " << quantity.toStdString();
    return 0;
}

TEST(VertexTableModel, SetsAVertexBesideItsNeighbours) {
    M model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    const PathSet paths = fakePaths({.samples = 32, .vertices = 0, .firefly = 17});
    const Index vertex = *paths.findVertex(17, 3);
    model.setVertex(paths, vertex);
    EXPECT_EQ(model.previous(), vertex - 1);
    EXPECT_EQ(model.next(), vertex + 1);
    const int pdf = rowOf(model, "bsdf pdf");
    EXPECT_EQ(model.cell(pdf, M::kThis).full, "4.2e-06");
    const Column& column = *paths.find(Scope::vertex, "bsdf pdf").front();
    for (const auto& [cell, at] : {std::pair{M::kPrevious, vertex - 1}, {M::kThis, vertex}, {M::kNext, vertex + 1}})
        EXPECT_EQ(model.cell(pdf, cell).full.toFloat(), std::get<float>(*paths.last(column, at)));
    EXPECT_EQ(model.cell(rowOf(model, "event"), M::kThis).value.text, "transmit specular · tinted glass");
    EXPECT_EQ(model.headerData(M::kThis, Qt::Horizontal, Qt::DisplayRole).toString(), "vertex 3");
}

TEST(VertexTableModel, EndsOfAPathHaveOneNeighbour) {
    M model;
    const PathSet paths = fakePaths({.samples = 4, .vertices = 3});
    model.setVertex(paths, paths.vertices(1).first);
    EXPECT_FALSE(model.previous());
    EXPECT_EQ(model.headerData(M::kPrevious, Qt::Horizontal, Qt::DisplayRole).toString(), "no vertex before");
    EXPECT_FALSE(model.cell(rowOf(model, "bsdf pdf"), M::kPrevious).present);
    model.setVertex(paths, paths.vertices(1).last - 1);
    EXPECT_FALSE(model.next()) << "the next path's first vertex is no neighbour";
    model.setVertex(paths, std::nullopt);
    EXPECT_EQ(model.rowCount(), 0);
}

TEST(VertexTable, FollowsTheSelectionAndSteps) {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    VertexTable table(dataset, selection, theme);
    table.resize(640, 420);
    table.show();
    const auto* overlay = table.findChild<StateOverlay*>();
    EXPECT_EQ(overlay->sentence(), "Click a pixel in the image");
    dataset.addTrace(test::traceOf(fakePaths({.samples = 32, .vertices = 4})));
    EXPECT_EQ(overlay->sentence(), "Click a vertex in the 3D view or in the tree");
    const PathSet& paths = dataset.paths();
    const Index first = paths.vertices(5).first;
    selection.setVertex(vertexId(paths, first));
    EXPECT_EQ(table.model().vertex(), first);
    table.stepForward();
    EXPECT_EQ(selection.state().vertex, vertexId(paths, first + 1));
    EXPECT_EQ(table.model().vertex(), first + 1);
    table.stepBack();
    table.stepBack();  // there is none: stays
    EXPECT_EQ(table.model().vertex(), first);
    dataset.addTrace(test::traceOf({}));
    EXPECT_EQ(table.model().rowCount(), 0);
}

TEST(VertexTable, NarrowTablesLeaveTheNeighboursOut) {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    VertexTable table(dataset, selection, theme);
    table.show();
    auto* view = table.findChild<QTableView*>();
    table.resize(900, 400);
    EXPECT_FALSE(view->isColumnHidden(M::kPrevious));
    table.resize(360, 400);
    EXPECT_TRUE(view->isColumnHidden(M::kPrevious));
    EXPECT_TRUE(view->isColumnHidden(M::kNext));
}

}  // namespace
}  // namespace emca::explorer
