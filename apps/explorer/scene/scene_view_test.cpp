#include "scene_view.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>

#include <cmath>
#include <limits>
#include <set>

#include "scene_options_panel.h"
#include "scene_view_for_tests.h"

namespace emca::explorer::testing {
namespace {

const bool kPrepared = (prepareOpenGl(), true);

TEST_F(SceneViewTest, emptyStateOffersToConnect) {
    int asked = 0;
    QObject::connect(&view_, &SceneView::connectRequested, [&] { ++asked; });
    const auto buttons = view_.findChildren<QAbstractButton*>();
    for (QAbstractButton* button : buttons)
        if (button->isVisible()) button->click();
    EXPECT_EQ(asked, 1);
}

TEST_F(SceneViewTest, selectedVertexIsOrangeWhereItIsProjected) {
    fillRoom(dataset_, roomPaths(40, 6));
    const auto id = vertex(0, 0);
    EXPECT_LT(count(picture(), at(id), 6, theme_.colors().selected), 3);
    selection_.setVertex(id);
    EXPECT_GT(count(picture(), at(id), 6, theme_.colors().selected), 60);   // a disc of 14 pixels has 154
}

/// The width of a line is counted across it: about 3.5 pixels for a selected path, 10.5 at three times the width.
TEST_F(SceneViewTest, linesAreAsWideAsTheySay) {
    showHandMade();
    change([](SceneOptions& o) { o.arrows = o.depthLabels = false; });
    selection_.setCurrentPath(pathId(dataset_.paths(), 0));
    for (const float width : {1.f, 2.f, 6.f}) {
        change([&](SceneOptions& o) { o.lineWidth = width; });
        const QImage image = picture();
        const QPoint a = at(vertex(0, 0)), b = at(vertex(0, 1));
        const int y = (a.y() + b.y()) / 2;
        double sum = 0;   // in units of the line's own brightness, which the depth cue has lowered a little
        const double ground = image.pixelColor(a.x() + 60, y).lightnessF();
        double ink = ground;
        for (int x = a.x() - 25; x <= a.x() + 25; ++x) ink = std::max(ink, image.pixelColor(x, y).lightnessF());
        EXPECT_GT(ink, ground + 0.5);
        for (int x = a.x() - 25; x <= a.x() + 25; ++x)
            sum += std::max(0.0, (image.pixelColor(x, y).lightnessF() - ground) / (ink - ground));
        EXPECT_NEAR(sum, 1.75 * double(width), 0.5) << width;
    }
}

/// Anti-aliasing: across a slanted line lie pixels of many shades between ground and ink.
TEST_F(SceneViewTest, linesAreSmooth) {
    dataset_.setCamera(roomCamera());
    dataset_.addTrace(traceOf(pathOf({-0.9f, -0.6f, 0}, {{0.9f, 0.33f, 0}})));
    change([](SceneOptions& o) { o.arrows = o.depthLabels = false; });
    selection_.setCurrentPath(pathId(dataset_.paths(), 0));
    const QImage image = picture();
    std::set<int> shades;
    for (int y = 150; y < 450; ++y)
        for (int x = 250; x < 650; ++x) shades.insert(image.pixelColor(x, y).lightness());
    EXPECT_GT(shades.size(), 40u);
}

TEST_F(SceneViewTest, visibleNextEventsAreBlueOccludedOnesRedAndDashed) {
    showHandMade({{{-0.9f, 0.5f, 0}, 1}, {{0.9f, -0.3f, 0}, 0}});
    change([](SceneOptions& o) { o.arrows = o.depthLabels = false; });
    EXPECT_EQ(count(picture(), {450, 300}, 600, theme_.colors().nextEventOccluded), 0);
    selection_.setCurrentPath(pathId(dataset_.paths(), 0));
    const QImage image = picture();
    const int blue = count(image, {450, 300}, 600, theme_.colors().nextEventVisible);
    const int red = count(image, {450, 300}, 600, theme_.colors().nextEventOccluded);
    EXPECT_GT(blue, 200);
    EXPECT_GT(red, 80);
    // Along the occluded ray colour comes and goes, along the visible one it stays.
    const auto changes = [&](Vec3f end, const QColor& color) {
        const Projection p(view_.pose(), {900, 600});
        const auto a = *p.project(Vec3f{0, -0.8f, 0}), b = *p.project(end);
        int n = 0;
        bool before = true;
        for (int i = 15; i < 85; ++i) {
            const QPoint q(int(std::lround(a.x + (b.x - a.x) * i / 100)), int(std::lround(a.y + (b.y - a.y) * i / 100)));
            const bool now = count(image, q, 1, color, 70) > 0;
            n += now != before;
            before = now;
        }
        return n;
    };
    EXPECT_GE(changes({0.9f, -0.3f, 0}, theme_.colors().nextEventOccluded), 6);
    EXPECT_LE(changes({-0.9f, 0.5f, 0}, theme_.colors().nextEventVisible), 1);
    change([](SceneOptions& o) { o.nextEvents = NextEventChoice::none; });
    EXPECT_LT(count(picture(), {450, 300}, 600, theme_.colors().nextEventVisible), 5);
}

TEST_F(SceneViewTest, segmentIntoTheSelectedVertexIsGreen) {
    showHandMade();
    selection_.setVertex(vertex(0, 1));
    const QImage image = picture();
    const QPoint a = at(vertex(0, 0)), b = at(vertex(0, 1)), c = at(vertex(0, 2));
    EXPECT_GT(count(image, {a.x(), (2 * a.y() + b.y()) / 3}, 8, theme_.colors().currentSegment), 20);
    EXPECT_EQ(count(image, {(b.x() + c.x()) / 2 + 40, b.y()}, 8, theme_.colors().currentSegment), 0);
}

TEST_F(SceneViewTest, whatIsNotSelectedDims) {
    fillRoom(dataset_, roomPaths(100, 6));
    change([](SceneOptions& o) {
        o.nextEvents = NextEventChoice::none;
        o.surfaceOpacity = 0;
        o.edges = false;
        o.depthLabels = false;
    });
    const auto brightness = [&](const QImage& image) {
        double sum = 0;
        for (int y = 0; y < image.height(); y += 2)
            for (int x = 0; x < image.width(); x += 2) sum += image.pixelColor(x, y).lightnessF();
        return sum;
    };
    const double all = brightness(picture());
    change([](SceneOptions& o) { o.paths = PathChoice::none; });
    const double none = brightness(picture());
    change([](SceneOptions& o) { o.paths = PathChoice::all; });
    selection_.setCurrentPath(pathId(dataset_.paths(), 3));
    const double one = brightness(picture());
    EXPECT_GT(all - none, 2.5 * (one - none));
    EXPECT_GT(one, none);
}

TEST_F(SceneViewTest, clickSelectsCtrlAddsAndEmptyKeeps) {
    fillRoom(dataset_, roomPaths(3, 5));
    change([](SceneOptions& o) { o.surfaceOpacity = 0.1f; });
    const auto first = vertex(0, 1), second = vertex(1, 1);
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, at(first));
    ASSERT_TRUE(selection_.state().vertex);
    EXPECT_EQ(*selection_.state().vertex, first);
    EXPECT_EQ(selection_.state().paths.size(), 1u);
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ControlModifier, at(second));
    EXPECT_EQ(selection_.state().paths.size(), 2u);
    EXPECT_EQ(selection_.state().vertex, second);
    const auto before = selection_.state();
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, QPoint(3, 3));
    EXPECT_EQ(selection_.state(), before);
}

