#include "window/edit_history.h"

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QAction>
#include <QCheckBox>
#include <QCompleter>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>

#include "base/path_ids.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "paths/filter_panel.h"
#include "paths/query_field.h"
#include "paths/rule_row.h"
#include "testing/program.h"

namespace emca::explorer {
namespace {

class EditHistoryTest : public MainWindowTest {
  protected:
    void SetUp() override {
        program = std::make_unique<Program>(settingsFile());
        connectTo(*program);
        click({7, 5});
        program->window->showDock("filter");
        filter().field().setFocus();
    }
    FilterPanel& filter() { return *program->window->views().filter; }
    void click(Pixel pixel) {
        ImageCanvas& canvas = program->window->views().image->canvas();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint());
        ASSERT_TRUE(waitFor([&] {
            return !program->dataset.paths().empty() && program->dataset.paths().pixel(0) == pixel && program->window->isSettled();
        }));
    }
    QWidget& focus() { return QApplication::focusWidget() ? *QApplication::focusWidget() : *program->window; }
    void undo() { QTest::keyClick(&focus(), Qt::Key_Z, Qt::ControlModifier); }
    void redo() { QTest::keyClick(&focus(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier); }
    const client::Selection::State& selection() { return program->selection.state(); }
    std::unique_ptr<Program> program;
};

TEST_F(EditHistoryTest, SelectionAndFilterAreOneHistory) {
    QTest::keyClicks(&filter().field(), "luminance > 0.4");
    QTest::keyClick(&filter().field(), Qt::Key_Return);
    ASSERT_EQ(selection().paths, (std::vector<client::PathId>{{{7, 5}, 2, 0}}));
    QTest::keyClick(&filter().field(), Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&filter().field(), "depth == 2");
    undo();                                       // the text, as it was before it was replaced
    undo();
    undo();
    EXPECT_EQ(filter().queryText(), "luminance > 0.4");
    EXPECT_EQ(selection().paths.size(), 1u);
    undo();                                       // Return
    EXPECT_TRUE(selection().paths.empty());
    EXPECT_EQ(filter().queryText(), "luminance > 0.4");
    redo();
    EXPECT_EQ(selection().paths.size(), 1u);
    undo();
    undo();
    EXPECT_EQ(filter().queryText(), "luminance > ") << "a word is a step";
    undo();
    EXPECT_EQ(filter().queryText(), "luminance ");
    undo();
    EXPECT_EQ(filter().queryText(), "");
    EXPECT_EQ(filter().countText(), "");
    for (int i = 0; i < 20; ++i) redo();
    EXPECT_EQ(filter().queryText(), "depth == 2");
    EXPECT_EQ(filter().countText(), "4 of 4 paths");
    EXPECT_FALSE(program->window->action("redo")->isEnabled());
}

TEST_F(EditHistoryTest, RulesComeAndGoWithTheirTexts) {
    QTest::mouseClick(filter().findChild<QToolButton*>("addRule"), Qt::LeftButton);
    QTest::keyClicks(&filter().row(0).quantity(), "luminance");
    filter().row(0).quantity().completer()->popup()->hide();   // the list of names
    filter().row(0).value().setFocus();
    QTest::keyClicks(&filter().row(0).value(), "0.4");
    EXPECT_EQ(filter().queryText(), "luminance > 0.4");
    undo();
    EXPECT_EQ(filter().rowCount(), 1u);
    EXPECT_EQ(filter().row(0).value().text(), "");
    EXPECT_EQ(&focus(), &filter().row(0).value()) << "what is undone in a field leaves one in it";
    redo();
    EXPECT_EQ(filter().queryText(), "luminance > 0.4");
    undo();
    undo();
    undo();
    EXPECT_EQ(filter().rowCount(), 0u);
    redo();
    redo();
    redo();
    EXPECT_EQ(filter().queryText(), "luminance > 0.4");
    EXPECT_EQ(filter().countText(), "1 of 4 paths");
}

TEST_F(EditHistoryTest, ClearIsOneStepAndBringsBackWhatItTook) {
    filter().addRule({"luminance", {}, query::RuleOperator::greater, "0.4"});
    filter().setAutomatic(true);
    ASSERT_EQ(selection().paths.size(), 1u);
    const client::SavedFilter before = filter().state();
    for (QPushButton* button : filter().findChildren<QPushButton*>())
        if (button->text() == "Clear") QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_EQ(filter().rowCount(), 0u);
    EXPECT_TRUE(selection().paths.empty());
    undo();
    EXPECT_EQ(filter().state(), before);
    EXPECT_EQ(selection().paths.size(), 1u);
}

TEST_F(EditHistoryTest, PathsThatGoWithTheirPixelAreNoStep) {
    program->selection.setPaths({pathId(program->dataset.paths(), 1)});
    click({3, 4});
    EXPECT_TRUE(selection().paths.empty());
    program->window->views().image->canvas().setFocus();
    undo();
    EXPECT_EQ(selection().pixel, (Pixel{7, 5}));
    EXPECT_EQ(selection().paths.size(), 1u) << "one step back is the whole click";
    EXPECT_EQ(program->dataset.paths().pixel(0), (Pixel{7, 5})) << "and its paths are here";
    redo();
    EXPECT_EQ(selection().pixel, (Pixel{3, 4}));
}

}  // namespace
}  // namespace emca::explorer
