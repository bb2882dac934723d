#include "image/image_view.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QToolButton>
#include <QWheelEvent>
#include <cmath>
#include <limits>

#include "base/theme.h"
#include "image/image_actions.h"
#include "image/image_canvas.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

client::ImageEntry entryOf(std::uint32_t width, std::uint32_t height, float level) {
    auto image = std::make_shared<RenderedImage>();
    image->color = Image(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image->color.setColor({x, y}, Color(level));
    client::ImageEntry entry;
    entry.title = "test";
    entry.image = image;
    return entry;
}

class ImageViewTest : public testing::Test {
  protected:
    ImageViewTest() {
        view.resize(640, 520);
        view.show();
        QApplication::setActiveWindow(&view);
        canvas().setFocus();
        QTest::qWait(1);
    }
    const ImageDisplay& display() { return view.model().display(); }
    ImageCanvas& canvas() { return view.canvas(); }
    /// Rounded down: at zoom 1 the centre of a pixel lies between two positions of the mouse.
    QPoint screen(Pixel pixel) {
        const QPointF centre = canvas().transform().rectOf(pixel).center();
        return {static_cast<int>(std::floor(centre.x())), static_cast<int>(std::floor(centre.y()))};
    }
    void wheel(QPointF at, int steps) {
        QWheelEvent event(at, canvas().mapToGlobal(at.toPoint()), {}, {0, 120 * steps}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(&canvas(), &event);
    }
    QColor shownAt(QPoint at) { return canvas().grab().toImage().pixelColor(at); }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ImageView view{dataset, selection, theme};
};

TEST_F(ImageViewTest, AClickSelectsThePixelUnderItAtEveryZoom) {
    dataset.addImage(entryOf(80, 60, 0.5f));
    for (const double zoom : {1.0, 2.5, 8.0, 30.0, 100.0}) {
        canvas().zoomTo(zoom);
        const auto pixel = canvas().transform().pixelAt(QPointF(canvas().width() / 2.0, canvas().height() / 2.0));
        ASSERT_TRUE(pixel);
        QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen(*pixel));
        EXPECT_EQ(selection.state().pixel, pixel) << "zoom " << zoom;
    }
}

TEST_F(ImageViewTest, AClickBesideTheImageSelectsNothing) {
    dataset.addImage(entryOf(10, 60, 0.5f));
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, {3, canvas().height() / 2});
    EXPECT_FALSE(selection.state().pixel);
}

TEST_F(ImageViewTest, TheWheelZoomsAtTheCursor) {
    dataset.addImage(entryOf(400, 300, 0.5f));
    const QPointF at = screen({321, 200});
    const QPointF before = canvas().transform().toImage(at);
    const double zoom = canvas().transform().zoom();
    wheel(at, 5);
    EXPECT_GT(canvas().transform().zoom(), 2.5 * zoom);
    EXPECT_NEAR(canvas().transform().toImage(at).x(), before.x(), 1e-6);
    EXPECT_EQ(canvas().hovered(), (Pixel{321, 200}));
    wheel(at, -5);
    EXPECT_NEAR(canvas().transform().zoom(), zoom, 1e-9);
}

TEST_F(ImageViewTest, DraggingWithCtrlPansAndSelectsNothing) {
    dataset.addImage(entryOf(100, 100, 0.5f));
    canvas().zoomTo(20);
    const QPointF before = canvas().transform().toWidget(QPointF(50, 50));
    QTest::mousePress(&canvas(), Qt::LeftButton, Qt::ControlModifier, {100, 100});
    QMouseEvent move(QEvent::MouseMove, QPointF(140, 70), canvas().mapToGlobal(QPoint(140, 70)), Qt::NoButton, Qt::LeftButton, Qt::ControlModifier);
    QCoreApplication::sendEvent(&canvas(), &move);
    QTest::mouseRelease(&canvas(), Qt::LeftButton, Qt::ControlModifier, {140, 70});
    EXPECT_EQ(canvas().transform().toWidget(QPointF(50, 50)) - before, QPointF(40, -30));
    EXPECT_FALSE(selection.state().pixel);
}

