#include "paths/filter_panel.h"

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <QToolButton>

#include "base/path_ids.h"
#include "base/theme.h"
#include "paths/query_field.h"
#include "paths/rule_row.h"
#include "paths/test_paths.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

using client::PathId;
using test::fakePaths;

class FilterPanelTest : public testing::Test {
  protected:
    FilterPanelTest() : panel(dataset, selection, theme) {
        panel.resize(340, 620);
        panel.show();
        QApplication::setActiveWindow(&panel);
    }
    void showPaths(int firefly = 417, Pixel pixel = {174, 169}) {
        dataset.addTrace(test::traceOf(fakePaths({.pixel = pixel, .samples = 1024, .vertices = 0, .firefly = firefly}), pixel));
    }
    void write(const QString& text) {
        panel.field().setFocus();
        QTest::keyClicks(&panel.field(), text);
    }
    QPushButton* button(const QString& text) {
        for (QPushButton* made : panel.findChildren<QPushButton*>())
            if (made->text() == text) return made;
        return nullptr;
    }
    void addRow() { QTest::mouseClick(panel.findChild<QToolButton*>("addRule"), Qt::LeftButton); }
    static void choose(QComboBox& box, const QString& text) {
        const int wanted = box.findText(text);
        ASSERT_GE(wanted, 0) << text.toStdString();
        box.setFocus();
        while (box.currentIndex() < wanted) QTest::keyClick(&box, Qt::Key_Down);
        while (box.currentIndex() > wanted) QTest::keyClick(&box, Qt::Key_Up);
    }
    PathId id(std::int64_t sample, Pixel pixel = {174, 169}) const { return {pixel, sample, 0}; }
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    FilterPanel panel;
};

TEST_F(FilterPanelTest, AQueryThatIsTypedCountsAndEnterSelects) {
    showPaths();
    write("luminance > 20 * mean(luminance)");
    EXPECT_EQ(panel.countText(), "1 of 1,024 paths");
    EXPECT_TRUE(selection.state().paths.empty()) << "counting is not selecting";
    QTest::keyClick(&panel.field(), Qt::Key_Return);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)});
    QTest::mouseClick(button("Clear"), Qt::LeftButton);
    EXPECT_TRUE(panel.queryText().isEmpty());
    EXPECT_TRUE(selection.state().paths.empty());
    EXPECT_TRUE(panel.countText().isEmpty());
}

TEST_F(FilterPanelTest, TheButtonSelects) {
    showPaths();
    EXPECT_FALSE(button("Select in views")->isEnabled());
    write("any(v.`bsdf pdf` < 1e-4)");
    EXPECT_TRUE(button("Select in views")->isEnabled());
    QTest::mouseClick(button("Select in views"), Qt::LeftButton);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)});
}

TEST_F(FilterPanelTest, TheWrongPieceIsUnderlined) {
    showPaths();
    write(QString::fromUtf8("v.label == \"Öl\" < 3"));
    EXPECT_EQ(panel.model().state(), FilterModel::State::failed);
    const std::string bytes = panel.field().text();
    const auto where = panel.model().error().where;
    EXPECT_EQ(panel.field().underlined(), QString::fromStdString(bytes.substr(where.begin, where.end - where.begin))) << "places are bytes, not characters";
    EXPECT_TRUE(panel.countText().isEmpty());
    EXPECT_FALSE(button("Select in views")->isEnabled());
    QTest::keyClick(&panel.field(), Qt::Key_A, Qt::ControlModifier);
    write("depth >");
    EXPECT_EQ(panel.field().underlined(), ">") << "what ends too early is marked at its end";
    write(" 1");
    EXPECT_TRUE(panel.field().underlined().isEmpty());
    EXPECT_EQ(panel.model().state(), FilterModel::State::done);
    write(" and luminance");
    EXPECT_FALSE(panel.field().underlined().isEmpty()) << "types are known from the paths";
}

