#include "image/region_tool.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <cmath>

#include "base/theme.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

class RegionToolTest : public testing::Test {
  protected:
    RegionToolTest() {
        auto image = std::make_shared<RenderedImage>();
        image->color = Image(40, 30);
        client::ImageEntry entry;
        entry.image = image;
        dataset.addImage(entry);
        view.resize(700, 560);
        view.show();
        QTest::qWait(1);
    }
    ImageCanvas& canvas() { return view.canvas(); }
    RegionTool& tool() { return view.regionTool(); }
    QPoint screen(Pixel pixel) {
        const QPointF centre = canvas().transform().rectOf(pixel).center();
        return {static_cast<int>(std::floor(centre.x())), static_cast<int>(std::floor(centre.y()))};
    }
    void move(QPoint to, Qt::KeyboardModifiers modifiers = {}) {
        QMouseEvent event(QEvent::MouseMove, QPointF(to), canvas().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, modifiers);
        QCoreApplication::sendEvent(&canvas(), &event);
    }
    void drag(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers) {
        QTest::mousePress(&canvas(), Qt::LeftButton, modifiers, from);
        move(to, modifiers);
        QTest::mouseRelease(&canvas(), Qt::LeftButton, modifiers, to);
    }
    client::PixelRegion region() const { return selection.state().region; }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ImageView view{dataset, selection, theme};
};

TEST_F(RegionToolTest, ShiftAndADragSelectARectangleFromAnyCorner) {
    QSignalSpy chosen(&tool(), &RegionTool::chosen);
    const client::PixelRegion expected(PixelRect{12, 10, 20, 18});
    const Pixel corners[] = {{12, 10}, {19, 10}, {19, 17}, {12, 17}};
    for (int i = 0; i < 4; ++i) {
        selection.setPixel(Pixel{1, 1});
        drag(screen(corners[i]), screen(corners[(i + 2) % 4]), Qt::ShiftModifier);
        EXPECT_EQ(region(), expected) << i;
        EXPECT_FALSE(selection.state().pixel);
    }
    EXPECT_EQ(chosen.count(), 4);
    EXPECT_EQ(region().text(), "region 8x8 at (12, 10)");
}

TEST_F(RegionToolTest, RectangleModeEndsWithItsRectangle) {
    QSignalSpy mode(&tool(), &RegionTool::rectangleModeChanged);
    tool().setRectangleMode(true);
    drag(screen({3, 4}), screen({5, 6}), {});
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{3, 4, 6, 7}));
    EXPECT_FALSE(tool().rectangleMode());
    EXPECT_EQ(mode.count(), 2);
    drag(screen({8, 8}), screen({20, 20}), {});
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{3, 4, 6, 7})) << "no longer in the mode, a drag selects nothing";
}

TEST_F(RegionToolTest, ADragBeyondTheBorderEndsAtIt) {
    canvas().zoomTo(4);
    const QPoint corner = canvas().transform().toWidget(QPointF(35.5, 26.5)).toPoint();
    drag(corner, corner + QPoint(300, 300), Qt::ShiftModifier);
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{35, 26, 40, 30}));
    const client::PixelRegion before = region();
    const QPoint outside = canvas().transform().toWidget(QPointF(-30, -30)).toPoint();
    drag(outside, outside + QPoint(20, 20), Qt::ShiftModifier);
    EXPECT_EQ(region(), before) << "beside the image there is nothing";
}

TEST_F(RegionToolTest, CtrlAndClicksAddAndTakeAwaySinglePixels) {
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen({4, 4}));
    EXPECT_EQ(selection.state().pixel, (Pixel{4, 4}));
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ControlModifier, screen({9, 4}));
    EXPECT_EQ(region(), client::PixelRegion(std::vector<Pixel>{{4, 4}, {9, 4}}));
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ControlModifier, screen({20, 21}));
    EXPECT_EQ(region().size(), 3u);
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ControlModifier, screen({9, 4}));
    EXPECT_EQ(region(), client::PixelRegion(std::vector<Pixel>{{4, 4}, {20, 21}}));
    drag(screen({10, 10}), screen({11, 11}), Qt::ShiftModifier | Qt::ControlModifier);
    EXPECT_EQ(region().size(), 6u);
    const client::PixelRegion before = region();
    drag(screen({10, 10}), screen({20, 15}), Qt::ControlModifier);
    EXPECT_EQ(region(), before) << "a drag with Ctrl pans";
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen({5, 5}));
    EXPECT_TRUE(region().empty()) << "a click is about one pixel";
}

