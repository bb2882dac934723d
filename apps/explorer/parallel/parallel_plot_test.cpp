#include "parallel/parallel_plot.h"

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QApplication>
#include <QClipboard>
#include <QCompleter>
#include <QFile>
#include <QMenu>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <cmath>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "parallel/parallel_canvas.h"
#include "paths/completing_field.h"
#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

using client::PathId;

class Parallel : public ::testing::Test {
  protected:
    explicit Parallel(PathSet paths = test::fakePaths({.samples = 200, .vertices = 0, .firefly = 77})) : plot(dataset, selection, theme) {
        plot.resize(900, 460);
        plot.setAxes({{"sample"}, {"depth"}, {"luminance", true}, {"last(v.label)"}});
        dataset.addTrace(test::traceOf(std::move(paths)));
        plot.show();
        QCoreApplication::processEvents();
        QObject::connect(&plot, &ParallelPlot::filterWanted, [this](const std::vector<query::Rule>& rules, const QString& query) {
            wantedRules = rules;
            wantedQuery = query;
        });
    }
    ParallelCanvas& canvas() { return plot.canvas(); }
    const ParallelFrame& frame() { return plot.canvas().frame(); }
    const ParallelAxis& axis(std::size_t i) { return plot.axes()[i]; }
    /// Positions of the selected paths.
    std::vector<Index> selected() { return findPaths(dataset.paths(), selection.state().paths); }
    std::vector<Index> pathsWhere(auto test) {
        std::vector<Index> out;
        for (Index p = 0; p < dataset.paths().pathCount(); ++p)
            if (test(p)) out.push_back(p);
        return out;
    }
    void drag(QPointF from, QPointF to, Qt::KeyboardModifiers modifiers = {}) {
        QTest::mousePress(&canvas(), Qt::LeftButton, modifiers, from.toPoint());
        for (const QPointF& at : {(from + to) / 2, to}) {
            QMouseEvent move(QEvent::MouseMove, at.toPoint(), canvas().mapToGlobal(at.toPoint()), Qt::NoButton, Qt::LeftButton, modifiers);
            QApplication::sendEvent(&canvas(), &move);
        }
        QTest::mouseRelease(&canvas(), Qt::LeftButton, modifiers, to.toPoint());
    }
    void hover(QPointF at) {
        QMouseEvent move(QEvent::MouseMove, at.toPoint(), canvas().mapToGlobal(at.toPoint()), Qt::NoButton, Qt::NoButton, {});
        QApplication::sendEvent(&canvas(), &move);
    }
    QPointF on(std::size_t i, double value) { return {frame().x(i), frame().position(axis(i), value)}; }
    void brushDepth(double low, double high, Qt::KeyboardModifiers modifiers = {}) { drag(on(1, low - 0.4), on(1, high + 0.4), modifiers); }
    std::vector<QString> names() {
        std::vector<QString> out;
        for (const ParallelAxis& a : plot.axes().all()) out.push_back(a.wish.expression);
        return out;
    }
    double depth(Index path) { return axis(1).values.numbers[path]; }
    QToolButton* button(const QString& text) {
        for (auto* each : plot.findChildren<QToolButton*>())
            if (each->text() == text) return each;
        return nullptr;
    }

    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ParallelPlot plot;
    std::vector<query::Rule> wantedRules;
    QString wantedQuery;
};

TEST_F(Parallel, DraggingOnAnAxisSelectsThePathsOfThatRange) {
    brushDepth(2, 3);
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return depth(p) >= 2 && depth(p) <= 3; }));
    EXPECT_FALSE(selected().empty());
    EXPECT_EQ(axis(1).brushes.size(), 1u);
    EXPECT_NE(plot.summaryText().indexOf("marked"), -1);
}

TEST_F(Parallel, MarksOfSeveralAxesAreJoinedByAnd) {
    brushDepth(2, 4);
    drag(on(0, 20), on(0, 120));
    const auto expected = pathsWhere([&](Index p) {
        const double sample = axis(0).values.numbers[p];
        return depth(p) >= 2 && depth(p) <= 4 && axis(0).brushes[0].contains(sample, true);
    });
    EXPECT_EQ(selected(), expected);
    EXPECT_LT(expected.size(), 110u);
    EXPECT_NEAR(axis(0).brushes[0].low, 20, 2);
    EXPECT_NEAR(axis(0).brushes[0].high, 120, 2);
}

