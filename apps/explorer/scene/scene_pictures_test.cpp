#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QTest>

#include <cstdlib>

#include "base/path_ids.h"
#include "base/theme.h"
#include "scene_options_panel.h"
#include "scene_test_data.h"
#include "scene_view.h"

// Pictures of the 3D view in both themes, for looking at: written to the folder EMCA_PICTURES, if that is set. Without
// it the test checks that each picture is neither empty nor the same as the one before.
namespace emca::explorer::testing {
namespace {

const bool kPrepared = (prepareOpenGl(), true);

struct Shots {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    SceneView view;
    QImage last;

    explicit Shots(ThemeKind kind) : theme(kind), view(dataset, selection, theme) {
        theme.applyTo(*qApp);
        SceneOptions options = view.options();
        options.animate = false;
        view.setOptions(options);
        view.resize(1150, 700);
        view.show();
        if (!QTest::qWaitForWindowExposed(&view)) ADD_FAILURE() << "the window did not come up";
    }

    void shoot(const QString& name) {
        qApp->processEvents();
        const QImage image = view.grab().toImage();
        EXPECT_FALSE(image.isNull());
        EXPECT_NE(image, last) << name.toStdString();
        last = image;
        const QString folder = QString::fromLocal8Bit(qgetenv("EMCA_PICTURES"));
        if (folder.isEmpty()) return;
        QDir().mkpath(folder);
        EXPECT_TRUE(image.save(folder + "/" + (theme.isDark() ? "dark_" : "light_") + name + ".png"));
    }
};

class ScenePictures : public ::testing::TestWithParam<ThemeKind> {};

TEST_P(ScenePictures, tour) {
    ASSERT_TRUE(hasOpenGl()) << "run this test under Xvfb";
    Shots shots(GetParam());
    shots.shoot("00_empty");
    fillRoom(shots.dataset, {});
    shots.shoot("01_scene");
    const PathSet paths = roomPaths(256, 8);
    shots.dataset.addTrace(traceOf(paths));
    shots.shoot("02_all_paths");
    // The first path with at least four vertices and a light at its end.
    Index path = 0;
    while (path + 1 < paths.pathCount() && (paths.vertices(path).size() != 5 || isBlack(*paths.estimate(path)))) ++path;
    const Index vertex = paths.vertices(path).first + 2;
    shots.selection.setCurrentPath(pathId(paths, path));
    shots.shoot("03_path");
    shots.selection.setVertex(vertexId(paths, vertex));
    shots.shoot("04_vertex");
    shots.selection.setHovered(vertexId(paths, vertex + 1));
    ViewPose pose = shots.view.pose();
    pose = orbited(pose, pose.focus, {0, 1, 0}, 0.7, -0.35);
    shots.view.setPose(pose);
    shots.shoot("05_orbited");
    shots.view.focusSelection();
    shots.shoot("06_close_up");
    shots.view.resetCamera();
    pose = shots.view.pose();
    shots.view.setPose(zoomed(orbited(pose, pose.focus, {0, 1, 0}, 0.9, -0.4), {1150, 700}, 1.9, 575, 350));
    shots.shoot("08_far");
    shots.view.resetCamera();
    std::vector<client::PathId> some;
    for (Index p = 0; p < 12; ++p) some.push_back(pathId(paths, p));
    shots.selection.setPaths(some);
    shots.shoot("09_several");
    shots.selection.setVertex(vertexId(paths, vertex));
    SceneOptions options = shots.view.options();
    options.nextEvents = NextEventChoice::allPaths;
    shots.view.setOptions(options);
    shots.selection.clearPaths();
    shots.shoot("10_next_events");
    options.nextEvents = NextEventChoice::currentPath;
    shots.selection.setVertex(vertexId(paths, vertex));
    options.surfaceOpacity = 1;
    shots.view.setOptions(options);
    shots.shoot("07_opaque");
    SceneOptionsPanel panel(shots.view, shots.theme);
    panel.resize(320, 860);
    panel.show();
    if (const QString folder = QString::fromLocal8Bit(qgetenv("EMCA_PICTURES")); !folder.isEmpty())
        panel.grab().save(folder + (shots.theme.isDark() ? "/dark_panel.png" : "/light_panel.png"));
}

INSTANTIATE_TEST_SUITE_P(Themes, ScenePictures, ::testing::Values(ThemeKind::dark, ThemeKind::light));

}  // namespace
}  // namespace emca::explorer::testing
