#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QTest>

#include <cmath>
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

/// One of each kind that plugins can add.
void addObjects(SceneObjects& objects) {
    SceneObjects::Transaction transaction(objects);
    SceneObject boxes;
    boxes.name = "bounding boxes";
    boxes.shape = BoxSet{{ObjectBox::between({0.02f, -1, -0.15f}, {0.82f, -0.2f, 0.65f}), ObjectBox::between({-0.75f, -1, -0.66f}, {0, 0.2f, 0.06f})}};
    EXPECT_TRUE(objects.set({"test", "boxes"}, boxes));
    SceneObject arrows;
    arrows.name = "directions";
    ArrowSet set;
    for (int i = 0; i < 24; ++i) {
        const float a = 6.2832f * float(i) / 24;
        set.arrows.push_back({{0.42f, 0.25f, 0.25f}, {0.42f + 0.3f * std::cos(a), 0.25f + 0.3f * std::sin(a), 0.25f}});
        arrows.colors.values.push_back(0.5f + 0.5f * std::cos(a));
    }
    arrows.shape = set;
    arrows.colors.unit = "1/sr";
    EXPECT_TRUE(objects.set({"test", "arrows"}, arrows));
    SceneObject points;
    points.name = "light samples";
    PointSet dots;
    for (int i = 0; i < 300; ++i) dots.points.push_back({0.6f * float(i % 20) / 19 - 0.3f, 0.97f, 0.5f * float(i / 20) / 14 - 0.25f});
    points.shape = dots;
    points.colors.color = {255, 140, 60, 255};
    EXPECT_TRUE(objects.set({"test", "points"}, points));
    SceneObject grid;
    grid.name = "density";
    VoxelGrid cells{{-0.95f, -0.95f, -0.9f}, {0.06f, 0.06f, 0.06f}, {12, 12, 12}, 0.35, 10};
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) {
                const float dx = float(x) - 5.5f, dy = float(y) - 5.5f, dz = float(z) - 5.5f;
                grid.colors.values.push_back(std::exp(-(dx * dx + dy * dy + dz * dz) / 24));
            }
    grid.shape = cells;
    EXPECT_TRUE(objects.set({"test", "grid"}, grid));
}

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
    options.surfaceOpacity = 0.25f;
    options.colors.quantity = "v.depth";
    shots.view.setOptions(options);
    shots.selection.setPaths(some);
    shots.shoot("11_by_value");
    options.colors = {};
    options.clip.axis = ClipAxis::view;
    options.clip.position = 0.5f;
    options.surfaceOpacity = 1;
    pose = shots.view.pose();
    shots.view.setPose(orbited(pose, pose.focus, {0, 1, 0}, 2.4, -0.35));
    shots.view.setOptions(options);
    shots.selection.clearPaths();
    shots.shoot("12_clip");
    options.clip = {};
    options.surfaceOpacity = 0.25f;
    options.paths = PathChoice::selected;
    shots.view.setOptions(options);
    shots.view.resetCamera();
    addObjects(shots.view.objects());
    shots.shoot("13_objects");
    SceneOptionsPanel panel(shots.view, shots.theme);
    panel.resize(340, 1240);
    panel.show();
    if (const QString folder = QString::fromLocal8Bit(qgetenv("EMCA_PICTURES")); !folder.isEmpty())
        panel.grab().save(folder + (shots.theme.isDark() ? "/dark_panel.png" : "/light_panel.png"));
}

INSTANTIATE_TEST_SUITE_P(Themes, ScenePictures, ::testing::Values(ThemeKind::dark, ThemeKind::light));

}  // namespace
}  // namespace emca::explorer::testing