TEST_F(Parallel, ShiftAddsAnIntervalAndAnotherDragReplacesThem) {
    brushDepth(2, 2);
    brushDepth(5, 5, Qt::ShiftModifier);
    EXPECT_EQ(axis(1).brushes.size(), 2u);
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return depth(p) == 2 || depth(p) == 5; }));
    drag(on(1, 3.4), on(1, 2.6));
    EXPECT_EQ(axis(1).brushes.size(), 1u);
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return depth(p) == 3; }));
}

TEST_F(Parallel, AMarkIsMovedResizedAndTakenAway) {
    brushDepth(2, 3);
    const double step = frame().position(axis(1), 1) - frame().position(axis(1), 2);
    drag(on(1, 2.5), on(1, 2.5) - QPointF(0, 2 * step));
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return depth(p) >= 4 && depth(p) <= 5; })) << "moved by two";
    const QRectF box = frame().brushRect(1, axis(1), axis(1).brushes[0]);
    drag({box.center().x(), box.top()}, {box.center().x(), box.top() - step});
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return depth(p) >= 4 && depth(p) <= 6; })) << "its upper end";
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, on(1, 5).toPoint());
    EXPECT_TRUE(axis(1).brushes.empty());
    EXPECT_TRUE(selection.state().paths.empty());
}

TEST_F(Parallel, AClickOnACategorySelectsIt) {
    ASSERT_TRUE(axis(3).isText());
    const std::size_t glass = 0;
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, on(3, double(glass)).toPoint());
    EXPECT_EQ(selected(), pathsWhere([&](Index p) { return axis(3).values.numbers[p] == double(glass); }));
}

TEST_F(Parallel, WhatIsMarkedBecomesRulesOfTheFilter) {
    brushDepth(2, 3);
    QTest::mouseClick(button("To filter"), Qt::LeftButton);
    ASSERT_EQ(wantedRules.size(), 2u);
    EXPECT_EQ(wantedRules[0], (query::Rule{"depth", query::Quantifier::any, query::RuleOperator::greaterEqual, "2"}));
    EXPECT_EQ(wantedRules[1], (query::Rule{"depth", query::Quantifier::any, query::RuleOperator::lessEqual, "3"}));
    brushDepth(5, 5, Qt::ShiftModifier);
    plot.filterByBrushes();
    EXPECT_TRUE(wantedRules.empty()) << "two intervals are no rules that are joined by and";
    const auto matches = query::Query::parse(wantedQuery.toStdString())->select(dataset.paths());
    ASSERT_TRUE(matches.ok());
    EXPECT_EQ(matches->paths, selected());
}

TEST_F(Parallel, AnotherViewsSelectionEndsTheMarks) {
    brushDepth(2, 3);
    selection.setPaths({pathId(dataset.paths(), 5)});
    EXPECT_FALSE(plot.axes().hasBrushes());
    EXPECT_EQ(selected(), std::vector<Index>{5});
    QTest::keyClick(&canvas(), Qt::Key_Escape);
    EXPECT_TRUE(selected().empty());
}

TEST_F(Parallel, ClickAndHoverFindALine) {
    // In the middle of a gap, on a line that nothing else is near of: the firefly's, to the top of the luminances.
    const Index path = 77;
    const LineField& lines = canvas().lines();
    const double t = 0.9;
    const QPointF at(lines.xs[1] + t * (lines.xs[2] - lines.xs[1]), double(lines.ys[1][path]) + t * double(lines.ys[2][path] - lines.ys[1][path]));
    hover(at);
    ASSERT_TRUE(selection.hovered());
    EXPECT_EQ(selection.hovered()->path, pathId(dataset.paths(), path));
    EXPECT_TRUE(canvas().hoverText().contains("sample 77"));
    EXPECT_TRUE(canvas().hoverText().contains("depth  6"));
    EXPECT_TRUE(canvas().hoverText().contains("W/(sr m²)")) << canvas().hoverText().toStdString();
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, at.toPoint());
    EXPECT_EQ(selected(), std::vector<Index>{path});
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::ShiftModifier, at.toPoint());
    EXPECT_TRUE(selected().empty());
}

TEST_F(Parallel, ATitleIsDraggedToAnotherPlace) {
    drag({frame().x(0), 10}, {frame().x(2), 10});
    EXPECT_EQ(names(), (std::vector<QString>{"depth", "luminance", "sample", "last(v.label)"}));
    drag({frame().x(3), 10}, {frame().x(0), 10});
    EXPECT_EQ(names(), (std::vector<QString>{"last(v.label)", "depth", "luminance", "sample"}));
}

