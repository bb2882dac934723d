// Image against reference, by mouse and keys on the real view.
#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUrl>
#include <cmath>
#include <limits>

#include "base/color_bar.h"
#include "base/state_overlay.h"
#include "base/text_line.h"
#include "base/theme.h"
#include "emca/imageio/imageio.h"
#include "image/image_actions.h"
#include "image/image_canvas.h"
#include "image/image_files.h"
#include "image/image_view.h"
#include "image/value_line.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

using analysis::ImageMetric;

std::shared_ptr<RenderedImage> filled(std::uint32_t width, std::uint32_t height, Color color) {
    auto image = std::make_shared<RenderedImage>();
    image->color = Image(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image->color.setColor({x, y}, color);
    return image;
}

class ImageCompareTest : public testing::Test {
  protected:
    ImageCompareTest() {
        view.resize(760, 560);
        view.show();
        QApplication::setActiveWindow(&view);
        view.canvas().setFocus();
        QTest::qWait(1);
    }
    std::shared_ptr<const RenderedImage> add(std::shared_ptr<RenderedImage> added, const char* title) {
        client::ImageEntry entry;
        entry.title = title;
        entry.image = added;
        dataset.addImage(entry);
        return added;
    }
    /// A grey image, brighter than its reference in its left half and darker in the right one.
    void addPair() {
        reference = add(filled(40, 20, Color(0.5f)), "reference");
        auto changed = filled(40, 20, Color(0.75f));
        for (std::uint32_t y = 0; y < 20; ++y)
            for (std::uint32_t x = 20; x < 40; ++x) changed->color.setColor({x, y}, Color(0.25f));
        image = add(changed, "image");
    }
    void key(Qt::Key k, Qt::KeyboardModifiers modifiers = {}) {
        QApplication::setActiveWindow(&view);   // menus do not give it back on the offscreen platform
        view.canvas().setFocus();
        QTest::keyClick(&view.canvas(), k, modifiers);
    }
    QPoint screen(Pixel pixel) {
        const QPointF centre = view.canvas().transform().rectOf(pixel).center();
        return {static_cast<int>(std::floor(centre.x())), static_cast<int>(std::floor(centre.y()))};
    }
    QColor shownAt(Pixel pixel) { return view.canvas().grab().toImage().pixelColor(screen(pixel)); }
    template <typename T>
    T& child(const char* name) {
        auto* found = view.findChild<T*>(name);
        EXPECT_TRUE(found) << name;
        return *found;
    }
    void choose(QComboBox& box, int index) {
        box.setCurrentIndex(index);
        emit box.activated(index);
    }
    /// Opens the menu of a button and takes the entry with this text.
    void takeFromMenu(const char* button, const QString& text) {
        QMenu* menu = child<QToolButton>(button).menu();
        menu->popup(QPoint(0, 0));
        QAction* wanted = nullptr;
        for (QAction* action : menu->actions())
            if (action->text() == text) wanted = action;
        ASSERT_TRUE(wanted) << text.toStdString();
        QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(wanted).center());
    }
    QString mean() { return child<TextLine>("metricMean").text(); }
    ImageMode mode() { return view.model().display().mode; }
    const ImageDisplay& display() { return view.model().display(); }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ImageView view{dataset, selection, theme};
    std::shared_ptr<const RenderedImage> image, reference;
};

