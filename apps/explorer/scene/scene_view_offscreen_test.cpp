#include <gtest/gtest.h>

#include <QLabel>

#include "base/path_ids.h"
#include "scene_options_panel.h"
#include "scene_test_data.h"
#include "scene_view.h"

namespace emca::explorer::testing {
namespace {

/// Runs on Qt's offscreen platform: without OpenGL the view says so, and everything else goes on.
TEST(SceneViewWithoutOpenGl, saysSoAndSurvivesEveryChange) {
    if (hasOpenGl()) GTEST_SKIP() << "this display has OpenGL";
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    SceneView view(dataset, selection, theme);
    SceneOptionsPanel panel(view, theme);
    view.resize(400, 300);
    view.show();
    bool said = false;
    for (const QLabel* label : view.findChildren<QLabel*>()) said |= label->text().contains("OpenGL");
    EXPECT_TRUE(said);

    fillRoom(dataset, roomPaths(5, 4));
    selection.setVertex(vertexId(dataset.paths(), 0));
    SceneOptions options = view.options();
    options.surfaceOpacity = 0.5f;
    options.orthographic = true;
    view.setOptions(options);
    view.focusSelection();
    view.resetCamera();
    view.back();
    view.setRectangleMode(true);
    theme.setKind(ThemeKind::light);
    EXPECT_TRUE(view.renderImage({100, 100}).isNull());
    const auto saved = view.saveImage("a.png", {100, 100});
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().code, ErrorCode::notSupported);
    dataset.clearScene();
}

}  // namespace
}  // namespace emca::explorer::testing
