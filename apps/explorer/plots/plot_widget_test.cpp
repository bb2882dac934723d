#include "plots/plot_widget.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <limits>

#include "base/theme.h"
#include "plots/marginal_histogram.h"
#include "plots/scatter_plot.h"
#include "plots/top_histogram.h"

namespace emca::explorer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class PlotWidgetTest : public testing::Test {
  protected:
    PlotWidgetTest() {
        plot.resize(500, 300);
        plot.setAxes({"depth", {}, true, false, {}}, {"weight", {}, false, false, {}});
        plot.setSeries({{"red", &ThemeColors::red, {1, 2, 3}, {0.5, 0.25, kNaN}, true}, {"green", &ThemeColors::green, {1, 2}, {0.75, 1}, true}});
        plot.show();
        QCoreApplication::processEvents();
    }
    QPoint place(std::uint32_t index) {
        const ScatterContent& content = plot.plot().content();
        return content.frame.place(content.xs[index], content.ys[index])->toPoint();
    }
    Theme theme;
    PlotWidget plot{theme, nullptr};
};

TEST_F(PlotWidgetTest, EachSeriesKeepsItsColour) {
    const ScatterContent& content = plot.plot().content();
    ASSERT_EQ(content.xs.size(), 5u);
    EXPECT_EQ(content.colorOf(2), theme.colors().red);
    EXPECT_EQ(content.colorOf(3), theme.colors().green);
    theme.setKind(ThemeKind::light);
    EXPECT_EQ(content.colorOf(3), lightColors().green);
    const QImage picture = plot.plot().canvas()->grab().toImage();
    const QColor there = picture.pixelColor(place(3) * picture.devicePixelRatio());
    EXPECT_GT(there.green(), there.red());
}

TEST_F(PlotWidgetTest, ClickingSaysWhichPointOfWhichSeries) {
    std::optional<PlotPoint> clicked;
    plot.onClick([&](PlotPoint point, Qt::KeyboardModifiers) { clicked = point; });
    QTest::mouseClick(plot.plot().canvas(), Qt::LeftButton, {}, place(4));
    EXPECT_EQ(clicked, (PlotPoint{1, 1}));
    QTest::mouseClick(plot.plot().canvas(), Qt::LeftButton, {}, place(0));
    EXPECT_EQ(clicked, (PlotPoint{0, 0}));
}

TEST_F(PlotWidgetTest, HoverShowsValuesAndTheSeries) {
    std::optional<PlotPoint> hovered;
    plot.onHover([&](std::optional<PlotPoint> point) { hovered = point; });
    QTest::mouseMove(plot.plot().canvas(), place(3));
    QCoreApplication::processEvents();
    EXPECT_EQ(hovered, (PlotPoint{1, 0}));
    EXPECT_TRUE(plot.plot().hoverText().contains("0.7500") && plot.plot().hoverText().contains("green")) << plot.plot().hoverText().toStdString();
}

TEST_F(PlotWidgetTest, SelectionIsMarkedWhateverIsNotThere) {
    plot.setSelected({{1, 0}, {0, 2}, {7, 0}, {0, 99}}, PlotPoint{1, 0});
    EXPECT_EQ(plot.plot().content().selected, (std::vector<std::uint32_t>{2, 3}));
    EXPECT_EQ(plot.plot().content().current, 3u);
    plot.setHovered(PlotPoint{5, 5});
}

TEST_F(PlotWidgetTest, AHistogramAlongXCountsAllPointsAndSelects) {
    plot.setHistograms(true, true);
    QCoreApplication::processEvents();
    const analysis::Histogram& bars = plot.topHistogram().bars();
    ASSERT_EQ(bars.counts, (std::vector<std::uint64_t>{2, 2, 1}));
    std::vector<PlotPoint> chosen;
    plot.onArea([&](const std::vector<PlotPoint>& points, bool) { chosen = points; });
    const ScatterContent& content = plot.plot().content();
    const int x = plot.plot().canvas()->mapTo(&plot, QPoint(int(content.frame.x().pixel(2)), 0)).x();
    QTest::mouseClick(&plot.topHistogram(), Qt::LeftButton, {}, QPoint(x, plot.topHistogram().height() - 4));
    EXPECT_EQ(chosen, (std::vector<PlotPoint>{{0, 1}, {1, 1}}));
}

TEST_F(PlotWidgetTest, WordsStandInThePlaceOfNumbers) {
    plot.setAxes({"depth", {}, true, false, {}}, {"material", {}, false, false, {"smooth dielectric", "area light"}});
    plot.setSeries({{"", &ThemeColors::data, {1, 2}, {0, 1}, false}});
    QTest::mouseMove(plot.plot().canvas(), place(0));
    QCoreApplication::processEvents();
    EXPECT_TRUE(plot.plot().hoverText().contains("smooth dielectric")) << plot.plot().hoverText().toStdString();
    EXPECT_EQ(plot.csv(), "depth,material\n1,smooth dielectric\n2,area light\n");
    plot.setLog(true);
    EXPECT_FALSE(plot.isLog()) << "words have no logarithm";
}

TEST_F(PlotWidgetTest, TheKeyLIsTold) {
    int told = 0;
    plot.onLog([&] { ++told; });
    plot.plot().setFocus();
    QTest::keyClick(&plot.plot(), Qt::Key_L);
    EXPECT_TRUE(plot.isLog());
    EXPECT_EQ(told, 1);
}

TEST_F(PlotWidgetTest, FilesHaveEveryPointInFull) {
    EXPECT_EQ(plot.csv(), "series,depth,weight\nred,1,0.5\nred,2,0.25\nred,3,NaN\ngreen,1,0.75\ngreen,2,1\n");
    QTemporaryDir folder;
    for (const char* name : {"plot.csv", "plot.png", "plot.svg"}) {
        EXPECT_TRUE(plot.exportTo(folder.filePath(name))) << name;
        EXPECT_GT(QFile(folder.filePath(name)).size(), 40) << name;
    }
    EXPECT_FALSE(plot.exportTo("/nowhere/plot.png"));
}

}  // namespace
}  // namespace emca::explorer
