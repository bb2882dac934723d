#include "plots/path_plot.h"

#include <gtest/gtest.h>

#include <qwt_plot.h>
#include <QApplication>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <limits>
#include <set>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "emca/analysis/format.h"
#include "paths/test_paths.h"
#include "plots/contribution_plot.h"
#include "plots/depth_plot.h"
#include "plots/luminance_plot.h"
#include "plots/marginal_histogram.h"

namespace emca::explorer {
namespace {

using client::PathId;
using test::fakePaths;
using test::pathsWithEstimates;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <typename Plot>
struct Bench {
    explicit Bench(PathSet paths) : plot(dataset, selection, theme) {
        plot.resize(760, 480);
        plot.show();
        dataset.addTrace(test::traceOf(std::move(paths)));
        QCoreApplication::processEvents();
        listening.emplace(selection, [this](std::uint32_t parts) {
            if (parts & ~std::uint32_t(client::SelectionPart::hover)) ++notifications;
        });
    }
    QPoint at(std::size_t row, std::uint32_t point) {
        const ScatterContent& content = plot.row(row).content();
        const auto place = content.frame.place(content.xs[point], content.ys[point]);
        EXPECT_TRUE(place.has_value());
        return place->toPoint();
    }
    void click(std::size_t row, std::uint32_t point, Qt::KeyboardModifiers modifiers = {}) {
        QTest::mouseClick(plot.row(row).canvas(), Qt::LeftButton, modifiers, at(row, point));
    }
    void drag(std::size_t row, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {},
              Qt::MouseButton button = Qt::LeftButton) {
        QWidget* canvas = plot.row(row).canvas();
        QTest::mousePress(canvas, button, modifiers, from);
        for (const QPoint& p : {(from + to) / 2, to}) {
            QMouseEvent move(QEvent::MouseMove, p, canvas->mapToGlobal(p), Qt::NoButton, button, modifiers);
            QApplication::sendEvent(canvas, &move);
        }
        QTest::mouseRelease(canvas, button, modifiers, to);
    }
    void wheel(std::size_t row, QPoint at, int notches, Qt::KeyboardModifiers modifiers = {}) {
        QWidget* canvas = plot.row(row).canvas();
        QWheelEvent event(at, canvas->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(canvas, &event);
    }
    PathId id(std::uint32_t path) { return pathId(dataset.paths(), path); }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    Plot plot;
    std::optional<SelectionListening> listening;
    int notifications = 0;
};

/// Values far apart, so that no two points overlap.
PathSet sparse(std::size_t count = 20) {
    std::vector<Color> estimates;
    for (std::size_t i = 0; i < count; ++i)
        estimates.emplace_back(float(i % 5) + 1, float(i % 3) + 1, float(i % 7) + 1);
    return pathsWithEstimates(estimates, {1, 2, 5});
}

/// Labels at the end of an axis and the width of the canvas depend on each other.
TEST(PathPlot, EveryWidthSettles) {
    for (const std::size_t count : {std::size_t(20), std::size_t(128), std::size_t(1024)}) {
        Bench<LuminancePlot> bench(sparse(count));
        for (int width = 320; width < 1000; width += 3) {
            bench.plot.resize(width, 300);
            QCoreApplication::sendPostedEvents();
            ASSERT_EQ(bench.plot.row(0).content().frame.canvas(), QSizeF(bench.plot.row(0).canvas()->size())) << width;
        }
    }
}

TEST(PathPlot, ClickSelectsExactlyThatPath) {
    Bench<ContributionPlot> bench(sparse());
    for (std::size_t row = 0; row < 3; ++row)
        for (const std::uint32_t point : {0u, 7u, 19u}) {
            bench.click(row, point);
            EXPECT_EQ(bench.selection.state().paths, std::vector<PathId>{bench.id(point)});
            EXPECT_EQ(bench.plot.row(2 - row).content().selected, std::vector<std::uint32_t>{point});
            EXPECT_EQ(bench.plot.row(row).content().current, point);
        }
    EXPECT_EQ(bench.notifications, 9);
}

TEST(PathPlot, ShiftClickAddsAndTakesAway) {
    Bench<LuminancePlot> bench(sparse());
    bench.click(0, 3);
    bench.click(0, 9, Qt::ShiftModifier);
    EXPECT_EQ(bench.selection.state().paths, (std::vector<PathId>{bench.id(3), bench.id(9)}));
    bench.click(0, 3, Qt::ShiftModifier);
    EXPECT_EQ(bench.selection.state().paths, std::vector<PathId>{bench.id(9)});
    QTest::keyClick(&bench.plot.row(0), Qt::Key_Escape);
    EXPECT_TRUE(bench.selection.state().paths.empty());
}

TEST(PathPlot, ClickOnNothingKeepsTheSelection) {
    Bench<LuminancePlot> bench(pathsWithEstimates({Color(1), Color(1), Color(1)}));
    bench.click(0, 1);
    QTest::mouseClick(bench.plot.row(0).canvas(), Qt::LeftButton, {}, bench.at(0, 1) + QPoint(40, 40));
    EXPECT_EQ(bench.selection.state().paths.size(), 1u);
}

TEST(PathPlot, RectangleSelectsExactlyWhatIsDrawnInIt) {
    Bench<ContributionPlot> bench(fakePaths({.samples = 1024, .vertices = 0, .firefly = 417}));
    const ScatterContent& content = bench.plot.row(1).content();
    const QPoint from(120, 15), to(330, 80);
    std::vector<PathId> expected;
    for (std::uint32_t i = 0; i < content.xs.size(); ++i) {
        const auto at = content.frame.place(content.xs[i], content.ys[i]);
        if (at && at->x() >= 120 && at->x() <= 330 && at->y() >= 15 && at->y() <= 80) expected.push_back(bench.id(i));
    }
    ASSERT_GT(expected.size(), 20u);
    bench.drag(1, from, to);
    EXPECT_EQ(bench.selection.state().paths, expected);
    EXPECT_EQ(bench.notifications, 1);
    // Shift adds a second rectangle; drawn from the other corner it is the same one.
    bench.drag(1, QPoint(500, 80), QPoint(400, 15), Qt::ShiftModifier);
    EXPECT_GT(bench.selection.state().paths.size(), expected.size());
    for (const PathId& id : expected) EXPECT_TRUE(bench.selection.isSelected(id));
    bench.drag(1, QPoint(500, 2), QPoint(505, 14));
}

TEST(PathPlot, RectangleKeySelectsWhateverTheModifiers) {
    Bench<LuminancePlot> bench(sparse());
    QTest::keyClick(&bench.plot.row(0), Qt::Key_R);
    bench.drag(0, QPoint(1, 1), QPoint(600, 400), Qt::AltModifier);
    EXPECT_EQ(bench.selection.state().paths.size(), 20u);
    EXPECT_FALSE(bench.plot.row(0).isZoomed());
}

TEST(PathPlot, OneOutlierDoesNotFlattenTheRest) {
    Bench<LuminancePlot> bench(fakePaths({.samples = 1024, .vertices = 0, .firefly = 417}));
    const ScatterContent& content = bench.plot.row(0).content();
    EXPECT_GT(content.ys[417], 100);
    EXPECT_LT(content.frame.y().range.max, 2);
    EXPECT_EQ(content.frame.row(content.ys[417]), PlotRow::above);
    EXPECT_TRUE(content.frame.rows().above);
    bench.click(0, 417);  // at the edge it can still be chosen
    EXPECT_EQ(bench.selection.state().paths, std::vector<PathId>{bench.id(417)});
    // The others use most of the height.
    double low = 1e9, high = -1e9;
    for (std::uint32_t i = 0; i < content.ys.size(); ++i)
        if (content.frame.row(content.ys[i]) == PlotRow::inside) {
            low = std::min(low, content.frame.y().pixel(content.ys[i]));
            high = std::max(high, content.frame.y().pixel(content.ys[i]));
        }
    EXPECT_GT(high - low, 0.8 * content.frame.canvas().height());
}

TEST(PathPlot, LogKeyShowsZerosAndNegativesBelowTheScale) {
    Bench<LuminancePlot> bench(pathsWithEstimates({Color(1), Color(0), Color(-2), Color(100), Color(0.01f), Color(3)}));
    QTest::keyClick(&bench.plot.row(0), Qt::Key_L);
    EXPECT_TRUE(bench.plot.isLog());
    const ScatterContent& content = bench.plot.row(0).content();
    EXPECT_TRUE(content.frame.y().range.log);
    EXPECT_GT(content.frame.y().range.min, 0);
    EXPECT_EQ(content.frame.row(content.ys[1]), PlotRow::below);
    EXPECT_EQ(content.frame.row(content.ys[2]), PlotRow::below);
    bench.click(0, 2);
    EXPECT_EQ(bench.selection.state().paths, std::vector<PathId>{bench.id(2)});
    QTest::keyClick(&bench.plot.row(0), Qt::Key_L);
    EXPECT_FALSE(bench.plot.isLog());
    EXPECT_EQ(bench.plot.row(0).content().frame.row(-2), PlotRow::inside);
}

TEST(PathPlot, QwtsScalesAgreeWithTheFrame) {
    Bench<ContributionPlot> bench(fakePaths({.samples = 300, .vertices = 0, .firefly = 17}));
    for (const bool log : {false, true}) {
        bench.plot.setLog(log);
        QCoreApplication::processEvents();
        for (std::size_t row = 0; row < 3; ++row) {
            const ScatterPlot& plot = bench.plot.row(row);
            const ScatterContent& content = plot.content();
            for (const analysis::Tick& tick : content.yTicks)
                EXPECT_NEAR(plot.plot()->transform(QwtPlot::yLeft, tick.value), content.frame.y().pixel(tick.value), 1);
            for (const analysis::Tick& tick : content.xTicks)
                EXPECT_NEAR(plot.plot()->transform(QwtPlot::xBottom, tick.value), content.frame.x().pixel(tick.value),
                            1);
        }
    }
}

TEST(PathPlot, StackedCanvasesAlign) {
    // Blue needs wider labels than red.
    std::vector<Color> estimates;
    for (int i = 0; i < 50; ++i) estimates.emplace_back(float(i), float(i) * 0.001f, float(i) * 12345.f);
    Bench<ContributionPlot> bench(pathsWithEstimates(estimates));
    QCoreApplication::processEvents();
    const auto geometry = [&](std::size_t row) {
        QWidget* canvas = bench.plot.row(row).canvas();
        return QRect(canvas->mapTo(&bench.plot, QPoint(0, 0)), canvas->size());
    };
    for (const std::size_t row : {1u, 2u}) {
        EXPECT_EQ(geometry(row).left(), geometry(0).left());
        EXPECT_EQ(geometry(row).right(), geometry(0).right());
        EXPECT_NEAR(geometry(row).height(), geometry(0).height(), 3);
        EXPECT_GT(geometry(row).top(), geometry(row - 1).bottom());
    }
}

TEST(PathPlot, WheelZoomsAtTheCursorAllRowsShareX) {
    Bench<ContributionPlot> bench(fakePaths({.samples = 512, .vertices = 0}));
    const QPoint at(200, 40);
    const double before = bench.plot.row(0).content().frame.x().value(200);
    bench.wheel(0, at, 3);
    EXPECT_TRUE(bench.plot.row(0).isZoomed());
    EXPECT_NEAR(bench.plot.row(0).content().frame.x().value(200), before, 1);
    EXPECT_EQ(bench.plot.row(2).content().frame.x().range, bench.plot.row(0).content().frame.x().range);
    const auto zoomedRange = bench.plot.row(0).content().frame.x().range;
    bench.drag(0, QPoint(200, 40), QPoint(260, 40), {}, Qt::MiddleButton);
    EXPECT_LT(bench.plot.row(1).content().frame.x().range.min, zoomedRange.min);
    EXPECT_TRUE(bench.selection.state().paths.empty());
    QTest::mouseDClick(bench.plot.row(1).canvas(), Qt::LeftButton, {}, QPoint(300, 5));
    for (std::size_t row = 0; row < 3; ++row) EXPECT_FALSE(bench.plot.row(row).isZoomed());
}

TEST(PathPlot, ANewTraceKeepsTheZoomWherePathsAreLeft) {
    Bench<LuminancePlot> bench(fakePaths({.samples = 512, .vertices = 0}));
    bench.wheel(0, QPoint(200, 200), 4);
    const auto range = bench.plot.row(0).content().frame.x().range;
    bench.dataset.addTrace(test::traceOf(fakePaths({.samples = 512, .vertices = 0, .seed = 2})));
    EXPECT_EQ(bench.plot.row(0).content().frame.x().range, range);
    bench.dataset.addTrace(test::traceOf(fakePaths({.samples = 64, .vertices = 0, .firstSample = 100000})));
    EXPECT_FALSE(bench.plot.row(0).xZoom().has_value());
}

TEST(PathPlot, HoverTellsTheOthersAndShowsValues) {
    Bench<ContributionPlot> bench(sparse());
    const QPoint at = bench.at(1, 7);
    QWidget* canvas = bench.plot.row(1).canvas();
    QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
    ASSERT_TRUE(bench.selection.hovered().has_value());
    EXPECT_EQ(bench.selection.hovered()->path, bench.id(7));
    EXPECT_EQ(bench.plot.row(1).hoverText(), "sample 7\nred  3.000\ngreen  2.000\nblue  1.000");
    EXPECT_TRUE(bench.plot.row(0).hoverText().isEmpty()) << "one bubble, under the mouse";
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(canvas, &leave);
    EXPECT_FALSE(bench.selection.hovered().has_value());
}

TEST(PathPlot, PointsOnTopOfEachOtherAreCounted) {
    // Samples that split into three parts of the same depth.
    PathColumns columns = pathsWithEstimates(std::vector<Color>(12, Color(1)), {2}).columns();
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> parts;
    for (int i = 0; i < 12; ++i) {
        samples.push_back(i / 3);
        parts.push_back(i % 3);
    }
    columns.samples = samples;
    columns.parts = parts;
    Bench<DepthPlot> bench(PathSet::make(std::move(columns)).value());
    ASSERT_EQ(bench.plot.row(0).content().xs.size(), 12u);
    const QPoint at = bench.at(0, 1);
    QWidget* canvas = bench.plot.row(0).canvas();
    QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
    EXPECT_TRUE(bench.plot.row(0).hoverText().endsWith("and 2 more here"))
        << bench.plot.row(0).hoverText().toStdString();
}

TEST(PathPlot, PathsOfSeveralPixelsStandOnePixelAfterTheOther) {
    std::vector<PathSet> sets;
    for (std::uint32_t x = 0; x < 3; ++x) sets.push_back(pathsWithEstimates(std::vector<Color>(4, Color(float(x))), {2}, {x, 7}));
    Bench<LuminancePlot> bench(PathSet::merged(sets));
    const std::vector<double>& xs = bench.plot.row(0).content().xs;
    ASSERT_EQ(xs.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(xs[i], double(i));
    const QPoint at = bench.at(0, 9);
    QWidget* canvas = bench.plot.row(0).canvas();
    QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(canvas, &move);
    EXPECT_TRUE(bench.plot.row(0).hoverText().startsWith("sample 1 (2, 7)")) << bench.plot.row(0).hoverText().toStdString();
    EXPECT_TRUE(bench.plot.csv().contains("\n2,7,1,0,"));
    // One pixel again: its sample indices.
    bench.dataset.addTrace(test::traceOf(pathsWithEstimates(std::vector<Color>(4, Color(1)), {2})));
    EXPECT_EQ(bench.plot.row(0).content().xs.back(), 3.0);
}

TEST(PathPlot, EveryPathIsInOneBarOrEdgeRow) {
    std::vector<Color> estimates;
    for (int i = 0; i < 200; ++i) estimates.emplace_back(0.1f + 0.01f * float(i % 20));
    estimates[3] = Color(kNaN, kNaN, kNaN);
    estimates[4] = Color(kInfinity, kInfinity, kInfinity);
    estimates[5] = Color(5000.f, 5000.f, 5000.f);
    Bench<LuminancePlot> bench(pathsWithEstimates(estimates));
    const analysis::Histogram& bars = bench.plot.row(0).histogram()->bars();
    std::uint64_t sum = bars.below + bars.above + bars.nan + bars.positiveInfinite + bars.negativeInfinite;
    for (const std::uint64_t count : bars.counts) sum += count;
    EXPECT_EQ(sum, 200u);
    EXPECT_EQ(bars.nan, 1u);
    EXPECT_EQ(bars.above + bars.positiveInfinite, 2u);
}

TEST(PathPlot, DepthHasOneBarForEachDepthAndAClickOnItSelectsItsPaths) {
    Bench<DepthPlot> bench(sparse(30));  // depths 1, 2, 5 in turn
    MarginalHistogram* histogram = bench.plot.row(0).histogram();
    const analysis::Histogram& bars = histogram->bars();
    ASSERT_EQ(bars.binCount(), 5u);
    EXPECT_EQ(bars.counts, (std::vector<std::uint64_t>{10, 10, 0, 0, 10}));
    const PlotFrame& frame = bench.plot.row(0).content().frame;
    const int top = bench.plot.row(0).canvas()->mapTo(&bench.plot.row(0), QPoint()).y();
    QTest::mouseClick(histogram, Qt::LeftButton, {}, QPoint(6, top + int(frame.y().pixel(5))));
    EXPECT_EQ(bench.selection.state().paths.size(), 10u);
    for (const PathId& id : bench.selection.state().paths) EXPECT_EQ(id.sample % 3, 2);
}

TEST(PathPlot, FollowsTheSelectionOfOtherViews) {
    Bench<LuminancePlot> bench(sparse());
    bench.selection.setPaths({bench.id(2), bench.id(5), PathId{{9, 9}, 5, 0}});
    EXPECT_EQ(bench.plot.row(0).content().selected, (std::vector<std::uint32_t>{2, 5}));
    EXPECT_EQ(bench.notifications, 1);
}

/// Whatever the values are: nothing breaks, and each state says what it is.
class OddValues : public testing::TestWithParam<int> {
  protected:
    static PathSet paths(int which) {
        switch (which) {
            case 0:
                return {};
            case 1:
                return pathsWithEstimates({Color(0.5f)});
            case 2:
                return pathsWithEstimates(std::vector<Color>(30, Color(kNaN, kNaN, kNaN)));
            case 3:
                return pathsWithEstimates(std::vector<Color>(30, Color(0)));
            case 4:
                return fakePaths({.samples = 10, .estimates = false});
            case 5:
                return pathsWithEstimates(
                    {Color(kInfinity), Color(-kInfinity), Color(1e38f), Color(-1e38f), Color(1e-38f)});
            default:
                return fakePaths({.samples = 120000, .vertices = 1});
        }
    }
};

TEST_P(OddValues, AreShownInEveryPlot) {
    const auto exercise = [](auto& bench) {
        for (const bool log : {true, false}) {
            bench.plot.setLog(log);
            bench.plot.grab();
        }
        bench.drag(0, QPoint(5, 5), QPoint(300, 70));
        bench.wheel(0, QPoint(100, 50), 2);
        bench.wheel(0, QPoint(100, 50), -40);
        bench.plot.grab();
        bench.plot.resetZoom();
        EXPECT_EQ(bench.plot.csv().count('\n'), int(bench.dataset.paths().pathCount()) + 1);
    };
    Bench<ContributionPlot> contribution(paths(GetParam()));
    exercise(contribution);
    Bench<DepthPlot> depth(paths(GetParam()));
    exercise(depth);
}
INSTANTIATE_TEST_SUITE_P(All, OddValues, testing::Range(0, 7));

TEST(PathPlot, EmptyStatesSayWhatToDo) {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ContributionPlot plot(dataset, selection, theme);
    plot.resize(760, 480);
    plot.show();
    const auto* overlay = plot.findChild<StateOverlay*>();
    ASSERT_NE(overlay, nullptr);
    EXPECT_EQ(overlay->sentence(), "Click a pixel in the image");
    dataset.addTrace(test::traceOf({}));
    EXPECT_EQ(overlay->sentence(), "The renderer recorded no path for this pixel");
    dataset.addTrace(test::traceOf(fakePaths({.samples = 4, .estimates = false})));
    EXPECT_EQ(overlay->sentence(), "The renderer recorded no final estimate for the 4 paths of this pixel");
    dataset.addTrace(test::traceOf(sparse()));
    EXPECT_EQ(overlay->sentence(), "");
}

TEST(PathPlot, ExportsPicturesAndValues) {
    Bench<ContributionPlot> bench(sparse());
    QTemporaryDir folder;
    const auto read = [&](const QString& name) {
        QFile file(folder.filePath(name));
        EXPECT_TRUE(file.open(QIODevice::ReadOnly));
        return file.readAll();
    };
    ASSERT_TRUE(bench.plot.exportTo(folder.filePath("a.csv")).ok());
    EXPECT_TRUE(read("a.csv").startsWith("pixel x,pixel y,sample,part,red,green,blue\n3,4,0,0,1,1,1\n3,4,1,0,2,2,2\n"));
    ASSERT_TRUE(bench.plot.exportTo(folder.filePath("a.png")).ok());
    EXPECT_GT(QImage(folder.filePath("a.png")).width(), 1400);
    ASSERT_TRUE(bench.plot.exportTo(folder.filePath("a.svg")).ok());
    const QByteArray svg = read("a.svg");
    EXPECT_TRUE(svg.contains("<circle") || svg.contains("<path")) << "points as vectors";
    EXPECT_TRUE(svg.contains("sample index"));
    const Result<void> failed = bench.plot.exportTo(folder.filePath("no/such/folder/a.png"));
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().code, ErrorCode::fileUnwritable);
}

}  // namespace
}  // namespace emca::explorer
