// What a selection makes the window draw, counted: one frame of the 3D view, each other widget at most once, no point
// of a plot again, no model from scratch. Time is measured by explorer_click_bench.
#include <QAbstractItemView>
#include <QAction>
#include <QElapsedTimer>
#include <QEvent>
#include <QPushButton>
#include <QSignalSpy>

#include <map>

#include "base/state_overlay.h"
#include "paths/path_tree.h"
#include "paths/path_tree_model.h"
#include "paths/vertex_table.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "testing/program.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

/// Counts the paint events of every widget.
class PaintCounter : public QObject {
  public:
    PaintCounter() { qApp->installEventFilter(this); }
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() == QEvent::Paint) ++counts[static_cast<QWidget*>(watched)];
        return false;
    }
    std::map<QWidget*, int> counts;
};

class SelectionUpdatesTest : public MainWindowTest {
  protected:
    SelectionUpdatesTest() {
        renderer.samplesPerPixel = 64;
        renderer.depth = 8;
    }
    /// With the paths of a pixel, one of them selected.
    void begin(Program& program, bool flights) {
        SceneOptions options = program.window->views().scene->options();
        options.flyToSelection = flights;
        program.window->views().scene->setOptions(options);
        connectTo(program);
        program.selection.setPixel(Pixel{7, 5});
        ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == 64; }));
        QTest::keyClick(program.window.get(), Qt::Key_BracketRight);
        QTest::keyClick(program.window.get(), Qt::Key_Period);
        settle(program);
    }
    static void settle(Program& program) {
        ASSERT_TRUE(waitFor([&] { return program.window->isSettled(); }));
        QTest::qWait(400);   // flights end, the full scene comes back, pending layouts are done
    }
    static std::uint64_t layers(Program& program) {
        std::uint64_t sum = 0;
        for (const Views::Plot& plot : program.window->views().plots)
            for (std::size_t i = 0; i < plot.widget->rowCount(); ++i) sum += plot.widget->row(i).drawnPointLayers();
        return sum;
    }
};

TEST_F(SelectionUpdatesTest, ASelectionDrawsOneFrameAndEachWidgetOnce) {
    Program program(settingsFile());
    begin(program, false);
    SceneView& scene = *program.window->views().scene;
    std::vector<std::unique_ptr<QSignalSpy>> resets;
    for (const auto* view : program.window->findChildren<QAbstractItemView*>())
        if (view->model()) resets.push_back(std::make_unique<QSignalSpy>(view->model(), &QAbstractItemModel::modelReset));
    ASSERT_GE(resets.size(), 3u);
    for (const Qt::Key key : {Qt::Key_BracketRight, Qt::Key_BracketRight, Qt::Key_Period, Qt::Key_Period, Qt::Key_Comma}) {
        const std::uint64_t frames = scene.frameCount(), drawn = layers(program);
        PaintCounter paints;
        QTest::keyClick(program.window.get(), key);
        settle(program);
        EXPECT_EQ(scene.frameCount() - frames, 1u) << "key " << key;
        EXPECT_EQ(layers(program), drawn) << "points of a plot were drawn again";
        EXPECT_GT(paints.counts.size(), 3u);
        for (const auto& [widget, count] : paints.counts)
            EXPECT_EQ(count, 1) << "key " << key << ": " << widget << " " << widget->metaObject()->className() << " in "
                                << (widget->parentWidget() ? widget->parentWidget()->metaObject()->className() : "");
    }
    for (const auto& spy : resets) EXPECT_EQ(spy->count(), 0);
}

TEST_F(SelectionUpdatesTest, TheFlightToAPathDrawsTheSceneAloneAndAfterwards) {
    Program program(settingsFile());
    begin(program, true);
    Views& views = program.window->views();
    // From far away the paths are small, so that each deserves a flight.
    ViewPose far = views.scene->pose();
    far.position = far.focus + (far.position - far.focus) * 12.0;
    views.scene->setPose(far);
    settle(program);
    const std::uint64_t frames = views.scene->frameCount();
    PaintCounter paints;
    QTest::keyClick(program.window.get(), Qt::Key_BracketRight);
    QCoreApplication::sendPostedEvents();
    EXPECT_EQ(views.scene->frameCount() - frames, 1u) << "one frame, and every view is up to date";
    const auto first = paints.counts;
    EXPECT_TRUE(views.scene->isMoving());
    settle(program);
    EXPECT_GT(views.scene->frameCount() - frames, 2u);
    EXPECT_FALSE(views.scene->pose() == far);
    for (const auto& [widget, count] : paints.counts) {
        // What the 3D view lies in is drawn below it with every frame.
        if (views.scene->isAncestorOf(widget) || widget->isAncestorOf(views.scene)) continue;
        const auto then = first.find(widget);
        EXPECT_EQ(count, then == first.end() ? 0 : then->second)
            << widget->metaObject()->className() << " in "
            << (widget->parentWidget() ? widget->parentWidget()->metaObject()->className() : "");
    }
}

TEST_F(SelectionUpdatesTest, TheFirstSelectionDimsThePointsOnce) {
    Program program(settingsFile());
    connectTo(program);
    program.selection.setPixel(Pixel{7, 5});
    ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == 64; }));
    settle(program);
    QTest::keyClick(program.window.get(), Qt::Key_BracketRight);
    settle(program);
    const std::uint64_t drawn = layers(program);
    for (int i = 0; i < 2; ++i) {   // none, one, none, one: both pictures of the points are there
        QTest::keyClick(program.window.get(), Qt::Key_Escape);
        settle(program);
        QTest::keyClick(program.window.get(), Qt::Key_BracketRight);
        settle(program);
    }
    EXPECT_EQ(layers(program), drawn);
}

TEST_F(SelectionUpdatesTest, ASceneThatDoesNotComeIsSaidWhereItIsMissing) {
    renderer.sceneFails = true;
    Program program(settingsFile());
    connectTo(program);
    SceneView& scene = *program.window->views().scene;
    StateOverlay* said = nullptr;
    for (StateOverlay* overlay : scene.findChildren<StateOverlay*>())
        if (overlay->isVisible()) said = overlay;
    ASSERT_TRUE(said);
    EXPECT_FALSE(said->sentence().isEmpty());
    renderer.sceneFails = false;
    QPushButton* again = nullptr;
    for (QPushButton* button : said->findChildren<QPushButton*>())
        if (button->isVisible()) again = button;
    ASSERT_TRUE(again);
    QTest::mouseClick(again, Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] { return program.dataset.meshes() != nullptr && program.window->isSettled(); }));
    EXPECT_FALSE(said->isVisible());
}

TEST_F(SelectionUpdatesTest, SurfacesHaveTheNamesOfTheScene) {
    Program program(settingsFile());
    begin(program, false);
    const PathTreeModel& model = program.window->views().paths->model();
    const QModelIndex vertex = model.vertexIndex(program.dataset.paths().vertices(0).first);
    QStringList values;
    for (int row = 0; row < model.rowCount(vertex); ++row)
        values << model.index(row, PathTreeModel::kValue, vertex).data(Qt::DisplayRole).toString();
    EXPECT_TRUE(values.contains("wall, face 0")) << values.join(" | ").toStdString();
}

}  // namespace
}  // namespace emca::explorer