TEST_F(ImageCompareTest, AnEarlierImageBecomesTheReferenceAndXFlips) {
    addPair();
    EXPECT_FALSE(child<QToolButton>("modeImage").isVisible()) << "nothing to compare with yet";
    auto& references = child<QComboBox>("references");
    EXPECT_EQ(references.itemText(0), "No reference");
    EXPECT_EQ(references.itemText(1), "reference");
    choose(references, 1);
    EXPECT_EQ(view.model().reference(), reference);
    EXPECT_TRUE(child<QToolButton>("modeImage").isVisible());
    const QColor before = shownAt({5, 15});
    view.canvas().zoomTo(20);
    const QPointF place = view.canvas().transform().toImage({100, 100});
    key(Qt::Key_X);
    EXPECT_EQ(mode(), ImageMode::reference);
    EXPECT_EQ(shownAt({5, 15}).red(), 188) << "sRGB of 0.5";
    EXPECT_EQ(view.canvas().transform().toImage({100, 100}), place) << "zoom and place stay";
    key(Qt::Key_X);
    EXPECT_EQ(mode(), ImageMode::image);
    EXPECT_EQ(shownAt({5, 15}), before);
    EXPECT_EQ(selection.state().pixel, std::nullopt);
    choose(references, 0);
    EXPECT_FALSE(view.model().reference());
    key(Qt::Key_X);
    EXPECT_EQ(mode(), ImageMode::image) << "without a reference there is nothing to flip to";
}

TEST_F(ImageCompareTest, TheDifferenceIsRedWhereDarkerAndGreenWhereBrighter) {
    addPair();
    view.model().setReference(reference);
    QTest::mouseClick(&child<QToolButton>("modeDifference"), Qt::LeftButton);
    EXPECT_EQ(mode(), ImageMode::difference);
    const QColor left = shownAt({4, 10}), right = shownAt({35, 10});
    EXPECT_GT(left.green(), left.red() + 100);
    EXPECT_GT(right.red(), right.green() + 100);
    EXPECT_NEAR(view.model().content().mean, 0, 1e-12) << "both halves cancel";
    EXPECT_TRUE(mean().endsWith(" W/(sr m²)")) << mean().toStdString();
    EXPECT_EQ(display().style().range.min, -display().style().range.max);
    auto* bar = view.findChild<ColorBar*>();
    ASSERT_TRUE(bar && bar->isVisible());
    EXPECT_EQ(bar->content().title, "error, W/(sr m²)");
    key(Qt::Key_C);
    EXPECT_TRUE(display().style().falseColor) << "signed numbers have no tone";
}

TEST_F(ImageCompareTest, EveryMetricIsChosenByMouseOrKeyAndItsMeanIsThatOfTheAnalysis) {
    addPair();
    view.model().setReference(reference);
    auto& metrics = child<QComboBox>("metric");
    ASSERT_EQ(metrics.count(), static_cast<int>(analysis::kImageMetricCount));
    for (int m = 0; m < metrics.count(); ++m) {
        choose(metrics, m);
        EXPECT_EQ(mode(), ImageMode::difference);
        ASSERT_TRUE(waitFor([&] { return view.isSettled(); }));
        const Image expected = *analysis::differenceImage(image->color, reference->color, static_cast<ImageMetric>(m));
        EXPECT_DOUBLE_EQ(view.model().content().mean, analysis::meanOf(expected)) << m;
        EXPECT_EQ(view.model().content().values->at({3, 3})[0], expected.at({3, 3})[0]);
        EXPECT_TRUE(display().style().range.isValid());
    }
    choose(metrics, static_cast<int>(ImageMetric::absoluteError));
    EXPECT_EQ(mean(), "mean 0.2500 W/(sr m²)");
    key(Qt::Key_M);
    EXPECT_EQ(display().metric, ImageMetric::squaredError);
    EXPECT_EQ(mean(), "mean 0.06250 (W/(sr m²))²");
    key(Qt::Key_M, Qt::ShiftModifier);
    EXPECT_EQ(display().metric, ImageMetric::absoluteError);
    key(Qt::Key_D);
    EXPECT_EQ(mode(), ImageMode::image) << "the key again leaves the difference";
}

