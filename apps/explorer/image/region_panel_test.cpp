#include "image/region_panel.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <limits>

#include "base/state_overlay.h"
#include "base/theme.h"
#include "image/region_histogram.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

/// Red is the column, green the row, blue 1.
std::shared_ptr<RenderedImage> ramp(std::uint32_t width, std::uint32_t height, float scale = 1) {
    auto image = std::make_shared<RenderedImage>();
    image->color = Image(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image->color.setColor({x, y}, Color(float(x), float(y), 1) * scale);
    return image;
}

class RegionPanelTest : public testing::Test {
  protected:
    RegionPanelTest() {
        panel.resize(360, 620);
        panel.show();
        QTest::qWait(1);
    }
    void show(std::shared_ptr<const RenderedImage> image, bool preview = false) {
        client::ImageEntry entry;
        entry.title = "ramp";
        entry.image = std::move(image);
        entry.preview = preview;
        dataset.addImage(entry);
        ASSERT_TRUE(waitFor([&] { return panel.isSettled(); }));
    }
    QString cell(const QString& row, const QString& column) const {
        QTableWidget& table = const_cast<RegionPanel&>(panel).table();
        for (int r = 0; r < table.rowCount(); ++r)
            for (int c = 1; c < table.columnCount(); ++c)
                if (table.item(r, 0)->text() == row && table.horizontalHeaderItem(c)->text() == column) return table.item(r, c)->text();
        return "no such cell";
    }
    QPushButton* button(const QString& text) {
        for (QPushButton* found : panel.findChildren<QPushButton*>())
            if (found->isVisible() && found->text() == text) return found;
        return nullptr;
    }
    static std::shared_ptr<client::Trace> traceOf(const client::PixelRegion& region) {
        auto trace = std::make_shared<client::Trace>();
        trace->pixels.assign(region.pixels().begin(), region.pixels().end());
        trace->replays.resize(region.size());
        for (Replay& replay : trace->replays) replay.verdict = Verdict::exact;
        return trace;
    }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    RegionPanel panel{dataset, selection, theme};
};

TEST_F(RegionPanelTest, SaysWhatToDoWithoutAnImage) {
    EXPECT_EQ(panel.table().rowCount(), 0);
    EXPECT_TRUE(panel.findChild<StateOverlay*>()->sentence().contains("Shift"));
}

TEST_F(RegionPanelTest, NumbersOfARectangleAreThoseOfItsPixels) {
    show(ramp(20, 10));
    EXPECT_EQ(panel.titleText(), "Whole image");
    EXPECT_EQ(panel.numbers().pixels, 200u);
    selection.setRegion(client::PixelRegion(PixelRect{2, 3, 5, 7}));
    EXPECT_EQ(panel.titleText(), "Region 3x4 at (2, 3)");
    EXPECT_EQ(panel.numbers().pixels, 12u);
    EXPECT_EQ(cell("mean", "R"), "3.000");
    EXPECT_EQ(cell("mean", "G"), "4.500");
    EXPECT_EQ(cell("median", "G"), "4.500");
    EXPECT_EQ(cell("min", "R"), "2.000");
    EXPECT_EQ(cell("max", "G"), "6.000");
    EXPECT_EQ(cell("variance", "B"), "0");
    // 2, 3 and 4, each four times: sum of squares 8, by 11.
    EXPECT_EQ(cell("variance", "R"), "0.7273");
    EXPECT_EQ(cell("NaN", "R"), "no such cell") << "what does not occur takes no room";
}

TEST_F(RegionPanelTest, ValuesThatAreNoRadianceAreCounted) {
    auto image = ramp(20, 10);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    image->color.setColor({3, 3}, {nan, infinity, -1});
    image->color.setColor({4, 3}, {nan, 1, -1});
    show(image);
    selection.setRegion(client::PixelRegion(PixelRect{3, 3, 5, 4}));
    EXPECT_EQ(cell("NaN", "R"), "2");
    EXPECT_EQ(cell("infinite", "G"), "1");
    EXPECT_EQ(cell("negative", "B"), "2");
    EXPECT_EQ(cell("mean", "R"), QString::fromUtf8("–")) << "of no number there is no mean";
    EXPECT_EQ(cell("mean", "G"), "1.000");
}

TEST_F(RegionPanelTest, TheReferenceStandsBeside) {
    show(ramp(20, 10));
    selection.setRegion(client::PixelRegion(PixelRect{2, 3, 5, 7}));
    panel.setReference(ramp(20, 10, 2), "twice");
    EXPECT_TRUE(panel.numbers().hasReference);
    EXPECT_EQ(panel.table().item(1, 0)->text(), "reference");
    EXPECT_EQ(panel.table().item(1, 1)->text(), "6.000");
    EXPECT_TRUE(panel.table().item(1, 1)->toolTip().contains("0.5000 times"));
    EXPECT_TRUE(panel.histogram().describe(3).contains("reference"));
    panel.setReference(ramp(21, 10), "of another size");
    EXPECT_FALSE(panel.numbers().hasReference);
}

TEST_F(RegionPanelTest, TheHistogramCountsEveryPixelAndGoesLogarithmic) {
    show(ramp(64, 64));
    const auto counted = [&] {
        const analysis::Histogram& h = panel.numbers().channels[0].histogram;
        std::uint64_t sum = h.below + h.above;
        for (const std::uint64_t count : h.counts) sum += count;
        return sum;
    };
    EXPECT_EQ(counted(), 4096u);
    EXPECT_FALSE(panel.numbers().channels[0].histogram.range.log);
    for (QToolButton* toggle : panel.findChildren<QToolButton*>()) QTest::mouseClick(toggle, Qt::LeftButton);
    EXPECT_TRUE(panel.numbers().channels[0].histogram.range.log);
    EXPECT_TRUE(panel.histogram().logCounts());
    EXPECT_EQ(counted(), 4096u);
    EXPECT_EQ(panel.numbers().channels[0].histogram.below, 64u) << "0 has no logarithm";
    EXPECT_FALSE(panel.histogram().describe(0).isEmpty());
}

TEST_F(RegionPanelTest, TheHistogramIsExportedAsEveryPlotIs) {
    auto image = ramp(64, 64);
    image->color.setColor({3, 3}, {std::numeric_limits<float>::quiet_NaN(), 3, 1});
    image->color.setColor({4, 3}, {1e6f, 3, 1});
    show(image);
    panel.setReference(ramp(64, 64, 2), "twice");
    RegionHistogram& histogram = panel.histogram();
    QSignalSpy said(&histogram, &RegionHistogram::message);
    QTest::mouseClick(&histogram, Qt::LeftButton);
    QTest::keyClick(&histogram, Qt::Key_C, Qt::ControlModifier);
    const QStringList lines = QApplication::clipboard()->text().trimmed().split('\n');
    EXPECT_EQ(said.count(), 1);
    EXPECT_EQ(lines[0], "from\tto\tR\treference R\tG\treference G\tB\treference B\tluminance\treference luminance");
    for (int column = 2; column < 10; ++column) {
        int sum = 0;
        for (const QString& line : lines.mid(1)) sum += line.split('\t')[column].toInt();
        EXPECT_EQ(sum, 4096) << "each pixel once, in column " << column;
    }
    QTemporaryDir folder;
    for (const int scale : {1, 2}) {
        const QString file = folder.filePath(QStringLiteral("%1.png").arg(scale));
        ASSERT_TRUE(histogram.exportTo(file, scale).ok());
        EXPECT_EQ(QImage(file).size(), histogram.size() * scale);
    }
    ASSERT_TRUE(histogram.exportTo(folder.filePath("a.svg")).ok());
    QFile drawing(folder.filePath("a.svg"));
    ASSERT_TRUE(drawing.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(drawing.readAll());
    for (const char* part : {"Whole image", "luminance", "reference", "brighter"}) EXPECT_TRUE(text.contains(part)) << part << " is text";
    EXPECT_FALSE(histogram.exportTo("/absent/a.png").ok());

    QStringList offered;
    QTimer::singleShot(0, [&] {
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        ASSERT_TRUE(menu);
        for (QAction* action : menu->actions()) offered += action->text();
        menu->close();
    });
    QContextMenuEvent click(QContextMenuEvent::Mouse, {20, 20}, histogram.mapToGlobal(QPoint(20, 20)));
    QCoreApplication::sendEvent(&histogram, &click);
    EXPECT_EQ(offered, (QStringList{"Copy values", "Copy picture", "Export"}));
}

TEST_F(RegionPanelTest, OneFireflyDoesNotFlattenTheHistogram) {
    auto image = ramp(8, 8);
    image->color.setColor({3, 3}, {1e4f, 3, 1});
    show(image);
    const analysis::Histogram& h = panel.numbers().channels[0].histogram;
    EXPECT_LT(h.range.max, 100) << "0 to 7 is what there is";
    EXPECT_EQ(h.above, 1u);
}

TEST_F(RegionPanelTest, LargeImagesAreCountedElsewhereAndTheLastQuestionIsAnswered) {
    show(ramp(300, 200));
    for (std::uint32_t i = 1; i < 9; ++i) selection.setRegion(client::PixelRegion(PixelRect{i, 0, i + 200, 150}));
    ASSERT_TRUE(waitFor([&] { return panel.isSettled(); }));
    EXPECT_EQ(panel.numbers().channels[0].image.summary.min, 8);
    EXPECT_EQ(panel.numbers().pixels, 30000u);
}

TEST_F(RegionPanelTest, PathsVerdictAndWhatIsMissingAreSaid) {
    show(ramp(20, 10));
    const client::PixelRegion region(PixelRect{2, 3, 5, 7});
    panel.setTracing({true, false, 0});
    selection.setRegion(region);
    EXPECT_EQ(panel.warningText(), "These pixels are not traced.");
    QSignalSpy wanted(&panel, &RegionPanel::traceWanted);
    ASSERT_TRUE(button("Trace"));
    QTest::mouseClick(button("Trace"), Qt::LeftButton);
    EXPECT_EQ(wanted.count(), 1);
    auto trace = traceOf(region);
    dataset.addTrace(trace);
    EXPECT_EQ(panel.pathsText(), "0 paths of 12 pixels. All replays are exact.");
    EXPECT_EQ(panel.warningText(), "");
    EXPECT_FALSE(button("Trace"));
    auto partly = traceOf(region);
    partly->replays[5].verdict = Verdict::different;
    partly->stats.droppedByBudget = 12345;
    partly->matches = MatchCounts{768, 10, 0, 3, {}, {}, {}};
    dataset.addTrace(partly);
    EXPECT_EQ(panel.pathsText(), "The filter takes 10 of 768 paths of 12 pixels. Exact replay of 11 pixels.");
    EXPECT_TRUE(panel.warningText().contains("12,345 values did not fit") && panel.warningText().contains("3 of the paths"));
    panel.setTracing({true, false, 3000000});
    EXPECT_TRUE(panel.warningText().contains("3,000,000 paths"));
    EXPECT_EQ(panel.pathsText(), "");
}

TEST_F(RegionPanelTest, OnlyMatchesAsksWithTheFilterAndClearGivesUp) {
    show(ramp(20, 10));
    selection.setRegion(client::PixelRegion(PixelRect{2, 3, 5, 7}));
    QSignalSpy query(&panel, &RegionPanel::queryWanted);
    auto* only = panel.findChild<QCheckBox*>();
    EXPECT_FALSE(only->isEnabled()) << "there is no filter";
    panel.setFilter("depth > 3");
    EXPECT_EQ(query.count(), 0);
    QTest::mouseClick(only, Qt::LeftButton, {}, {8, only->height() / 2});
    ASSERT_EQ(query.count(), 1);
    EXPECT_EQ(query[0][0].toString(), "depth > 3");
    panel.setFilter("depth > 33");
    panel.setFilter("depth > 33 and luminance > 2");
    ASSERT_TRUE(waitFor([&] { return query.count() == 2; })) << "after a pause, once";
    EXPECT_EQ(query[1][0].toString(), "depth > 33 and luminance > 2");
    QTest::mouseClick(only, Qt::LeftButton, {}, {8, only->height() / 2});
    EXPECT_EQ(query.back()[0].toString(), "");
    QTest::mouseClick(button("Clear"), Qt::LeftButton);
    EXPECT_TRUE(selection.pixels().empty());
    EXPECT_EQ(panel.titleText(), "Whole image");
}

TEST_F(RegionPanelTest, TheTableIsCopiedAsText) {
    show(ramp(20, 10));
    selection.setRegion(client::PixelRegion(PixelRect{2, 3, 5, 7}));
    QTest::keyClick(&panel, Qt::Key_C, Qt::ControlModifier);
    const QString text = QApplication::clipboard()->text();
    EXPECT_TRUE(text.startsWith("Region 3x4 at (2, 3)\tR\tG\tB\tY\nmean\t3.000\t4.500\t1.000\t")) << text.toStdString();
}

}  // namespace
}  // namespace emca::explorer