TEST_F(SceneViewTest, clickOnALineSelectsThePathWithoutAVertex) {
    showHandMade();
    const QPoint a = at(vertex(0, 0)), b = at(vertex(0, 1));
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, QPoint(a.x() + 2, (a.y() + b.y()) / 2));
    EXPECT_EQ(selection_.state().currentPath, pathId(dataset_.paths(), 0));
    EXPECT_FALSE(selection_.state().vertex);
}

TEST_F(SceneViewTest, hoverMarksTheVertexAndLeavingClearsIt) {
    showHandMade();
    const auto id = vertex(0, 1);
    QTest::mouseMove(&canvas(), at(id) + QPoint(2, 1));
    ASSERT_TRUE(QTest::qWaitFor([&] { return selection_.hovered().has_value(); }));
    EXPECT_EQ(*selection_.hovered(), id);
    EXPECT_GT(count(picture(), at(id), 14, theme_.colors().hover), 20);
    QTest::mouseMove(&canvas(), QPoint(20, 20));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !selection_.hovered(); }));
}

TEST_F(SceneViewTest, rectangleByKeySelectsPathsOnce) {
    fillRoom(dataset_, roomPaths(20, 5));
    canvas().setFocus();
    int changes = 0;
    const auto id = selection_.listen([&](std::uint32_t parts) { changes += (parts & client::SelectionPart::paths) != 0; });
    QTest::keyClick(&canvas(), Qt::Key_R);
    QTest::mousePress(&canvas(), Qt::LeftButton, {}, QPoint(2, 2));
    QTest::mouseMove(&canvas(), QPoint(400, 300));
    QTest::mouseMove(&canvas(), QPoint(897, 597));
    QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, QPoint(897, 597));
    EXPECT_EQ(selection_.state().paths.size(), 20u);
    EXPECT_EQ(changes, 1);
    const ViewPose pose = view_.pose();
    QTest::mousePress(&canvas(), Qt::LeftButton, {}, QPoint(200, 200));   // the mode ended: this orbits
    QTest::mouseMove(&canvas(), QPoint(230, 210));
    QTest::mouseMove(&canvas(), QPoint(260, 220));
    QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, QPoint(260, 220));
    EXPECT_NE(view_.pose(), pose);
    selection_.unlisten(id);
}