TEST_F(ImageViewTest, KeysZoomFitExposeAndMoveThePixel) {
    dataset.addImage(entryOf(100, 100, 0.5f));
    const double fitted = canvas().transform().zoom();
    QTest::keyClick(&canvas(), Qt::Key_1);
    EXPECT_DOUBLE_EQ(canvas().transform().zoom(), 1);
    QTest::keyClick(&canvas(), Qt::Key_Plus);
    EXPECT_DOUBLE_EQ(canvas().transform().zoom(), 1.25);
    QTest::keyClick(&canvas(), Qt::Key_0);
    EXPECT_DOUBLE_EQ(canvas().transform().zoom(), fitted);
    QTest::keyClick(&canvas(), Qt::Key_E);
    EXPECT_FLOAT_EQ(theme.toneMap().exposure, 0.5f);
    QTest::keyClick(&canvas(), Qt::Key_E, Qt::ShiftModifier);
    EXPECT_FLOAT_EQ(theme.toneMap().exposure, 0);
    selection.setPixel(Pixel{0, 99});
    for (const auto key : {Qt::Key_Right, Qt::Key_Right, Qt::Key_Up, Qt::Key_Left}) QTest::keyClick(&canvas(), key);
    EXPECT_EQ(selection.state().pixel, (Pixel{1, 98}));
    QTest::keyClick(&canvas(), Qt::Key_Left);
    QTest::keyClick(&canvas(), Qt::Key_Left);
    EXPECT_EQ(selection.state().pixel, (Pixel{0, 98})) << "stops at the border";
}

TEST_F(ImageViewTest, ExposureBrightensWhatIsPainted) {
    dataset.addImage(entryOf(20, 20, 0.1f));
    const QPoint at = screen({10, 10});
    const int before = shownAt(at).red();
    view.imageActions().changeExposure(2);
    // 0.1 * 2^2 = 0.4, sRGB: 1.055 * 0.4^(1/2.4) - 0.055 = 0.6652
    EXPECT_EQ(shownAt(at).red(), 170);
    EXPECT_LT(before, 100);
}

TEST_F(ImageViewTest, TheMarkerShowsOnAnyBackground) {
    for (const float level : {0.f, 0.18f, 0.5f, 1.f}) {
        dataset.addImage(entryOf(40, 40, level));
        canvas().fit();
        selection.setPixel(Pixel{20, 20});
        const QImage picture = canvas().grab().toImage();
        const int ground = shownAt(screen({5, 5})).lightness();
        const QRect around = canvas().transform().rectOf({20, 20}).toAlignedRect().adjusted(-6, -6, 6, 6);
        int strong = 0;
        for (int y = around.top(); y <= around.bottom(); ++y)
            for (int x = around.left(); x <= around.right(); ++x) strong += std::abs(picture.pixelColor(x, y).lightness() - ground) > 80;
        EXPECT_GT(strong, 40) << "level " << level;
    }
}

TEST_F(ImageViewTest, InvalidPixelsAreCountedMarkedAndVisited) {
    auto entry = entryOf(30, 20, 0.5f);
    auto image = std::make_shared<RenderedImage>(*entry.image);
    image->color.setColor({3, 4}, Color(std::numeric_limits<float>::quiet_NaN()));
    image->color.setColor({20, 11}, {1, std::numeric_limits<float>::infinity(), 1});
    image->color.setColor({7, 15}, {1, 1, -1});
    entry.image = image;
    dataset.addImage(entry);
    auto* badge = view.findChild<QToolButton*>("invalid");
    ASSERT_TRUE(badge);
    EXPECT_EQ(badge->text(), "1 NaN, 1 infinite, 1 negative");
    const QColor shown = shownAt(screen({3, 4}));
    EXPECT_EQ(shown, QColor(analysis::kNaNColor.r, analysis::kNaNColor.g, analysis::kNaNColor.b));
    for (const Pixel wanted : {Pixel{3, 4}, Pixel{20, 11}, Pixel{7, 15}, Pixel{3, 4}}) {
        view.goToNextInvalid();
        EXPECT_EQ(selection.state().pixel, wanted);
    }
}