TEST_F(ImageCompareTest, TheLineOfASplitIsDragged) {
    addPair();
    view.model().setReference(reference);
    key(Qt::Key_W);
    ASSERT_EQ(mode(), ImageMode::split);
    ImageCanvas& canvas = view.canvas();
    canvas.fit();
    EXPECT_EQ(shownAt({2, 4}).red(), 225) << "image: sRGB of 0.75";
    EXPECT_EQ(shownAt({37, 4}).red(), 188) << "reference";
    const QPoint from(canvas.width() / 2, canvas.height() - 30), to = screen({38, 18});
    QTest::mousePress(&canvas, Qt::LeftButton, {}, from);
    QMouseEvent move(QEvent::MouseMove, QPointF(to), canvas.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&canvas, &move);
    QTest::mouseRelease(&canvas, Qt::LeftButton, {}, to);
    EXPECT_EQ(shownAt({30, 4}).red(), 137) << "image: sRGB of 0.25";
    EXPECT_FALSE(selection.state().pixel) << "dragging the line selects nothing";
    const QImage saved = view.shownPicture();
    EXPECT_EQ(saved.pixelColor(30, 4).red(), 137);
    EXPECT_EQ(saved.pixelColor(39, 4).red(), 188);
}

TEST_F(ImageCompareTest, OtherSizesAreSaidAndNothingIsLost) {
    addPair();
    const auto larger = add(filled(60, 20, Color(0.5f)), "larger");
    dataset.setCurrentImage(1);
    view.model().setReference(larger);
    EXPECT_EQ(mean(), "sizes differ: 40 × 20 and 60 × 20");
    key(Qt::Key_D);
    const auto words = [&] {
        QString all;
        for (const StateOverlay* overlay : view.findChildren<StateOverlay*>()) all += overlay->sentence();
        return all;
    };
    EXPECT_TRUE(words().contains("40 x 20")) << words().toStdString();
    EXPECT_FALSE(view.findChild<ColorBar*>()->isVisible()) << "no numbers, no bar";
    key(Qt::Key_X);
    EXPECT_TRUE(words().isEmpty()) << words().toStdString();
    EXPECT_EQ(view.canvas().transform().pixelAt(screen({55, 10})), (Pixel{55, 10})) << "the reference in its own size";
    QTest::mouseClick(&view.canvas(), Qt::LeftButton, {}, screen({30, 10}));
    EXPECT_EQ(selection.state().pixel, (Pixel{30, 10}));
    key(Qt::Key_X);
    EXPECT_EQ(mode(), ImageMode::image);
    EXPECT_EQ(view.model().image(), image);
}

TEST_F(ImageCompareTest, AReferenceThatLeavesTheDatasetIsForgotten) {
    addPair();
    view.model().setReference(reference);
    key(Qt::Key_D);
    dataset.setImages({dataset.images()[1]}, 0);
    EXPECT_FALSE(view.model().reference());
    EXPECT_EQ(mode(), ImageMode::image);
    EXPECT_EQ(shownAt({4, 10}).red(), 225);
}

TEST_F(ImageCompareTest, ValuesOfBothAndTheMetricAreUnderTheCursor) {
    addPair();
    view.model().setReference(reference);
    QTest::mouseMove(&view.canvas(), screen({4, 10}));
    QMouseEvent move(QEvent::MouseMove, QPointF(screen({4, 10})), view.canvas().mapToGlobal(screen({4, 10})), Qt::NoButton, Qt::NoButton, {});
    QCoreApplication::sendEvent(&view.canvas(), &move);
    view.model().setMetric(ImageMetric::error);
    key(Qt::Key_D);
    const auto& rows = view.valueLine().rows();
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].name, "(4, 10)");
    EXPECT_EQ(rows[0].values[0].number, "0.7500");
    EXPECT_EQ(rows[1].values[0].number, "0.5000");
    ASSERT_EQ(rows[1].remarks.size(), 1u);
    EXPECT_EQ(rows[1].remarks[0].number, "0.2500");
    EXPECT_FALSE(rows[1].remarks[0].warns);
}