TEST_F(SceneViewTest, dragsWheelAndKeysMoveAndBackReturns) {
    fillRoom(dataset_, roomPaths(5, 5));
    canvas().setFocus();
    const ViewPose home = view_.pose();
    const auto drag = [&](Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
        QTest::mousePress(&canvas(), button, modifiers, QPoint(300, 300));
        for (const QPoint p : {QPoint(320, 310), QPoint(360, 330)}) {
            QMouseEvent move(QEvent::MouseMove, p, canvas().mapToGlobal(p), Qt::NoButton, button, modifiers);
            qApp->sendEvent(&canvas(), &move);
        }
        QTest::mouseRelease(&canvas(), button, modifiers, QPoint(360, 330));
    };
    const auto expectBack = [&](const char* what) {
        EXPECT_NE(view_.pose(), home) << what;
        QTest::keyClick(&canvas(), Qt::Key_Backspace);
        EXPECT_EQ(view_.pose(), home) << what;
    };
    drag(Qt::LeftButton, {});
    EXPECT_NEAR(view_.pose().distance(), home.distance(), 1e-9);
    expectBack("orbit");
    drag(Qt::LeftButton, Qt::ShiftModifier);
    EXPECT_NEAR(length(view_.pose().direction() - home.direction()), 0, 1e-9);
    expectBack("shift pans");
    drag(Qt::MiddleButton, {});
    expectBack("middle pans");
    drag(Qt::RightButton, {});
    EXPECT_LT(std::abs(dot(view_.pose().direction(), home.direction()) - 1), 1e-9);
    expectBack("right zooms");
    QTest::keyClick(&canvas(), Qt::Key_Up);
    EXPECT_GT(dot(view_.pose().position - home.position, home.direction()), 0);
    expectBack("fly");
    QWheelEvent wheel(QPointF(300, 200), canvas().mapToGlobal(QPoint(300, 200)), {}, QPoint(0, 120), Qt::NoButton, {}, Qt::NoScrollPhase, false);
    qApp->sendEvent(&canvas(), &wheel);
    EXPECT_LT(view_.pose().distance(), home.distance());
    expectBack("wheel");
    QTest::keyClick(&canvas(), Qt::Key_Up);
    QTest::keyClick(&canvas(), Qt::Key_Home);
    EXPECT_EQ(view_.pose(), home);
    EXPECT_EQ(home.position, (Vec3d{0, 0, double(roomCamera().position.z)}));
}

TEST_F(SceneViewTest, flightsBringTheWholePathIntoViewAndTakeTheirTime) {
    fillRoom(dataset_, roomPaths(5, 6));
    change([](SceneOptions& o) { o.flyToSelection = o.animate = true; });
    view_.setPose(flown(view_.pose(), 3.2, 0.8, 0));   // deep inside: most of the path is out of view
    const ViewPose before = view_.pose();
    selection_.setVertex(vertex(2, 1));
    EXPECT_TRUE(view_.isMoving());
    EXPECT_NE(view_.pose(), before);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !view_.isMoving(); }, 5000));
    const PathSet& paths = dataset_.paths();
    for (Index v = paths.vertices(2).first; v < paths.vertices(2).last; ++v) {
        const auto p = view_.screenPosition(vertexId(paths, v));
        ASSERT_TRUE(p);
        EXPECT_TRUE(QRectF(0, 0, 900, 600).contains(*p)) << p->x() << " " << p->y();
    }
    const ViewPose there = view_.pose();
    selection_.setVertex(vertex(2, 0));   // all visible already: nothing shakes
    EXPECT_EQ(view_.pose(), there);
    view_.back();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !view_.isMoving(); }, 5000));
    EXPECT_EQ(view_.pose(), before);
}