TEST_F(Parallel, KeysChooseMoveTurnScaleAndRemoveAxes) {
    canvas().setFocus();
    QTest::keyClick(&canvas(), Qt::Key_Right);
    QTest::keyClick(&canvas(), Qt::Key_Right);
    EXPECT_EQ(canvas().currentAxis(), 1u);
    QTest::keyClick(&canvas(), Qt::Key_L);
    EXPECT_TRUE(axis(1).isLog());
    QTest::keyClick(&canvas(), Qt::Key_L);
    QTest::keyClick(&canvas(), Qt::Key_I);
    EXPECT_TRUE(axis(1).wish.flipped);
    EXPECT_GT(on(1, 3).y(), on(1, 2).y());
    QTest::keyClick(&canvas(), Qt::Key_Right, Qt::ShiftModifier);
    EXPECT_EQ(names()[2], "depth");
    QTest::keyClick(&canvas(), Qt::Key_Delete);
    EXPECT_EQ(names(), (std::vector<QString>{"sample", "luminance", "last(v.label)"}));
}

TEST_F(Parallel, SmallButtonsOfAnAxisUnderTheMouse) {
    hover({frame().x(1), 10});
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, canvas().chipRect(1, ParallelCanvas::Chip::log).center().toPoint());
    EXPECT_TRUE(axis(1).isLog());
    hover({frame().x(1), 12});
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, canvas().chipRect(1, ParallelCanvas::Chip::flip).center().toPoint());
    EXPECT_TRUE(axis(1).wish.flipped);
    hover({frame().x(1), 10});
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, canvas().chipRect(1, ParallelCanvas::Chip::remove).center().toPoint());
    EXPECT_EQ(names(), (std::vector<QString>{"sample", "luminance", "last(v.label)"}));
}

TEST_F(Parallel, AxesAreTypedAndWhatIsNoneIsSaid) {
    plot.addField().setFocus();
    QTest::keyClicks(&plot.addField(), "max(v.`bsdf pdf`)");
    plot.addField().findChild<QCompleter*>()->popup()->hide();
    QTest::keyClick(&plot.addField(), Qt::Key_Return);
    ASSERT_EQ(plot.axes().size(), 5u);
    EXPECT_EQ(axis(4).wish.expression, "max(v.`bsdf pdf`)");
    EXPECT_TRUE(plot.addField().text().isEmpty());
    for (const char* wrong : {"estimate", "v.depth", "max("}) {
        plot.addField().setText(wrong);
        QTest::keyClick(&plot.addField(), Qt::Key_Return);
        EXPECT_EQ(plot.axes().size(), 5u) << wrong;
        EXPECT_FALSE(plot.summaryText().isEmpty());
        EXPECT_EQ(plot.summaryText().indexOf("paths"), -1) << plot.summaryText().toStdString();
    }
    plot.addField().clear();
}

/// Everything that the list offers can stand on an axis.
TEST_F(Parallel, SuggestionsAreAxes) {
    for (const AxisSuggestion& suggestion : axisSuggestions(dataset.paths())) {
        ParallelAxes axes;
        axes.setPaths(dataset.paths());
        const auto added = axes.add({suggestion.expression});
        EXPECT_TRUE(added.ok()) << suggestion.expression.toStdString() << ": " << (added.ok() ? "" : added.error().message);
    }
}

TEST_F(Parallel, AxesAreRemembered) {
    plot.setAxes({{"luminance", true, true}, {"max(v.`bsdf pdf`)"}, {"max("}});
    EXPECT_EQ(plot.axes().size(), 2u) << "\"max(\" is no expression";
    const QString text = plot.layoutText();
    ParallelPlot other(dataset, selection, theme);
    other.setLayoutText(text);
    EXPECT_EQ(other.axes().wishes(), plot.axes().wishes());
    other.setLayoutText("{broken");
    EXPECT_EQ(other.axes().wishes(), ParallelAxes::defaults());
}

TEST_F(Parallel, SelectionAndMouseDrawNoLineAgain) {
    canvas().grab();
    const auto drawn = canvas().drawnLayers();
    selection.setPaths({pathId(dataset.paths(), 3), pathId(dataset.paths(), 4)});
    hover({frame().x(1) + 40, 200});
    canvas().grab();
    EXPECT_EQ(canvas().drawnLayers(), drawn);
}

TEST_F(Parallel, WhileHiddenNothingIsComputed) {
    plot.hide();
    dataset.addTrace(test::traceOf(test::fakePaths({.samples = 50})));
    EXPECT_EQ(axis(0).values.size(), 200u);
    plot.show();
    EXPECT_EQ(axis(0).values.size(), 50u);
}