TEST_F(ImageCompareTest, FilesAreDroppedAsImageOrAsReference) {
    addPair();
    QSignalSpy opened(&view, &ImageView::openWanted), asReference(&view, &ImageView::openReferenceWanted);
    const auto drop = [&](double share, const QStringList& files) {
        QMimeData data;
        QList<QUrl> urls;
        for (const QString& file : files) urls << QUrl::fromLocalFile(file);
        data.setUrls(urls);
        const QPoint at = view.canvas().mapTo(&view, QPoint(static_cast<int>(share * view.canvas().width()), 50));
        QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&view, &enter);
        if (!enter.isAccepted()) return false;
        QDropEvent released(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&view, &released);
        return true;
    };
    EXPECT_TRUE(drop(0.2, {"/a.exr", "/b.exr"}));
    ASSERT_EQ(opened.size(), 1);
    EXPECT_EQ(opened[0][0].toStringList(), QStringList({"/a.exr", "/b.exr"}));
    EXPECT_TRUE(drop(0.8, {"/c.exr"}));
    ASSERT_EQ(asReference.size(), 1);
    EXPECT_EQ(asReference[0][0].toString(), "/c.exr");
    EXPECT_FALSE(drop(0.8, {"/work.emca"})) << "sessions are the window's";
}

TEST_F(ImageCompareTest, WhatIsShownIsSavedAsPictureOrAsNumbers) {
    addPair();
    view.model().setReference(reference);
    view.model().setMetric(ImageMetric::absoluteError);
    key(Qt::Key_D);
    QTemporaryDir folder;
    QSignalSpy saved(&view.files(), &ImageFiles::saved), failed(&view.files(), &ImageFiles::failed);
    for (const char* extension : {".png", ".exr", ".pfm", ".hdr"})
        view.files().save(folder.filePath(QStringLiteral("difference") + extension), view.shownPicture(), view.model().content().values);
    ASSERT_TRUE(waitFor([&] { return saved.size() + failed.size() == 4; }));
    EXPECT_EQ(failed.size(), 0);
    const QImage picture(folder.filePath("difference.png"));
    EXPECT_EQ(picture.size(), QSize(40, 20));
    EXPECT_EQ(picture.pixelColor(5, 5), view.shownPicture().pixelColor(5, 5)) << "the colours of the map";
    for (const char* extension : {".exr", ".pfm", ".hdr"}) {
        const auto read = imageio::read(folder.filePath(QStringLiteral("difference") + extension).toStdString());
        ASSERT_TRUE(read);
        EXPECT_NEAR(read->at({5, 5})[0], 0.25f, 0.001f) << extension;
    }
    view.files().save("/no/such/folder/x.png", view.shownPicture(), view.model().content().values);
    ASSERT_TRUE(waitFor([&] { return failed.size() == 1; }));
    EXPECT_TRUE(failed[0][0].toString().contains("/no/such/folder/x.png"));
}

TEST_F(ImageCompareTest, FlipOfLargeImagesIsComputedBesideTheWindowAndCanBeLeft) {
    reference = add(filled(1200, 900, Color(0.5f)), "reference");
    auto changed = filled(1200, 900, Color(0.5f));
    for (std::uint32_t i = 100; i < 700; ++i) changed->color.setColor({i, i}, Color(2));
    image = add(changed, "image");
    view.model().setReference(reference);
    view.model().setMetric(ImageMetric::ldrFlip);
    key(Qt::Key_D);
    EXPECT_TRUE(view.model().isComputing());
    EXPECT_TRUE(mean().startsWith("computing")) << mean().toStdString();
    view.model().setMetric(ImageMetric::absoluteError);   // what is no longer wanted is given up
    ASSERT_TRUE(waitFor([&] { return view.isSettled(); }));
    EXPECT_EQ(display().metric, ImageMetric::absoluteError);
    EXPECT_EQ(view.model().content().values->at({300, 300})[0], 1.5f);
    view.model().setMetric(ImageMetric::ldrFlip);
    ASSERT_TRUE(waitFor([&] { return view.isSettled(); }));
    EXPECT_TRUE(mean().startsWith("mean ")) << mean().toStdString();
    EXPECT_GT(view.model().content().values->at({300, 300})[0], 0.1f);
    EXPECT_EQ(display().style().range, (analysis::ValueRange{0, 1, false}));
}

