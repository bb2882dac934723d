// Parallel coordinates in the real window: what is marked there reaches the filter and every view, the axes are kept.
#include <QAction>
#include <QToolButton>

#include "image/image_canvas.h"
#include "image/image_view.h"
#include "parallel/parallel_canvas.h"
#include "parallel/parallel_plot.h"
#include "paths/filter_panel.h"
#include "plots/path_plot.h"
#include "testing/program.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

class PlotLinksTest : public MainWindowTest {
  protected:
    void open(Program& program) {
        connectTo(program);
        ImageCanvas& canvas = program.window->views().image->canvas();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf({7, 5}).center().toPoint());
        ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.window->isSettled(); }));
        program.window->showDock("plots-parallel");
        ASSERT_TRUE(waitFor([&] { return program.window->views().parallel->isVisible(); }));
    }
    /// Marks all of the upper or lower part of an axis.
    static void mark(ParallelPlot& plot, std::size_t axis, double from, double to) {
        ParallelCanvas& canvas = plot.canvas();
        const QPoint a(int(canvas.frame().x(axis)), int(from)), b(int(canvas.frame().x(axis)), int(to));
        QTest::mousePress(&canvas, Qt::LeftButton, {}, a);
        QMouseEvent move(QEvent::MouseMove, QPointF(b), canvas.mapToGlobal(b), Qt::NoButton, Qt::LeftButton, {});
        QCoreApplication::sendEvent(&canvas, &move);
        QTest::mouseRelease(&canvas, Qt::LeftButton, {}, b);
    }
};

TEST_F(PlotLinksTest, MarksReachTheFilterAndEveryView) {
    Program program(settingsFile());
    open(program);
    ParallelPlot& plot = *program.window->views().parallel;
    plot.setAxes({{"sample"}, {"luminance"}});
    const ParallelFrame& frame = plot.canvas().frame();
    mark(plot, 0, frame.position(plot.axes()[0], 0.6), frame.position(plot.axes()[0], 2.4));
    std::vector<std::int64_t> samples;
    for (const client::PathId& id : program.selection.state().paths) samples.push_back(id.sample);
    EXPECT_EQ(samples, (std::vector<std::int64_t>{1, 2}));
    EXPECT_EQ(program.window->views().plots[0].widget->row(0).content().selected.size(), 2u);

    for (auto* button : plot.findChildren<QToolButton*>())
        if (button->text() == "To filter") QTest::mouseClick(button, Qt::LeftButton);
    FilterPanel& filter = *program.window->views().filter;
    EXPECT_TRUE(filter.isVisible()) << "it comes to the front";
    EXPECT_EQ(filter.queryText(), "sample >= 1 and sample <= 2");
    EXPECT_EQ(filter.rowCount(), 2u);
    plot.filterByBrushes();
    EXPECT_EQ(filter.rowCount(), 2u) << "the same rules once";
}

TEST_F(PlotLinksTest, AQueryByHandIsKept) {
    Program program(settingsFile());
    open(program);
    ParallelPlot& plot = *program.window->views().parallel;
    plot.setAxes({{"sample"}, {"luminance"}});
    program.window->views().filter->setQueryText("luminance > 0 or depth > 1");
    const ParallelFrame& frame = plot.canvas().frame();
    mark(plot, 0, frame.position(plot.axes()[0], 0.6), frame.position(plot.axes()[0], 1.4));
    plot.filterByBrushes();
    EXPECT_EQ(program.window->views().filter->queryText(), "(luminance > 0 or depth > 1) and sample == 1");
}

TEST_F(PlotLinksTest, AxesOutliveTheProgram) {
    const std::vector<AxisWish> wishes{{"depth", false, true}, {"luminance", true}};
    {
        Program program(settingsFile());
        program.window->views().parallel->setAxes(wishes);
        program.window->close();
    }
    Program program(settingsFile());
    EXPECT_EQ(program.window->views().parallel->axes().wishes(), wishes);
}

TEST_F(PlotLinksTest, LMeansTheVisiblePlot) {
    Program program(settingsFile());
    open(program);
    ParallelPlot& plot = *program.window->views().parallel;
    plot.setAxes({{"depth"}, {"luminance"}});
    program.window->setFocus();
    QTest::keyClick(program.window.get(), Qt::Key_L);
    EXPECT_TRUE(plot.axes()[1].isLog());
    EXPECT_FALSE(plot.axes()[0].isLog());
    plot.canvas().setFocus();
    QTest::keyClick(&plot.canvas(), Qt::Key_Right);
    QTest::keyClick(&plot.canvas(), Qt::Key_L);
    EXPECT_TRUE(plot.axes()[0].isLog()) << "the axis that the keys chose";
}

}  // namespace
}  // namespace emca::explorer