TEST_F(FilterPanelTest, UnknownAndMissingAreSaid) {
    showPaths();
    write("any(v.nobody > 1)");
    EXPECT_EQ(panel.countText(), "0 of 1,024 paths");
    EXPECT_TRUE(panel.noteText().contains("1,024 unknown")) << panel.noteText().toStdString();
    EXPECT_TRUE(panel.noteText().contains("No path has") && panel.noteText().contains("nobody")) << panel.noteText().toStdString();
}

TEST_F(FilterPanelTest, RulesWriteTheQuery) {
    showPaths();
    addRow();
    ASSERT_EQ(panel.rowCount(), 1u);
    RuleRow& first = panel.row(0);
    EXPECT_TRUE(first.quantity().hasFocus());
    QTest::keyClicks(&first.quantity(), "v.`bsdf pdf`");
    EXPECT_TRUE(first.over().isVisible());
    choose(first.op(), "<");
    QTest::keyClicks(&first.value(), "1e-4");
    EXPECT_EQ(panel.queryText(), "any(v.`bsdf pdf` < 1e-4)");
    EXPECT_EQ(panel.countText(), "1 of 1,024 paths");
    addRow();
    RuleRow& second = panel.row(1);
    QTest::keyClicks(&second.quantity(), "depth");
    EXPECT_FALSE(second.over().isVisible()) << "a path has one depth";
    QTest::keyClicks(&second.value(), "3");
    EXPECT_EQ(panel.queryText(), "any(v.`bsdf pdf` < 1e-4) and depth > 3");
    QTest::mouseClick(&first.removal(), Qt::LeftButton);
    EXPECT_EQ(panel.queryText(), "depth > 3");
    QTest::mouseClick(&second.removal(), Qt::LeftButton);
    EXPECT_EQ(panel.queryText(), "");
    EXPECT_EQ(panel.model().state(), FilterModel::State::empty);
}

TEST_F(FilterPanelTest, OperatorsFitTheType) {
    showPaths();
    addRow();
    RuleRow& row = panel.row(0);
    const auto offers = [&](const char* op) { return row.op().findText(op) >= 0; };
    QTest::keyClicks(&row.quantity(), "v.label");
    EXPECT_TRUE(offers("contains"));
    EXPECT_FALSE(offers("<"));
    row.quantity().selectAll();
    QTest::keyClicks(&row.quantity(), "luminance");
    EXPECT_TRUE(offers("<"));
    EXPECT_FALSE(offers("contains"));
    row.quantity().selectAll();
    QTest::keyClicks(&row.quantity(), "`ended by roulette`");
    EXPECT_TRUE(offers("is true"));
    EXPECT_FALSE(row.value().isVisible()) << "nothing to compare with";
}

TEST_F(FilterPanelTest, KeysAndTextsAreCompleted) {
    showPaths();
    addRow();
    RuleRow& row = panel.row(0);
    QTest::keyClicks(&row.quantity(), "why");
    QAbstractItemView* popup = row.quantity().completer()->popup();
    ASSERT_TRUE(waitFor([&] { return popup->isVisible(); }));
    QTest::keyClick(popup, Qt::Key_Down);
    QTest::keyClick(popup, Qt::Key_Return);
    EXPECT_EQ(row.quantity().text(), "`why it ended`");
    row.quantity().setText("");
    QTest::keyClicks(&row.quantity(), "v.label");
    row.quantity().completer()->popup()->hide();
    row.value().setFocus();
    QTest::keyClick(&row.value(), Qt::Key_Down);
    QAbstractItemView* texts = row.value().completer()->popup();
    ASSERT_TRUE(waitFor([&] { return texts->isVisible(); }));
    QStringList offered;
    for (const auto& choice : row.value().choices()) offered += choice.text;
    EXPECT_EQ(offered.front(), "white wall") << "the most frequent first";
    EXPECT_TRUE(offered.contains("tinted glass") && offered.contains("lamp"));
    QTest::keyClicks(texts, "glass");
    QTest::keyClick(texts, Qt::Key_Down);
    QTest::keyClick(texts, Qt::Key_Return);
    EXPECT_EQ(panel.queryText(), "any(v.label == \"tinted glass\")");
}