TEST_F(SceneViewTest, brokenPositionsDoNotBreakTheView) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    fillRoom(dataset_, {});
    const QImage before = picture();
    dataset_.addTrace(traceOf(pathOf({0, 0, 4.4f}, {{0, -0.5f, 0}, {kNaN, 0, 0}, {INFINITY, 0, 0}, {1e30f, 1, 1}, {0.5f, 0.5f, 0}})));
    for (Index v = 0; v < 5; ++v) {
        selection_.setVertex(vertex(0, v));
        view_.focusSelection();
        EXPECT_TRUE(std::isfinite(view_.pose().position.x));
        EXPECT_TRUE(std::isfinite(view_.pose().distance()));
    }
    view_.resetCamera();
    EXPECT_NE(picture(), before);
    EXPECT_FALSE(view_.screenPosition(vertex(0, 1)));
}

TEST_F(SceneViewTest, reconnectingReplacesTheScene) {
    fillRoom(dataset_, roomPaths(5, 5));
    selection_.setVertex(vertex(0, 0));
    dataset_.clearScene();
    const QImage empty = picture();
    fillRoom(dataset_, {});
    const QImage once = picture();
    EXPECT_NE(once, empty);
    fillRoom(dataset_, {});   // meshes must not pile up: a second copy would be twice as opaque
    EXPECT_EQ(picture(), once);
}

TEST_F(SceneViewTest, hiddenBackFacesShowTheRoomFromBehind) {
    fillRoom(dataset_, {});
    change([](SceneOptions& o) { o.surfaceOpacity = 1; o.edges = false; o.cameraGlyph = false; });
    view_.setPose(orbited(view_.pose(), {0, 0, 0}, {0, 1, 0}, 3.14159, 0));   // behind the back wall
    const QColor wall = picture().pixelColor(450, 200);
    change([](SceneOptions& o) { o.backFaces = BackFaces::hide; });
    const QImage inside = picture();
    EXPECT_NE(inside.pixelColor(450, 200), wall);
}

TEST_F(SceneViewTest, picturesOfAnySize) {
    fillRoom(dataset_, roomPaths(20, 5));
    selection_.setVertex(vertex(0, 0));
    picture();
    const QImage large = view_.renderImage({1800, 1200});
    EXPECT_EQ(large.size(), QSize(1800, 1200));
    // Twice the size: the same vertex at twice its place, four times the pixels.
    EXPECT_GT(count(large, 2 * at(vertex(0, 0)), 12, theme_.colors().selected), 300);
    QTemporaryDir folder;
    EXPECT_TRUE(view_.saveImage(folder.filePath("a.png"), {640, 360}));
    EXPECT_EQ(QImage(folder.filePath("a.png")).size(), QSize(640, 360));
    const auto failed = view_.saveImage("/nowhere/a.png", {64, 64});
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::fileUnwritable);
    EXPECT_FALSE(view_.saveImage(folder.filePath("b.png"), {0, 64}));
    // The window's own picture is as before.
    EXPECT_GT(count(picture(), at(vertex(0, 0)), 6, theme_.colors().selected), 60);
}

TEST_F(SceneViewTest, panelAndViewFollowEachOther) {
    SceneOptionsPanel panel(view_, theme_);
    auto* slider = panel.findChild<QSlider*>("Opacity");
    ASSERT_TRUE(slider);
    EXPECT_EQ(slider->value(), 25);
    slider->setValue(80);
    EXPECT_FLOAT_EQ(view_.options().surfaceOpacity, 0.8f);
    change([](SceneOptions& o) { o.surfaceOpacity = 0.1f; });
    EXPECT_EQ(slider->value(), 10);
    EXPECT_FLOAT_EQ(view_.options().surfaceOpacity, 0.1f);   // reading the options does not write them
}

TEST_F(SceneViewTest, themeChangesEverything) {
    fillRoom(dataset_, roomPaths(20, 5));
    const QColor dark = picture().pixelColor(5, 5);
    theme_.setKind(ThemeKind::light);
    const QColor light = picture().pixelColor(5, 5);
    EXPECT_LT(dark.lightness(), 80);
    EXPECT_GT(light.lightness(), 180);
}

}  // namespace
}  // namespace emca::explorer::testing