TEST_F(ImageCompareTest, TheSpreadOfSamplesIsAnImage) {
    auto rendered = filled(20, 20, Color(1));
    rendered->samples = Image(20, 20, {"samples"});
    rendered->variance = Image(20, 20);
    for (std::uint32_t y = 0; y < 20; ++y)
        for (std::uint32_t x = 0; x < 20; ++x) {
            *rendered->samples.at({x, y}) = 16;
            rendered->variance.setColor({x, y}, Color(x < 10 ? 4.f : 16.f));
        }
    add(rendered, "render");
    takeFromMenu("channel", "Standard error");
    EXPECT_EQ(view.model().content().values->color({3, 3}), Color(0.5f));
    EXPECT_EQ(view.model().content().values->color({13, 3}), Color(1));
    EXPECT_TRUE(display().style().falseColor);
    EXPECT_NE(shownAt({3, 3}), shownAt({13, 3}));
    EXPECT_EQ(child<QToolButton>("channel").text(), "standard error");
    EXPECT_EQ(view.findChild<ColorBar*>()->content().title, "standard error, W/(sr m²)");
    takeFromMenu("channel", "None: the pixel's value");
    EXPECT_FALSE(display().style().falseColor);
    add(filled(20, 20, Color(1)), "file without variance");
    takeFromMenu("channel", "Variance");
    EXPECT_FALSE(display().samplingError) << "greyed";
}

TEST_F(ImageCompareTest, ChannelsAreChosenByMenuAndKey) {
    auto file = std::make_shared<RenderedImage>();
    file->color = Image(8, 8, {"R", "G", "B", "A", "depth.Z"});
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const float values[] = {1, 0.5f, 0, 0.25f, 30};
            std::copy(std::begin(values), std::end(values), file->color.at({x, y}));
        }
    add(file, "file");
    EXPECT_EQ(shownAt({1, 1}), QColor(255, 188, 0));
    takeFromMenu("channel", "A");
    EXPECT_EQ(shownAt({1, 1}), QColor(137, 137, 137));
    key(Qt::Key_H);
    EXPECT_EQ(text(display().channel), "depth.Z");
    key(Qt::Key_C);
    EXPECT_LE(display().style().range.min, 30);
    EXPECT_GE(display().style().range.max, 30);
    EXPECT_EQ(view.findChild<ColorBar*>()->content().title, "depth.Z");
    key(Qt::Key_C);
    for (int i = 0; i < 2; ++i) key(Qt::Key_H, Qt::ShiftModifier);
    EXPECT_EQ(text(display().channel), "B");
    EXPECT_EQ(shownAt({1, 1}), QColor(0, 0, 0));
    takeFromMenu("channel", "RGB");
    takeFromMenu("display", "Linear");
    EXPECT_EQ(shownAt({1, 1}), QColor(255, 128, 0));
    key(Qt::Key_G);
    EXPECT_EQ(shownAt({1, 1}), QColor(255, 188, 0)) << "after linear comes sRGB";
    takeFromMenu("display", "Gamma 2.4");
    EXPECT_EQ(shownAt({1, 1}).green(), static_cast<int>(std::lround(255 * std::pow(0.5, 1 / 2.4))));
}

