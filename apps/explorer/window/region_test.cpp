// Regions in the real window: chosen by mouse and keys in the image, seen in every view.
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QTableView>

#include "image/image_canvas.h"
#include "image/image_view.h"
#include "image/region_panel.h"
#include "image/region_tool.h"
#include "paths/filter_panel.h"
#include "paths/outlier_panel.h"
#include "paths/path_tree.h"
#include "paths/path_tree_model.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "testing/program.h"
#include "window/history_view.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

class RegionWindowTest : public MainWindowTest {
  protected:
    static QPoint screen(Program& program, Pixel pixel) {
        return program.window->views().image->canvas().transform().rectOf(pixel).center().toPoint();
    }
    static void drag(Program& program, Pixel from, Pixel to, Qt::KeyboardModifiers modifiers) {
        ImageCanvas& canvas = program.window->views().image->canvas();
        QTest::mousePress(&canvas, Qt::LeftButton, modifiers, screen(program, from));
        QMouseEvent move(QEvent::MouseMove, QPointF(screen(program, to)), canvas.mapToGlobal(screen(program, to)), Qt::NoButton, Qt::LeftButton, modifiers);
        QCoreApplication::sendEvent(&canvas, &move);
        QTest::mouseRelease(&canvas, Qt::LeftButton, modifiers, screen(program, to));
    }
    static bool shows(Program& program, Index paths) {
        return waitFor([&] { return program.dataset.paths().pathCount() == paths && program.window->isSettled(); });
    }
};

TEST_F(RegionWindowTest, ADragInTheImageReachesEveryView) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    drag(program, {4, 3}, {7, 5}, Qt::ShiftModifier);
    ASSERT_TRUE(shows(program, 48));
    EXPECT_EQ(window.findChild<QLabel*>("verdict")->text(), "replay exact, 12 pixels");
    // The numbers come to the front with the first region.
    RegionPanel& panel = *window.views().region;
    EXPECT_TRUE(panel.isVisible());
    EXPECT_EQ(panel.titleText(), "Region 4x3 at (4, 3)");
    EXPECT_EQ(panel.pathsText(), "48 paths of 12 pixels. All replays are exact.");
    EXPECT_EQ(panel.warningText(), "");
    // Tree, plots, outliers and history name the pixel.
    const PathTreeModel& tree = window.views().paths->model();
    EXPECT_EQ(tree.rowCount(), 48);
    EXPECT_EQ(tree.index(5, 0).data().toString(), "Path 1 (5, 3)");
    EXPECT_TRUE(window.views().plots.front().widget->csv().contains("\n7,5,3,0,")) << "x, y, sample, part";
    EXPECT_EQ(window.views().history->list().model()->index(0, 0).data().toString(), "region 4x3 at (4, 3)");
    EXPECT_TRUE(window.views().outliers->summaryText().contains("of 48 paths"));
    // A filter takes paths of all of them, and a path's pixel is marked in the image.
    window.views().filter->setQueryText("luminance == max(luminance) or sample == 2");
    ASSERT_TRUE(waitFor([&] { return window.views().filter->isSettled(); }));
    window.views().filter->select();
    EXPECT_EQ(program.selection.state().paths.size(), 12u) << "sample 2 of each pixel";
    QTest::keyClick(&window, Qt::Key_BracketRight);
    EXPECT_EQ(program.selection.state().currentPath->pixel, (Pixel{4, 3}));
    QTest::keyClick(&window, Qt::Key_BracketRight);
    EXPECT_EQ(program.selection.state().currentPath->pixel, (Pixel{5, 3}));
    QTest::keyClick(&window, Qt::Key_Period);
    EXPECT_EQ(program.selection.state().vertex->path.pixel, (Pixel{5, 3}));
    // One step back at a time.
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_FALSE(program.selection.state().vertex);
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_TRUE(program.selection.state().paths.empty());
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_TRUE(program.selection.pixels().empty());
    EXPECT_TRUE(program.dataset.paths().empty());
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(program.selection.state().region.size(), 12u);
    EXPECT_EQ(program.dataset.paths().pathCount(), 48u) << "from the history";
}

