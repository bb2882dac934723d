#include <gtest/gtest.h>

#include <QApplication>
#include <QTest>

#include <cmath>

#include "base/color_bar.h"
#include "base/theme.h"
#include "scene_view.h"
#include "surface_test_data.h"

// Colours of layers in the drawn picture, under Xvfb.
namespace emca::explorer::testing {
namespace {

const bool kPrepared = (prepareOpenGl(), true);

class SceneSurfaceTest : public ::testing::Test {
  protected:
    SceneSurfaceTest() : view_(dataset_, selection_, theme_) {
        SceneOptions options = view_.options();
        options.animate = options.edges = options.cameraGlyph = false;
        view_.setOptions(options);
        view_.resize(800, 600);
        view_.show();
        if (!hasOpenGl() || !QTest::qWaitForWindowExposed(&view_)) ADD_FAILURE() << "run this test under Xvfb";
        fillWall(dataset_);
        show("depth");
    }
    void show(const std::string& layer) {
        SurfaceStyle style = view_.surfaces().style();
        style.layer = layer;
        view_.surfaces().setStyle(style);
        qApp->processEvents();
    }
    QWidget& canvas() { return *view_.focusProxy(); }
    QPoint at(Vec3d place) {
        const auto s = Projection(view_.pose(), {canvas().width(), canvas().height()}).project(place);
        return {static_cast<int>(s->x), static_cast<int>(s->y)};
    }
    QColor drawn(Vec3d place) {
        qApp->processEvents();
        return view_.grab().toImage().pixelColor(at(place));
    }
    static int difference(const QColor& a, analysis::Color8 b) {
        return std::max({std::abs(a.red() - b.r), std::abs(a.green() - b.g), std::abs(a.blue() - b.b)});
    }
    // Middles of the refined faces 0 to 4.
    const Vec3d middle_[5] = {{-0.667, -1.333, 0}, {1.333, -1.333, 0}, {1.333, 0.667, 0}, {0.667, -0.667, 0}, {-0.667, 0.667, 0}};

    client::Dataset dataset_;
    client::Selection selection_;
    Theme theme_;
    SceneView view_;
};

TEST_F(SceneSurfaceTest, FacesHaveTheColoursOfTheBar) {
    for (const char* layer : {"depth", "hits", "albedo"}) {
        show(layer);
        const auto colors = view_.surfaces().colors();
        for (std::size_t f = 0; f < 5; ++f) EXPECT_LE(difference(drawn(middle_[f]), colors[f]), 2) << layer << " face " << f;
    }
    show("hits");
    const QColor linear = drawn(middle_[2]);
    view_.surfaces().setLog(true);
    EXPECT_NE(drawn(middle_[2]), linear);
    EXPECT_LE(difference(drawn(middle_[2]), view_.surfaces().colors()[2]), 2);
    // Borders between faces are sharp: two pixels beside the diagonal have the colours of their faces.
    show("depth");
    const QImage image = view_.grab().toImage();
    const QPoint diagonal = at({0.5, 0.5, 0});
    EXPECT_LE(difference(image.pixelColor(diagonal + QPoint(-2, -2)), view_.surfaces().colors()[4]), 2);
    EXPECT_LE(difference(image.pixelColor(diagonal + QPoint(2, 2)), view_.surfaces().colors()[2]), 2);
}

TEST_F(SceneSurfaceTest, ExposureBrightensColourLayers) {
    show("albedo");
    const QColor before = drawn(middle_[4]);
    SurfaceStyle style = view_.surfaces().style();
    style.exposure = 1;
    view_.surfaces().setStyle(style);
    const QColor after = drawn(middle_[4]);
    EXPECT_GT(after.red(), before.red() + 20);
    EXPECT_LE(difference(after, view_.surfaces().colors()[4]), 2);
    EXPECT_TRUE(view_.findChild<ColorBar*>()->isHidden()) << "colours explain themselves";
}

TEST_F(SceneSurfaceTest, TheBarStandsBesideThePictureWhileALayerIsShown) {
    auto* bar = view_.findChild<ColorBar*>();
    ASSERT_TRUE(bar);
    EXPECT_TRUE(bar->isVisible());
    EXPECT_FALSE(bar->geometry().intersects(canvas().geometry()));
    EXPECT_EQ(bar->content().title, "depth  [vertices]");
    show("");
    EXPECT_FALSE(bar->isVisible());
    EXPECT_EQ(canvas().width(), view_.width());
    const QImage plain = view_.grab().toImage();
    show("depth");
    EXPECT_NE(view_.grab().toImage(), plain);
    const QImage large = view_.renderImage({1600, 1200});
    ASSERT_EQ(large.size(), QSize(1600, 1200));
    const QPoint p = at(middle_[4]) * 2;
    EXPECT_LE(difference(large.pixelColor(p), view_.surfaces().colors()[4]), 2) << "pictures for files as well";
}

TEST_F(SceneSurfaceTest, MeshesWithoutDataAreGrey) {
    const QColor c = drawn({3.5, -0.4, -1});
    EXPECT_EQ(c.red(), c.green());
    EXPECT_EQ(c.green(), c.blue());
    EXPECT_GT(c.red(), 50);
}

TEST_F(SceneSurfaceTest, HoveringTellsTheValueOfTheField) {
    show("hits");
    const SurfaceField& field = *dataset_.surface();
    for (std::uint32_t f = 0; f < 5; ++f) {
        QTest::mouseMove(&canvas(), at(middle_[f]));
        ASSERT_TRUE(QTest::qWaitFor([&] { return view_.hoveredSurface() && view_.hoveredSurface()->refinedFace == f; }, 5000)) << f;
        EXPECT_EQ(view_.hoveredSurface()->channels[0], field.value(field.layers[1], 0, f));
        EXPECT_EQ(view_.findChild<ColorBar*>()->content().pointer, double(field.value(field.layers[1], 0, f)));
    }
    QTest::mouseMove(&canvas(), at({3.5, -0.4, -1}));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !view_.hoveredSurface(); }, 5000)) << "a mesh without data";
}

TEST_F(SceneSurfaceTest, TranslucentLayersLetPathsThroughAndZeroHidesThem) {
    const QColor opaque = drawn(middle_[4]);
    SurfaceStyle style = view_.surfaces().style();
    style.opacity = 0.3f;
    view_.surfaces().setStyle(style);
    const QColor through = drawn(middle_[4]);
    EXPECT_NE(through, opaque);
    style.opacity = 0;
    view_.surfaces().setStyle(style);
    EXPECT_GT(difference(drawn(middle_[4]), view_.surfaces().colors()[4]), 40);
}

}  // namespace
}  // namespace emca::explorer::testing
