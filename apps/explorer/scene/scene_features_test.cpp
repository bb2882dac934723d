#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTemporaryDir>

#include "base/color_bar.h"
#include "scene_options_panel.h"
#include "scene_view_for_tests.h"

// Colours by value, clipping plane, switches of rays, objects of plugins, pictures: real mouse and keys, drawn pictures.
namespace emca::explorer::testing {
namespace {

const bool kPrepared = (prepareOpenGl(), true);

using SceneFeatures = SceneViewTest;

/// Largest difference of any channel of any pixel.
int difference(const QImage& a, const QImage& b) {
    if (a.size() != b.size()) return 256;
    int most = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
            most = std::max({most, std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
        }
    return most;
}

TEST_F(SceneFeatures, ASelectionKeepsTheSurfacesAndTheirPicture) {
    fillRoom(dataset_, roomPaths(60, 5));
    for (const float opacity : {0.25f, 1.f}) {
        change([&](SceneOptions& o) { o.surfaceOpacity = opacity; });
        picture();
        QTest::qWait(400);   // a slow frame at the start may have brought the stand-ins; now everything is at rest
        picture();
        const std::uint64_t frames = view_.frameCount(), drawn = view_.surfaceFrameCount();
        selection_.setVertex(vertex(3, 1));
        picture();
        selection_.setVertex(vertex(5, 0));
        const QImage kept = picture();
        EXPECT_EQ(view_.frameCount() - frames, 2u);
        EXPECT_EQ(view_.surfaceFrameCount(), drawn) << "surfaces were drawn again for a selection";
        view_.requestFrame();
        const QImage anew = picture();
        EXPECT_EQ(view_.surfaceFrameCount(), drawn + 1);
        EXPECT_LE(difference(kept, anew), 1) << "copied depth and colour are those that were drawn, at opacity " << opacity;
        selection_.clearPaths();
    }
    // Another size, another theme: nothing old is shown.
    view_.resize(700, 500);
    const QImage smaller = picture();
    view_.requestFrame();
    EXPECT_LE(difference(smaller, picture()), 1);
}

TEST_F(SceneFeatures, PathsHaveTheColourOfTheirValueAndABarSaysWhich) {
    showHandMade();
    SceneOptionsPanel panel(view_, theme_);
    panel.show();
    change([](SceneOptions& o) { o.arrows = o.depthLabels = false; });
    auto* quantity = panel.findChild<QComboBox*>("pathQuantity");
    ASSERT_TRUE(quantity);
    EXPECT_GE(quantity->findText("v.depth"), 1);
    quantity->lineEdit()->selectAll();
    QTest::keyClicks(quantity->lineEdit(), "v.depth");
    QTest::keyClick(quantity->lineEdit(), Qt::Key_Return);
    EXPECT_EQ(view_.options().colors.quantity, "v.depth");
    selection_.setPaths({pathId(dataset_.paths(), 0)});
    const QImage image = picture();
    auto* bar = view_.findChild<ColorBar*>("pathBar");
    ASSERT_TRUE(bar && bar->isVisible());
    EXPECT_EQ(bar->content().title, "v.depth");
    // The segment into depth 2 has the colour of 2 within 1 to 3.
    const analysis::Color8 c = analysis::ColorMap::get(view_.options().colors.map).map(2.0, view_.pathColors().range());
    const QPoint a = at(vertex(0, 0)), b = at(vertex(0, 1));
    EXPECT_GT(count(image, {(a.x() + b.x()) / 2, (a.y() + b.y()) / 2}, 6, QColor(c.r, c.g, c.b), 60), 10);
    EXPECT_EQ(count(image, {(a.x() + b.x()) / 2, (a.y() + b.y()) / 2}, 6, theme_.colors().path, 20), 0);
    // Range by hand, and back.
    auto* maximum = panel.findChild<QLineEdit*>("pathMaximum");
    maximum->selectAll();
    QTest::keyClicks(maximum, "10");
    QTest::keyClick(maximum, Qt::Key_Return);
    EXPECT_EQ(view_.pathColors().range().max, 10);
    QTest::mouseClick(panel.findChild<QPushButton*>("pathAutomatic"), Qt::LeftButton);
    EXPECT_EQ(view_.pathColors().range().max, 3);
    // What is wrong is said, and the colours are those of the roles again.
    quantity->lineEdit()->selectAll();
    QTest::keyClicks(quantity->lineEdit(), "v.depth +");
    QTest::keyClick(quantity->lineEdit(), Qt::Key_Return);
    EXPECT_TRUE(panel.findChild<QLabel*>("pathComplaint")->isVisible());
    qApp->processEvents();
    EXPECT_FALSE(bar->isVisible());
    quantity->setCurrentIndex(0);
    emit quantity->activated(0);
    EXPECT_TRUE(view_.options().colors.quantity.empty());
}

TEST_F(SceneFeatures, TheClippingPlaneOpensARoom) {
    fillRoom(dataset_, {});
    change([](SceneOptions& o) { o.surfaceOpacity = 1; o.edges = o.cameraGlyph = o.lightGlyphs = o.axes = false; });
    view_.setPose(orbited(view_.pose(), {0, 0, 0}, {0, 1, 0}, 3.14159, 0));   // behind the back wall
    const QImage closed = picture();
    canvas().setFocus();
    QTest::keyClick(&canvas(), Qt::Key_X);   // along the view
    EXPECT_EQ(view_.options().clip.axis, ClipAxis::view);
    const QImage open = picture();
    EXPECT_GT(difference(closed.copy(400, 250, 100, 100), open.copy(400, 250, 100, 100)), 20);
    QTest::keyClick(&canvas(), Qt::Key_X);
    EXPECT_LE(difference(closed, picture()), 1);
    SceneOptionsPanel panel(view_, theme_);
    panel.findChild<QComboBox*>("clipAxis")->setCurrentIndex(3);
    panel.findChild<QSlider*>("clipPosition")->setValue(200);
    EXPECT_EQ(view_.options().clip.axis, ClipAxis::z);
    EXPECT_FLOAT_EQ(view_.options().clip.position, 1.f);
    // All of the room is cut away: only the ground is left, within its gradient.
    const QImage nothing = picture();
    EXPECT_EQ(nothing.pixel(450, 300), nothing.pixel(100, 300));
}

TEST_F(SceneFeatures, SwitchesOfOnePathAndVertexOutliveTheSelection) {
    showHandMade({{{-0.9f, 0.5f, 0}, 1}});
    change([](SceneOptions& o) { o.arrows = o.depthLabels = false; o.paths = PathChoice::selected; });
    SceneOptionsPanel panel(view_, theme_);
    auto* line = panel.findChild<QCheckBox*>("pathLine");
    auto* incoming = panel.findChild<QCheckBox*>("vertexIncoming");
    EXPECT_FALSE(line->isEnabled());
    selection_.setVertex(vertex(0, 1));
    ASSERT_TRUE(line->isEnabled() && line->isChecked() && incoming->isChecked());
    const QPoint a = at(vertex(0, 0)), b = at(vertex(0, 1)), c = at(vertex(0, 2));
    const QPoint into((a.x() + b.x()) / 2, (a.y() + b.y()) / 2), outOf((b.x() + c.x()) / 2, (b.y() + c.y()) / 2);
    const auto ink = [&](const QImage& image, QPoint where) { return count(image, where, 6, image.pixelColor(5, where.y()), 30) < 160; };
    EXPECT_TRUE(ink(picture(), into) && ink(picture(), outOf));
    QTest::mouseClick(incoming, Qt::LeftButton, {}, {8, incoming->height() / 2});
    EXPECT_FALSE(incoming->isChecked());
    EXPECT_FALSE(ink(picture(), into));
    EXPECT_TRUE(ink(picture(), outOf));
    selection_.clearPaths();
    EXPECT_TRUE(ink(picture(), outOf)) << "what has a switch of its own stays";
    QTest::mouseClick(panel.findChild<QPushButton*>("forgetRays"), Qt::LeftButton);
    EXPECT_FALSE(ink(picture(), outOf));
    selection_.setCurrentPath(pathId(dataset_.paths(), 0));
    auto* nextEvents = panel.findChild<QCheckBox*>("pathNextEvents");
    EXPECT_GT(count(picture(), {450, 300}, 600, theme_.colors().nextEventVisible), 200);
    QTest::mouseClick(nextEvents, Qt::LeftButton, {}, {8, nextEvents->height() / 2});
    EXPECT_LT(count(picture(), {450, 300}, 600, theme_.colors().nextEventVisible), 5);
    EXPECT_TRUE(ink(picture(), into)) << "the line stays";
}

TEST_F(SceneFeatures, ObjectsAreDrawnSwitchedHoveredAndPicked) {
    fillRoom(dataset_, {});
    change([](SceneOptions& o) { o.surfaceOpacity = 0.1f; o.edges = o.lightGlyphs = false; });
    SceneObject points;
    points.name = "samples";
    points.shape = PointSet{{{0, 0, 0}, {0.5f, 0.2f, 0}}, 14};
    points.colors.colors = {{250, 20, 240}, {20, 240, 250}};
    ASSERT_TRUE(view_.objects().set({"test", "points"}, points));
    SceneObject cells;
    cells.name = "cells";
    cells.shape = VoxelGrid{{-0.9f, -0.9f, 0}, {0.2f, 0.2f, 0.2f}, {2, 2, 1}};
    cells.colors.values = {0, 1, 2, 3};
    cells.colors.unit = "m";
    ASSERT_TRUE(view_.objects().set({"test", "cells"}, cells));
    SceneObject boxes;
    boxes.name = "boxes";
    boxes.shape = BoxSet{{ObjectBox::between({0.3f, -0.8f, -0.2f}, {0.8f, -0.3f, 0.2f})}, 2, 0};
    boxes.colors.color = {10, 250, 10, 255};
    ASSERT_TRUE(view_.objects().set({"test", "boxes"}, boxes));
    const auto screen = [&](Vec3d p) {
        const auto s = Projection(view_.pose(), {canvas().width(), canvas().height()}).project(p);
        return QPoint(int(std::lround(s->x)), int(std::lround(s->y)));
    };
    QImage image = picture();
    EXPECT_GT(count(image, screen({0, 0, 0}), 8, QColor(250, 20, 240)), 80);
    EXPECT_GT(count(image, screen({0.5, 0.2, 0}), 8, QColor(20, 240, 250)), 80);
    EXPECT_GT(count(image, screen({0.55, -0.8, 0.2}), 8, QColor(10, 250, 10), 80), 8);
    // A switch in the panel.
    SceneOptionsPanel panel(view_, theme_);
    panel.resize(360, 1400);
    panel.show();
    auto* box = panel.findChild<QCheckBox*>("object test/points");
    ASSERT_TRUE(box && box->isChecked());
    QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
    EXPECT_LT(count(picture(), screen({0, 0, 0}), 8, QColor(250, 20, 240)), 5);
    QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
    // A click is told to the plugin.
    std::vector<std::pair<std::string, std::size_t>> picks;
    view_.objects().listenPicks([&](const ObjectId& id, std::size_t element) { picks.emplace_back(id.id, element); });
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen({0.5, 0.2, 0}));
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen({-0.6, -0.6, 0.2}));
    ASSERT_EQ(picks.size(), 2u);
    EXPECT_EQ(picks[0], (std::pair<std::string, std::size_t>("points", 1)));
    EXPECT_EQ(picks[1], (std::pair<std::string, std::size_t>("cells", 3)));
    // Hovering changes the picture: a card with words.
    QTest::mouseMove(&canvas(), QPoint(30, 30));
    image = picture();
    QTest::mouseMove(&canvas(), screen({0.5, 0.2, 0}));
    EXPECT_TRUE(QTest::qWaitFor([&] { return difference(image, picture()) > 40; }, 5000));
    view_.objects().removeAll("test");
    EXPECT_FALSE(panel.findChild<QCheckBox*>("object test/points") && panel.findChild<QCheckBox*>("object test/points")->isVisible());
    EXPECT_LT(count(picture(), screen({0.5, 0.2, 0}), 8, QColor(20, 240, 250)), 5);
}

TEST_F(SceneFeatures, KeysFlyTurnTheProjectionAndSaveAPicture) {
    fillRoom(dataset_, roomPaths(5, 5));
    SceneOptionsPanel panel(view_, theme_);
    canvas().setFocus();
    const ViewPose home = view_.pose();
    for (const Qt::Key key : {Qt::Key_W, Qt::Key_A, Qt::Key_S, Qt::Key_D, Qt::Key_Q, Qt::Key_E}) {
        QTest::keyClick(&canvas(), key);
        EXPECT_NE(view_.pose().position, home.position) << key;
        QTest::keyClick(&canvas(), Qt::Key_Backspace);
        EXPECT_EQ(view_.pose(), home);
    }
    QTest::keyClick(&canvas(), Qt::Key_O);
    EXPECT_TRUE(view_.options().orthographic && view_.pose().orthographic);
    QTest::keyClick(&canvas(), Qt::Key_O);
    EXPECT_FALSE(view_.options().orthographic);
    QTest::keyClick(&canvas(), Qt::Key_P);
    QFileDialog* dialog = nullptr;
    ASSERT_TRUE(QTest::qWaitFor([&] { return (dialog = view_.window()->findChild<QFileDialog*>("pictureDialog")) && dialog->isVisible(); }, 5000));
    QTemporaryDir folder;
    auto* name = dialog->findChild<QLineEdit*>();
    ASSERT_TRUE(name);
    name->setText(folder.filePath("view.png"));
    QTest::keyClick(name, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(folder.filePath("view.png")); }, 5000));
    EXPECT_EQ(QImage(folder.filePath("view.png")).size(), QSize(1920, 1080));
    EXPECT_TRUE(panel.findChild<QLabel*>("pictureAnswer")->text().contains("view.png"));
}

}  // namespace
}  // namespace emca::explorer::testing