TEST_F(ImageViewTest, EveryInvalidPixelIsVisitedHoweverManyThereAre) {
    auto entry = entryOf(60, 40, 0.5f);
    auto image = std::make_shared<RenderedImage>(*entry.image);
    for (std::uint32_t y = 0; y < 40; ++y)
        for (std::uint32_t x = 0; x < 50; ++x) image->color.setColor({x, y}, Color(std::numeric_limits<float>::quiet_NaN()));
    entry.image = image;
    dataset.addImage(entry);
    EXPECT_EQ(view.findChild<QToolButton*>("invalid")->text(), "2000 NaN");
    for (std::uint32_t i = 0; i <= 2000; ++i) {
        QTest::keyClick(&canvas(), Qt::Key_N);
        ASSERT_EQ(selection.state().pixel, (Pixel{i % 50, i / 50 % 40}));
    }
}

TEST_F(ImageViewTest, FalseColourFindsItsRangeAndPaintsTheMap) {
    auto entry = entryOf(100, 10, 0.f);
    auto image = std::make_shared<RenderedImage>(*entry.image);
    for (std::uint32_t y = 0; y < 10; ++y)
        for (std::uint32_t x = 0; x < 100; ++x) image->color.setColor({x, y}, Color(float(x)));
    entry.image = image;
    dataset.addImage(entry);
    QTest::keyClick(&canvas(), Qt::Key_C);
    const ImageStyle style = display().style();
    EXPECT_TRUE(style.falseColor);
    EXPECT_NEAR(style.range.min, 0.5, 0.6);
    EXPECT_NEAR(style.range.max, 98.5, 0.6);
    const auto expected = analysis::ColorMap::get(style.colorMap).map(50.0, style.range);
    EXPECT_EQ(shownAt(screen({50, 5})), QColor(expected.r, expected.g, expected.b));
    view.toggleLog();
    EXPECT_TRUE(display().style().range.log);
    EXPECT_TRUE(display().style().range.isValid());
}

TEST_F(ImageViewTest, AnotherImageOfTheSameSizeKeepsZoomAndPlace) {
    dataset.addImage(entryOf(100, 100, 0.5f));
    canvas().zoomTo(13);
    const QPointF place = canvas().transform().toImage({50, 50});
    dataset.addImage(entryOf(100, 100, 0.2f));
    EXPECT_DOUBLE_EQ(canvas().transform().zoom(), 13);
    EXPECT_EQ(canvas().transform().toImage({50, 50}), place);
    auto* list = view.findChild<QComboBox*>("images");
    ASSERT_TRUE(list);
    EXPECT_EQ(list->count(), 2);
    EXPECT_EQ(list->currentIndex(), 1);
}

TEST_F(ImageViewTest, PreviewPixelsAppearAsTheyArrive) {
    auto image = std::make_shared<RenderedImage>();
    image->color = Image(20, 20);
    client::ImageEntry entry;
    entry.image = image;
    entry.preview = true;
    dataset.addImage(entry);
    EXPECT_EQ(shownAt(screen({4, 4})), QColor(0, 0, 0));
    image->color.setColor({4, 4}, Color(1));
    dataset.pixelsChanged();
    EXPECT_EQ(shownAt(screen({4, 4})), QColor(255, 255, 255));
}

TEST_F(ImageViewTest, LargeImagesAreConvertedWhileTheWindowLives) {
    dataset.addImage(entryOf(2000, 1500, 0.5f));
    EXPECT_TRUE(waitFor([&] { return view.isSettled() && !view.pixels().picture().isNull(); }));
    EXPECT_EQ(view.pixels().picture().full().width(), 2000);
    EXPECT_EQ(shownAt(screen({1000, 700})).red(), 188);  // sRGB of 0.5
}

}  // namespace
}  // namespace emca::explorer
