#include "paths/outlier_panel.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTableView>
#include <QTest>
#include <limits>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "paths/outlier_model.h"
#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

using client::PathId;
using test::fakePaths;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class OutlierPanelTest : public testing::Test {
  protected:
    OutlierPanelTest() : panel(dataset, selection, theme) {
        panel.resize(420, 420);
        panel.show();
    }
    PathId id(std::int64_t sample, Pixel pixel = {174, 169}) const { return {pixel, sample, 0}; }
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    OutlierPanel panel;
};

TEST_F(OutlierPanelTest, FindsTheFireflyAndSelectsIt) {
    dataset.addTrace(test::traceOf(fakePaths({.samples = 1024, .vertices = 0, .firefly = 417})));
    ASSERT_EQ(panel.model().found().size(), 1u);
    EXPECT_EQ(panel.model().found()[0].id, id(417));
    // One value among n that is far from all others is sqrt(n) deviations away, less 1/n.
    EXPECT_NEAR(panel.model().found()[0].deviations, std::sqrt(1024.0), 0.1);
    EXPECT_TRUE(selection.state().paths.empty()) << "finding is not selecting";
    QTest::mouseClick(panel.findChild<QPushButton*>(), Qt::LeftButton);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)});
    EXPECT_EQ(selection.state().currentPath, id(417));
}

TEST_F(OutlierPanelTest, RunsByItselfOnNewPixels) {
    panel.setAutomatic(true);
    dataset.addTrace(test::traceOf(fakePaths({.samples = 1024, .vertices = 0, .firefly = 417})));
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)});
    dataset.addTrace(test::traceOf(fakePaths({.pixel = {1, 2}, .samples = 256, .vertices = 0, .firefly = 9}), {1, 2}));
    EXPECT_EQ(selection.state().paths, (std::vector<PathId>{id(9, {1, 2})}));
}

TEST_F(OutlierPanelTest, NamesSampleIndicesNotPositionsAndEachOnce) {
    dataset.addTrace(test::traceOf(fakePaths({.samples = 512, .vertices = 0, .firstSample = 5000, .firefly = 5100})));
    ASSERT_EQ(panel.model().found().size(), 1u);
    EXPECT_EQ(panel.model().found()[0].name, "Path 5100");
    panel.selectFound();
    panel.selectFound();
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(5100)});
}

TEST_F(OutlierPanelTest, NaNComesFirstThenTheFarthest) {
    std::vector<Color> estimates(200, Color(1));
    for (std::size_t i = 0; i < 200; ++i) estimates[i] = Color(1 + 0.01f * float(i % 7));
    estimates[20] = Color(8.f);
    estimates[50] = Color(9.f);
    estimates[120] = Color(kNaN, 1, 1);
    dataset.addTrace(test::traceOf(test::pathsWithEstimates(estimates), {3, 4}));
    ASSERT_EQ(panel.model().found().size(), 3u);
    EXPECT_EQ(panel.model().found()[0].id.sample, 120);
    EXPECT_EQ(panel.model().found()[1].id.sample, 50);
    EXPECT_EQ(panel.model().found()[2].id.sample, 20);
    EXPECT_TRUE(panel.summaryText().contains("1 NaN or infinite"));
}

TEST_F(OutlierPanelTest, EmptyStateNamesTheLimit) {
    const auto* overlay = panel.findChild<StateOverlay*>();
    EXPECT_EQ(overlay->sentence(), "Click a pixel in the image");
    dataset.addTrace(test::traceOf(test::pathsWithEstimates(std::vector<Color>(10, Color(2)))));
    EXPECT_TRUE(overlay->isVisible());
    EXPECT_TRUE(panel.model().found().empty());
    panel.setOptions({.quantity = analysis::PathQuantity::depth, .deviations = 2.5});
    EXPECT_EQ(panel.options().quantity, analysis::PathQuantity::depth);
    EXPECT_EQ(panel.options().deviations, 2.5);
    panel.setAutomatic(true);
    dataset.addTrace(test::traceOf({}));
    EXPECT_TRUE(selection.state().paths.empty());
}

TEST_F(OutlierPanelTest, RowsAndSelectionFollowEachOther) {
    panel.setOptions({.deviations = 0.5});
    dataset.addTrace(test::traceOf(fakePaths({.samples = 64, .vertices = 0})));
    ASSERT_GT(panel.model().found().size(), 3u);
    QTableView& table = panel.table();
    const QRect second = table.visualRect(panel.model().index(1, 0));
    QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, second.center());
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{panel.model().found()[1].id});
    QTest::keyClick(&table, Qt::Key_Down);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{panel.model().found()[2].id});
    selection.setPaths({panel.model().found()[0].id, panel.model().found()[3].id});
    EXPECT_EQ(table.selectionModel()->selectedRows().size(), 2);
}