TEST_F(RegionWindowTest, TheKeyRIsOfTheViewThatHasTheFocus) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    window.views().image->canvas().setFocus();
    QTest::keyClick(&window, Qt::Key_R);
    EXPECT_TRUE(window.views().image->regionTool().rectangleMode());
    EXPECT_TRUE(window.action("rectangle")->isChecked());
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_FALSE(window.views().image->regionTool().rectangleMode());
    EXPECT_FALSE(window.action("rectangle")->isChecked());
    QTest::keyClick(&window, Qt::Key_R);
    drag(program, {10, 10}, {11, 11}, {});
    EXPECT_EQ(program.selection.state().region.text(), "region 2x2 at (10, 10)");
    EXPECT_FALSE(window.action("rectangle")->isChecked());
    ASSERT_TRUE(shows(program, 16));
    QTest::mouseClick(&window.views().image->canvas(), Qt::LeftButton, Qt::ControlModifier, screen(program, {1, 1}));
    ASSERT_TRUE(shows(program, 20));
    QTest::mouseClick(&window.views().image->canvas(), Qt::LeftButton, {}, screen(program, {1, 1}));
    ASSERT_TRUE(shows(program, 4));
    EXPECT_EQ(program.selection.state().pixel, (Pixel{1, 1}));
}

TEST_F(RegionWindowTest, OnlyWhatTheFilterTakesComesFromTheRenderer) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    drag(program, {0, 0}, {23, 15}, Qt::ShiftModifier);
    ASSERT_TRUE(shows(program, 24 * 16 * 4));
    window.views().filter->setQueryText("sample == 2 and pixel.x >= 20");
    ASSERT_TRUE(waitFor([&] { return window.isSettled(); }));
    RegionPanel& panel = *window.views().region;
    window.showDock("region");
    QTest::qWait(20);
    auto* only = panel.findChild<QCheckBox*>();
    ASSERT_TRUE(only->isEnabled());
    QTest::mouseClick(only, Qt::LeftButton, {}, {8, only->height() / 2});
    ASSERT_TRUE(shows(program, 4 * 16));
    EXPECT_EQ(panel.pathsText(), "The filter takes 64 of 1,536 paths of 384 pixels. All replays are exact.");
    QTest::mouseClick(only, Qt::LeftButton, {}, {8, only->height() / 2});
    ASSERT_TRUE(shows(program, 24 * 16 * 4));
    EXPECT_EQ(program.dataset.traces().size(), 2u);
    // Both replies are in the history; the one with the query says so.
    const QString tip = window.views().history->list().model()->index(0, 0).data(Qt::ToolTipRole).toString();
    EXPECT_TRUE(tip.contains("64 of 1,536 paths")) << tip.toStdString();
}

TEST_F(RegionWindowTest, ManyPathsAreTracedWithAButton) {
    renderer.samplesPerPixel = 512;
    renderer.depth = 1;
    Program program(settingsFile());
    connectTo(program);
    drag(program, {0, 0}, {15, 15}, Qt::ShiftModifier);
    QTest::qWait(20);
    RegionPanel& panel = *program.window->views().region;
    EXPECT_TRUE(panel.warningText().startsWith("131,072 paths")) << panel.warningText().toStdString();
    EXPECT_TRUE(program.dataset.paths().empty());
    QPushButton* trace = nullptr;
    for (QPushButton* button : panel.findChildren<QPushButton*>())
        if (button->isVisible() && button->text() == "Trace 131,072 paths") trace = button;
    ASSERT_TRUE(trace);
    QTest::mouseClick(trace, Qt::LeftButton);
    ASSERT_TRUE(shows(program, 131072));
    EXPECT_EQ(panel.warningText(), "");
}

}  // namespace
}  // namespace emca::explorer