TEST_F(Parallel, CopiesAndExportsItsValues) {
    canvas().setFocus();
    QTest::keyClick(&canvas(), Qt::Key_C, Qt::ControlModifier);
    const QStringList lines = QApplication::clipboard()->text().split('\n');
    ASSERT_EQ(lines.size(), 202);
    EXPECT_EQ(lines[0], "pixel x\tpixel y\tsample\tpart\tsample\tdepth\tluminance\tlast(v.label)");
    EXPECT_TRUE(lines[78].startsWith("174\t169\t77\t0\t77\t6\t")) << lines[78].toStdString();
    QTemporaryDir folder;
    for (const auto& [name, scale] : {std::pair{"one.png", 1}, {"two.png", 2}}) {
        ASSERT_TRUE(plot.exportTo(folder.filePath(name), scale).ok());
        EXPECT_EQ(QImage(folder.filePath(name)).size(), canvas().size() * scale);
    }
    ASSERT_TRUE(plot.exportTo(folder.filePath("plot.svg")).ok());
    QFile svg(folder.filePath("plot.svg"));
    ASSERT_TRUE(svg.open(QIODevice::ReadOnly));
    const QString drawing = QString::fromUtf8(svg.readAll());
    EXPECT_TRUE(drawing.contains("luminance")) << "titles are text";
    EXPECT_GE(drawing.count("<polyline"), 200) << "lines are lines";
    ASSERT_TRUE(plot.exportTo(folder.filePath("plot.csv")).ok());
    EXPECT_FALSE(plot.exportTo("/absent/plot.svg").ok());
}

TEST_F(Parallel, MenuOfAnAxisFiltersByItsRange) {
    brushDepth(2, 3);
    drag(on(0, 20), on(0, 120));
    QTimer::singleShot(0, [&] {
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        ASSERT_NE(menu, nullptr);
        for (QAction* action : menu->actions())
            if (action->text() == "Filter by this range") {
                menu->setActiveAction(action);
                QTest::keyClick(menu, Qt::Key_Return);
            }
        menu->close();
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, QPoint(int(frame().x(1)), 10), canvas().mapToGlobal(QPoint(int(frame().x(1)), 10)));
    QApplication::sendEvent(&canvas(), &event);
    EXPECT_EQ(wantedQuery, "depth >= 2 and depth <= 3") << "of this axis alone";
}

TEST(ParallelEmpty, SaysWhatToDo) {
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    ParallelPlot plot(dataset, selection, theme);
    plot.resize(600, 300);
    plot.show();
    auto* overlay = plot.canvas().findChild<StateOverlay*>();
    ASSERT_NE(overlay, nullptr);
    EXPECT_EQ(overlay->sentence(), "Click a pixel in the image");
    dataset.addTrace(test::traceOf(test::fakePaths({.samples = 4})));
    EXPECT_EQ(overlay->sentence(), "");
    plot.setAxes({});
    EXPECT_FALSE(overlay->sentence().isEmpty());
}

/// Pictures for people: emca-explorer's look without a window. Written where EMCA_PICTURES says.
TEST(ParallelPictures, OfManyAndOfFew) {
    const QString folder = qEnvironmentVariable("EMCA_PICTURES");
    if (folder.isEmpty()) GTEST_SKIP() << "set EMCA_PICTURES to a folder to write them";
    for (const std::uint32_t samples : {64u, 1024u, 65536u})
        for (const ThemeKind kind : {ThemeKind::dark, ThemeKind::light}) {
            client::Dataset dataset;
            client::Selection selection;
            Theme theme(kind);
            theme.applyTo(*qApp);
            dataset.addTrace(test::traceOf(test::fakePaths({.samples = samples, .vertices = 0, .firefly = 17})));
            ParallelPlot plot(dataset, selection, theme);
            plot.resize(760, 430);
            plot.show();
            const QString name = QStringLiteral("%1/parallel-%2-%3").arg(folder, kind == ThemeKind::dark ? "dark" : "light").arg(samples);
            plot.grab().save(name + "-all.png");
            const ParallelFrame& frame = plot.canvas().frame();
            const QPoint from(int(frame.x(3)), int(frame.top() + 20)), to(int(frame.x(3)), int(frame.top() + 90));
            QTest::mousePress(&plot.canvas(), Qt::LeftButton, {}, from);
            QTest::mouseMove(&plot.canvas(), to);
            QMouseEvent move(QEvent::MouseMove, to, plot.canvas().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
            QApplication::sendEvent(&plot.canvas(), &move);
            QTest::mouseRelease(&plot.canvas(), Qt::LeftButton, {}, to);
            plot.grab().save(name + "-marked.png");
        }
}

}  // namespace
}  // namespace emca::explorer