TEST_F(OutlierPanelTest, TheTestFindsOutliersThatHideEachOther) {
    // Half of 20 values, less one, are tested. Two a little apart from each other and far from the rest widen sigma so much that neither is beyond 3 of it.
    std::vector<Color> estimates;
    for (int i = 0; i < 18; ++i) estimates.emplace_back(1 + 0.01f * float(i % 7));
    estimates.emplace_back(50.f);
    estimates.emplace_back(52.f);
    dataset.addTrace(test::traceOf(test::pathsWithEstimates(estimates), {3, 4}));
    EXPECT_TRUE(panel.model().found().empty());
    QComboBox* method = nullptr;
    for (QComboBox* box : panel.findChildren<QComboBox*>())
        if (box->findText("Generalized ESD") >= 0) method = box;
    ASSERT_TRUE(method);
    auto* maximum = panel.findChild<QSpinBox*>();
    EXPECT_FALSE(maximum->isVisible());
    method->setFocus();
    QTest::keyClick(method, Qt::Key_Down);
    EXPECT_EQ(panel.options().method, analysis::OutlierMethod::generalizedEsd);
    EXPECT_TRUE(maximum->isVisible());
    ASSERT_EQ(panel.model().found().size(), 2u);
    EXPECT_EQ(panel.model().found()[0].id.sample, 19);
    EXPECT_GT(panel.model().found()[0].statistic, panel.model().found()[0].critical);
    EXPECT_TRUE(panel.model().index(0, OutlierModel::kDeviations).data().toString().contains(" > "));
    EXPECT_TRUE(panel.summaryText().contains("2 of 20 paths.")) << panel.summaryText().toStdString();
    EXPECT_TRUE(panel.summaryText().contains("9 tested; the next one")) << panel.summaryText().toStdString();
    maximum->setFocus();
    maximum->selectAll();
    QTest::keyClicks(maximum, "1");
    QTest::keyClick(maximum, Qt::Key_Return);
    EXPECT_EQ(panel.options().maximum, 1u);
    QTest::keyClick(maximum, Qt::Key_Up);
    EXPECT_EQ(panel.options().maximum, 2u);
    EXPECT_EQ(panel.model().found().size(), 2u);
    EXPECT_TRUE(panel.summaryText().contains("there may be more")) << panel.summaryText().toStdString();
    panel.selectFound();
    EXPECT_EQ(selection.state().paths.size(), 2u);
    QTest::keyClick(method, Qt::Key_Up);
    EXPECT_FALSE(maximum->isVisible());
    EXPECT_TRUE(panel.summaryText().contains("limits")) << panel.summaryText().toStdString();
}

TEST_F(OutlierPanelTest, TheTestRunsByItselfOnNewPixels) {
    panel.setOptions({.method = analysis::OutlierMethod::generalizedEsd, .upperOnly = true, .maximum = 3, .significance = 0.001});
    EXPECT_EQ(panel.options().maximum, 3u);
    EXPECT_EQ(panel.options().significance, 0.001);
    panel.setAutomatic(true);
    dataset.addTrace(test::traceOf(fakePaths({.samples = 1024, .vertices = 0, .firefly = 417})));
    EXPECT_TRUE(selection.isSelected(id(417)));
    EXPECT_EQ(selection.state().currentPath, id(417)) << "the farthest";
}

/// A dark pixel with a firefly beside a bright one with none: together the bright pixel is what stands out.
TEST_F(OutlierPanelTest, EachPixelOfARegionForItself) {
    std::vector<PathSet> pixels;
    for (const float bright : {0.1f, 100.f}) {
        std::vector<Color> estimates;
        for (int i = 0; i < 64; ++i) estimates.emplace_back(bright * (1 + 0.02f * float(i % 7)));
        if (bright < 1) estimates[17] = Color(2.f);
        pixels.push_back(test::pathsWithEstimates(estimates, {1, 2}, bright < 1 ? Pixel{174, 169} : Pixel{175, 169}));
    }
    auto* perPixel = [&]() -> QCheckBox* {
        for (QCheckBox* box : panel.findChildren<QCheckBox*>())
            if (box->text() == "each pixel for itself") return box;
        return nullptr;
    }();
    ASSERT_TRUE(perPixel);
    EXPECT_FALSE(perPixel->isVisible()) << "there is one pixel at most";
    dataset.addTrace(test::traceOf(PathSet::merged(pixels)));
    EXPECT_TRUE(panel.model().found().empty()) << panel.summaryText().toStdString();
    ASSERT_TRUE(perPixel->isVisible());
    QTest::mouseClick(perPixel, Qt::LeftButton, {}, {8, perPixel->height() / 2});
    ASSERT_TRUE(panel.isPerPixel());
    ASSERT_EQ(panel.model().found().size(), 1u);
    EXPECT_EQ(panel.model().found()[0].id, id(17));
    EXPECT_GT(panel.model().found()[0].deviations, 5) << "of its own pixel";
    EXPECT_TRUE(panel.summaryText().startsWith("1 of 128 paths, in 1 of 2 pixels.")) << panel.summaryText().toStdString();
    panel.selectFound();
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(17)});
    panel.setOptions({.method = analysis::OutlierMethod::generalizedEsd, .maximum = 1});
    EXPECT_TRUE(panel.summaryText().contains("there may be more")) << panel.summaryText().toStdString();
    dataset.addTrace(test::traceOf(pixels[0]));
    EXPECT_FALSE(perPixel->isVisible());
    EXPECT_TRUE(panel.summaryText().contains("1 of 64 paths.")) << "one pixel: as ever";
}

TEST(OutlierModel, ObeysTheRulesOfItemModels) {
    OutlierModel model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    const PathSet paths = fakePaths({.samples = 64, .vertices = 0});
    const auto reports = analysis::detectOutliersPerPixel(paths, {.deviations = 1});
    ASSERT_TRUE(reports.ok());
    model.setReports(paths, *reports, analysis::PathQuantity::luminance);
    EXPECT_EQ(model.rowCount(), int(reports->front().report.outliers.size()));
}

}  // namespace
}  // namespace emca::explorer