TEST_F(FilterPanelTest, EditingByHandGreysTheRules) {
    showPaths();
    panel.addRule({"depth", {}, query::RuleOperator::greater, "3"});
    EXPECT_EQ(panel.queryText(), "depth > 3");
    panel.field().moveCursor(QTextCursor::End);
    write(" or true");
    EXPECT_TRUE(panel.isEditedByHand());
    EXPECT_FALSE(panel.row(0).isEnabled());
    EXPECT_EQ(panel.countText(), "1,024 of 1,024 paths");
    auto* back = panel.findChild<QPushButton*>("backToRules");
    ASSERT_TRUE(back->isVisible());
    QTest::mouseClick(back, Qt::LeftButton);
    EXPECT_FALSE(panel.isEditedByHand());
    EXPECT_TRUE(panel.row(0).isEnabled());
    EXPECT_EQ(panel.queryText(), "depth > 3");  // what was written by hand, the window's history has
}

TEST_F(FilterPanelTest, AWrongRuleIsSaidAndLeavesTheQuery) {
    showPaths();
    panel.addRule({"depth", {}, query::RuleOperator::greater, "3"});
    panel.row(0).value().setFocus();
    QTest::keyClicks(&panel.row(0).value(), " +");
    EXPECT_EQ(panel.queryText(), "depth > 3");
    bool said = false;
    for (QLabel* label : panel.findChildren<QLabel*>()) said = said || (label->isVisible() && label->text().startsWith("Rule:"));
    EXPECT_TRUE(said);
}

TEST_F(FilterPanelTest, AppliesToNewPixelsByItself) {
    write("luminance > 20 * mean(luminance)");
    EXPECT_TRUE(panel.countText().isEmpty());
    EXPECT_TRUE(panel.noteText().contains("Click a pixel"));
    QTest::mouseClick(panel.findChild<QCheckBox*>(), Qt::LeftButton, {}, QPoint(8, panel.findChild<QCheckBox*>()->height() / 2));
    ASSERT_TRUE(panel.isAutomatic());
    showPaths(417);
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)});
    showPaths(9, {1, 2});
    EXPECT_EQ(selection.state().paths, (std::vector<PathId>{id(9, {1, 2})}));
}

TEST_F(FilterPanelTest, LargeSetsAreAskedInAnotherThread) {
    dataset.addTrace(test::traceOf(fakePaths({.samples = 8192, .firefly = 417})));
    write("luminance > 20 * mean(luminance)");
    EXPECT_EQ(panel.model().state(), FilterModel::State::running);
    QTest::keyClick(&panel.field(), Qt::Key_Return);
    EXPECT_TRUE(selection.state().paths.empty());
    ASSERT_TRUE(waitFor([&] { return panel.isSettled(); }));
    EXPECT_EQ(panel.countText(), "1 of 8,192 paths");
    EXPECT_EQ(selection.state().paths, std::vector<PathId>{id(417)}) << "selected when it was known";
    // Only the last question is answered.
    panel.setQueryText("depth > 0");
    panel.setQueryText("depth < 0");
    ASSERT_TRUE(waitFor([&] { return panel.isSettled(); }));
    EXPECT_EQ(panel.countText(), "0 of 8,192 paths");
    panel.setQueryText("depth > 0");  // and what still runs when the view goes is waited for
}

TEST_F(FilterPanelTest, RulesSurviveNewPixelsAndOldOnes) {
    panel.addRule({"v.`bsdf pdf`", query::Quantifier::any, query::RuleOperator::less, "1e-4"});
    showPaths();
    EXPECT_EQ(panel.queryText(), "any(v.`bsdf pdf` < 1e-4)");
    EXPECT_EQ(panel.countText(), "1 of 1,024 paths");
    dataset.addTrace(test::traceOf({}));
    EXPECT_EQ(panel.queryText(), "any(v.`bsdf pdf` < 1e-4)");
    showPaths();
    EXPECT_EQ(panel.countText(), "1 of 1,024 paths");
}

}  // namespace
}  // namespace emca::explorer
