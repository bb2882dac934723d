#include "base/plot_export.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QImage>
#include <QMenu>
#include <QTemporaryDir>
#include <QTest>
#include <limits>
#include <map>

#include "base/path_ids.h"
#include "paths/test_paths.h"
#include "plots/contribution_plot.h"
#include "plots/depth_plot.h"
#include "plots/luminance_plot.h"

namespace emca::explorer {
namespace {

template <typename Plot>
struct Shown {
    Shown() : plot(dataset, selection, theme) {
        std::vector<Color> estimates;
        for (int i = 0; i < 40; ++i) estimates.emplace_back(float(i % 7) * 0.25f);
        estimates[3] = Color(std::numeric_limits<float>::quiet_NaN());
        estimates[4] = Color(900.f);
        dataset.addTrace(test::traceOf(test::pathsWithEstimates(estimates, {1, 2, 5})));
        plot.resize(640, 320);
        plot.show();
        QCoreApplication::processEvents();
    }
    QString text(const QString& file) {
        QFile in(file);
        EXPECT_TRUE(in.open(QIODevice::ReadOnly)) << file.toStdString();
        return QString::fromUtf8(in.readAll());
    }
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    Plot plot;
};

template <typename Plot>
void everyFormat(const QString& quantity) {
    Shown<Plot> shown;
    QTemporaryDir folder;
    QSize size;
    for (const int scale : {1, 2}) {
        const QString file = folder.filePath(QStringLiteral("%1.png").arg(scale));
        ASSERT_TRUE(shown.plot.exportTo(file, scale).ok());
        if (scale == 1) size = QImage(file).size();
        EXPECT_EQ(QImage(file).size(), size * scale);
    }
    ASSERT_TRUE(shown.plot.exportTo(folder.filePath("a.svg")).ok());
    const QString drawing = shown.text(folder.filePath("a.svg"));
    EXPECT_TRUE(drawing.contains(quantity)) << "the title is text";
    EXPECT_TRUE(drawing.contains("sample index"));
    ASSERT_TRUE(shown.plot.exportTo(folder.filePath("a.csv")).ok());
    EXPECT_EQ(shown.text(folder.filePath("a.csv")).count('\n'), 41);
    EXPECT_FALSE(shown.plot.exportTo("/absent/folder/a.png").ok());
}

TEST(PlotExport, EveryPlotInEveryFormat) {
    everyFormat<LuminancePlot>("luminance");
    everyFormat<ContributionPlot>("green");
    everyFormat<DepthPlot>("path depth");
}

TEST(PlotExport, CtrlCCopiesTheValues) {
    Shown<LuminancePlot> shown;
    QString said;
    QObject::connect(&shown.plot, &PathPlot::message, [&](const QString& sentence) { said = sentence; });
    QTest::keyClick(&shown.plot.row(0), Qt::Key_C, Qt::ControlModifier);
    const QStringList lines = QApplication::clipboard()->text().split('\n');
    ASSERT_EQ(lines.size(), 42);
    EXPECT_EQ(lines[0], "pixel x\tpixel y\tsample\tpart\tluminance");
    EXPECT_EQ(lines[4], "3\t4\t3\t0\tNaN");
    EXPECT_FALSE(said.isEmpty());
}

/// Bars, what lies beyond and NaN: every path once, every selected one once.
TEST(PlotExport, HistogramsCountEveryPath) {
    Shown<ContributionPlot> shown;
    shown.selection.setPaths({pathId(shown.dataset.paths(), 3), pathId(shown.dataset.paths(), 4), pathId(shown.dataset.paths(), 5)});
    QCoreApplication::processEvents();
    const QStringList lines = shown.plot.histogramCsv().trimmed().split('\n');
    EXPECT_EQ(lines[0], "quantity,from,to,paths,selected");
    std::map<QString, std::pair<int, int>> sums;
    for (const QString& line : lines.mid(1)) {
        const QStringList cells = line.split(',');
        ASSERT_EQ(cells.size(), 5);
        sums[cells[0]].first += cells[3].toInt();
        sums[cells[0]].second += cells[4].toInt();
        if (cells[1] == "NaN") {
            EXPECT_EQ(cells[3], "1");
        }
    }
    EXPECT_EQ(sums.size(), 3u);
    for (const auto& [name, sum] : sums) EXPECT_EQ(sum, (std::pair{40, 3})) << name.toStdString();
}

TEST(PlotExport, TheDepthHasALogarithmicAxisToo) {
    Shown<DepthPlot> shown;
    QTest::keyClick(&shown.plot.row(0), Qt::Key_L);
    EXPECT_TRUE(shown.plot.isLog());
    EXPECT_TRUE(shown.plot.row(0).content().frame.y().range.log);
}

TEST(PlotExport, TheMenuOffersAllOfIt) {
    Shown<LuminancePlot> shown;
    QMenu menu(&shown.plot);
    addExportActions(menu, shown.plot.exporting());
    QStringList texts;
    for (QAction* action : menu.actions()) texts += action->text();
    EXPECT_EQ(texts, (QStringList{"Copy values", "Copy picture", "Export"}));
    menu.actions()[1]->trigger();
    EXPECT_FALSE(QApplication::clipboard()->image().isNull());
}

}  // namespace
}  // namespace emca::explorer