TEST_F(ImageCompareTest, RangesAreTypedOrFound) {
    auto ramp = filled(100, 10, Color(0));
    for (std::uint32_t y = 0; y < 10; ++y)
        for (std::uint32_t x = 0; x < 100; ++x) ramp->color.setColor({x, y}, Color(static_cast<float>(x)));
    add(ramp, "ramp");
    QTest::mouseClick(&child<QToolButton>("falseColor"), Qt::LeftButton);
    auto& maximum = child<QLineEdit>("rangeMaximum");
    maximum.selectAll();
    QTest::keyClicks(&maximum, "200");
    QTest::keyClick(&maximum, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(display().style().range.max, 200);
    EXPECT_FALSE(child<QToolButton>("automaticRange").isChecked());
    maximum.selectAll();
    QTest::keyClicks(&maximum, "much");
    QTest::keyClick(&maximum, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(display().style().range.max, 200) << "what is no number changes nothing";
    takeFromMenu("automaticRange", "All");
    EXPECT_NEAR(display().style().range.max, 99, 1e-6);
    EXPECT_NEAR(display().style().range.min, 0, 1e-6);
    takeFromMenu("automaticRange", "5 % to 95 %");
    EXPECT_NEAR(display().style().range.max, 94, 1.1);
    for (std::size_t m = 0; m < analysis::kColorMapCount; ++m) {
        choose(child<QComboBox>("colorMap"), static_cast<int>(m));
        const auto expected = analysis::ColorMap::get(static_cast<analysis::ColorMapId>(m)).map(50.0, display().style().range);
        EXPECT_EQ(shownAt({50, 5}), QColor(expected.r, expected.g, expected.b)) << m;
    }
}

TEST_F(ImageCompareTest, ARenderThatGoesOnIsComparedAsItIs) {
    reference = add(filled(40, 20, Color(0.5f)), "reference");
    auto preview = filled(40, 20, Color(0));
    client::ImageEntry entry;
    entry.title = "render";
    entry.image = preview;
    entry.preview = true;
    dataset.addImage(entry);
    view.model().setReference(reference);
    view.model().setMetric(ImageMetric::absoluteError);
    key(Qt::Key_D);
    EXPECT_EQ(view.model().content().values->at({3, 3})[0], 0.5f);
    preview->color.setColor({3, 3}, Color(0.75f));
    dataset.pixelsChanged();
    EXPECT_TRUE(waitFor([&] { return view.model().content().values->at({3, 3})[0] == 0.25f; }));
    EXPECT_EQ(view.model().content().values->at({4, 4})[0], 0.5f);
}

TEST_F(ImageCompareTest, PixelsStayWhereTheyAreWhileOneFlipsToTheDifference) {
    addPair();
    view.model().setReference(reference);
    QTest::qWait(1);
    const QPoint before = screen({7, 7});
    for (const Qt::Key k : {Qt::Key_D, Qt::Key_W, Qt::Key_X, Qt::Key_X}) {
        key(k);
        QTest::qWait(1);
        EXPECT_EQ(screen({7, 7}), before) << static_cast<int>(mode());
    }
}

TEST_F(ImageCompareTest, ImagesThatWereThereBeforeTheViewAreShownWhole) {
    addPair();
    ImageView second(dataset, selection, theme);
    second.resize(500, 400);
    second.show();
    QTest::qWait(1);
    EXPECT_TRUE(second.canvas().transform().fitted());
    EXPECT_GT(second.canvas().transform().zoom(), 5);
}

TEST_F(ImageCompareTest, ColoursOfTheThemeReachTheLineOfValuesAtOnce) {
    addPair();
    selection.setPixel(Pixel{4, 10});
    const auto darkest = [&] {
        const QImage line = view.valueLine().grab().toImage();
        int value = 255;
        for (int y = 0; y < line.height(); ++y)
            for (int x = 0; x < line.width(); ++x) value = std::min(value, line.pixelColor(x, y).lightness());
        return value;
    };
    theme.setKind(ThemeKind::light);
    view.valueLine().setAutoFillBackground(true);
    QPalette white;
    white.setColor(QPalette::Window, Qt::white);
    view.valueLine().setPalette(white);
    EXPECT_LT(darkest(), 90) << "dark numbers on the light theme, without a hover";
}

}  // namespace
}  // namespace emca::explorer