TEST_F(RegionToolTest, ShiftClicksAndShiftArrowsGoOnFromThePixel) {
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, screen({10, 10}));
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ShiftModifier, screen({6, 12}));
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{6, 10, 11, 13}));
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ShiftModifier, screen({12, 12}));
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{10, 10, 13, 13})) << "from the same corner";
    selection.setPixel(Pixel{38, 1});
    for (int i = 0; i < 4; ++i) QTest::keyClick(&canvas(), Qt::Key_Right, Qt::ShiftModifier);
    QTest::keyClick(&canvas(), Qt::Key_Up, Qt::ShiftModifier);
    QTest::keyClick(&canvas(), Qt::Key_Up, Qt::ShiftModifier);
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{38, 0, 40, 2})) << "stops at the border";
    for (int i = 0; i < 2; ++i) QTest::keyClick(&canvas(), Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_EQ(region(), client::PixelRegion(PixelRect{37, 0, 39, 2})) << "shrinks, and goes on at the other side";
}

TEST_F(RegionToolTest, EscapeGivesADragUp) {
    const client::PixelRegion before(PixelRect{1, 1, 4, 4});
    selection.setRegion(before);
    QTest::mousePress(&canvas(), Qt::LeftButton, Qt::ShiftModifier, screen({10, 10}));
    move(screen({20, 20}), Qt::ShiftModifier);
    EXPECT_TRUE(tool().isDragging());
    QTest::keyClick(&canvas(), Qt::Key_Escape);
    EXPECT_FALSE(tool().isDragging());
    QTest::mouseRelease(&canvas(), Qt::LeftButton, Qt::ShiftModifier, screen({20, 20}));
    EXPECT_EQ(region(), before);
}

TEST_F(RegionToolTest, FocusBringsTheRegionToTheMiddle) {
    for (const PixelRect& rect : {PixelRect{30, 20, 34, 22}, PixelRect{0, 0, 40, 30}}) {
        selection.setRegion(client::PixelRegion(rect));
        canvas().zoomTo(1);
        view.focusSelection();
        const QRectF box = canvas().transform().toWidget(QRectF(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0));
        EXPECT_TRUE(QRectF(canvas().rect()).contains(box));
        EXPECT_LT((box.center() - QRectF(canvas().rect()).center()).manhattanLength(), 2 * canvas().transform().zoom());
        EXPECT_GT(box.width(), 100);
    }
}

TEST_F(RegionToolTest, TheOutlineIsDrawnAroundThePixels) {
    canvas().zoomTo(10);
    selection.setRegion(client::PixelRegion(PixelRect{12, 10, 20, 18}));
    const QImage picture = canvas().grab().toImage();
    const QRectF box = canvas().transform().toWidget(QRectF(12, 10, 8, 8));
    const QColor orange = theme.colors().selected;
    const auto near = [&](QPointF at) {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const QColor c = picture.pixelColor(at.toPoint() + QPoint(dx, dy));
                if (std::abs(c.red() - orange.red()) + std::abs(c.green() - orange.green()) + std::abs(c.blue() - orange.blue()) < 30) return true;
            }
        return false;
    };
    for (const QPointF& side : {QPointF(box.center().x(), box.top()), QPointF(box.center().x(), box.bottom()), QPointF(box.left(), box.center().y()),
                                QPointF(box.right(), box.center().y())})
        EXPECT_TRUE(near(side)) << side.x() << ", " << side.y();
    EXPECT_FALSE(near(box.center()));
    // The pixel of the current path is marked inside.
    selection.setPaths({{{15, 13}, 2, 0}});
    const QRectF mark = canvas().transform().rectOf({15, 13});
    const QImage marked = canvas().grab().toImage();
    EXPECT_NE(marked.pixelColor(QPointF(mark.left(), mark.center().y()).toPoint()), picture.pixelColor(QPointF(mark.left(), mark.center().y()).toPoint()));
}

}  // namespace
}  // namespace emca::explorer
