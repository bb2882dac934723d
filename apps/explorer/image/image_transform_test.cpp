#include "image/image_transform.h"

#include <gtest/gtest.h>

namespace emca::explorer {
namespace {

ImageTransform transformOf(QSizeF image, QSizeF widget) {
    ImageTransform transform;
    transform.setImageSize(image);
    transform.setWidgetSize(widget);
    return transform;
}

TEST(ImageTransform, FitShowsTheWholeImageCentred) {
    const auto t = transformOf({100, 50}, {400, 400});
    EXPECT_DOUBLE_EQ(t.zoom(), 4);
    EXPECT_EQ(t.toWidget(QPointF(0, 0)), QPointF(0, 100));
    EXPECT_EQ(t.toWidget(QPointF(100, 50)), QPointF(400, 300));
}

TEST(ImageTransform, ZoomKeepsThePointUnderTheCursor) {
    auto t = transformOf({640, 480}, {500, 400});
    const QPointF cursor(217, 133);
    for (const double zoom : {0.3, 1.0, 2.7, 40.0, 250.0, 3.0}) {
        const QPointF before = t.toImage(cursor);
        t.zoomTo(zoom, cursor);
        EXPECT_NEAR(t.toImage(cursor).x(), before.x(), 1e-9);
        EXPECT_NEAR(t.toImage(cursor).y(), before.y(), 1e-9);
    }
}

TEST(ImageTransform, PixelAtIsTheInverseOfRectOf) {
    auto t = transformOf({64, 48}, {333, 251});
    for (const double zoom : {0.5, 1.0, 3.3, 20.0, 130.0}) {
        t.zoomTo(zoom, {100, 100});
        for (const Pixel pixel : {Pixel{0, 0}, Pixel{63, 47}, Pixel{17, 30}}) EXPECT_EQ(t.pixelAt(t.rectOf(pixel).center()), pixel) << zoom;
    }
}

TEST(ImageTransform, OutsideTheImageThereIsNoPixel) {
    auto t = transformOf({10, 10}, {200, 100});
    EXPECT_FALSE(t.pixelAt({1, 50}));
    EXPECT_FALSE(t.pixelAt(t.toWidget(QPointF(10, 5))));
    EXPECT_TRUE(t.pixelAt(t.toWidget(QPointF(9.999, 5))));
    EXPECT_FALSE(ImageTransform().pixelAt({0, 0}));
}

TEST(ImageTransform, PanNeverLosesTheImage) {
    auto t = transformOf({100, 100}, {300, 300});
    t.zoomTo(4, {150, 150});
    t.pan({1e6, -1e6});
    EXPECT_TRUE(QRectF(0, 0, 300, 300).intersects(t.toWidget(QRectF(0, 0, 100, 100))));
    t.pan({-1e7, 1e7});
    EXPECT_TRUE(QRectF(0, 0, 300, 300).intersects(t.toWidget(QRectF(0, 0, 100, 100))));
}

TEST(ImageTransform, ResizeKeepsAFitAndTheCentreOfAZoom) {
    auto t = transformOf({100, 100}, {300, 300});
    t.setWidgetSize({600, 600});
    EXPECT_DOUBLE_EQ(t.zoom(), 6);
    t.zoomTo(20, {300, 300});
    const QPointF centre = t.toImage({300, 300});
    t.setWidgetSize({500, 400});
    EXPECT_NEAR(t.toImage({250, 200}).x(), centre.x(), 1e-9);
    EXPECT_NEAR(t.toImage({250, 200}).y(), centre.y(), 1e-9);
}

}  // namespace
}  // namespace emca::explorer
