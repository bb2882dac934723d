#include "window/notes_panel.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QListWidget>
#include <QPlainTextEdit>

#include "emca/client/session.h"
#include "paths/filter_panel.h"
#include "paths/query_field.h"
#include "testing/program.h"
#include "window/file_menu.h"
#include "window/notice_card.h"

namespace emca::explorer {
namespace {

class NotesPanelTest : public MainWindowTest {
  protected:
    static void write(QPlainTextEdit& where, const QString& text) {
        where.setFocus();
        QTest::keyClicks(&where, text);
    }
    void save(Program& program, const QString& file) {
        program.window->files().document().save(file);
        ASSERT_TRUE(waitFor([&] { return !program.session.isSavingSession(); }));
    }
    void open(Program& program, const QString& file) {
        program.window->files().open({file});
        ASSERT_TRUE(waitFor([&] { return !program.session.isOpeningSession() && program.window->isSettled(); }));
    }
};

TEST_F(NotesPanelTest, NotesOfSessionAndPixelsGoToAFileAndBack) {
    const QString file = folder.filePath("notes.emca");
    {
        Program program(settingsFile());
        connectTo(program);
        NotesPanel& notes = program.window->notes();
        program.window->showDock("notes");
        EXPECT_FALSE(notes.pixelNotes().isEnabled());
        EXPECT_TRUE(notes.pixelNotes().placeholderText().contains("Click a pixel"));
        EXPECT_FALSE(program.window->files().document().isModified());
        // Keys of the window (R, F, L, C, N, T, comma) are letters here.
        write(notes.sessionNotes(), "Fireflies, Tinted glass; Look, Clear, Nothing.");
        EXPECT_EQ(program.session.notes(), "Fireflies, Tinted glass; Look, Clear, Nothing.");
        EXPECT_TRUE(program.window->files().document().isModified());
        EXPECT_EQ(program.window->files().document().unsavedWork(), "notes");
        program.selection.setPixel(Pixel{7, 5});
        ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.window->isSettled(); }));
        write(notes.pixelNotes(), "pdf 1e-300");
        program.selection.setPixel(Pixel{2, 9});
        EXPECT_EQ(notes.pixelNotes().toPlainText(), "");
        write(notes.pixelNotes(), "fine");
        program.selection.setPixel(Pixel{3, 1});
        ASSERT_EQ(notes.list().count(), 2);
        QTest::mouseClick(notes.list().viewport(), Qt::LeftButton, {}, notes.list().visualItemRect(notes.list().item(0)).center());
        EXPECT_EQ(program.selection.state().pixel, (Pixel{7, 5})) << "by row";
        EXPECT_EQ(notes.pixelNotes().toPlainText(), "pdf 1e-300");
        save(program, file);
        EXPECT_FALSE(program.window->files().document().hasUnsavedNotes());
        write(notes.pixelNotes(), "!");
        EXPECT_TRUE(program.window->files().document().hasUnsavedNotes());
        program.window->close();
        EXPECT_TRUE(program.window->isVisible()) << "it asks";
        EXPECT_TRUE(program.window->files().card().text().contains("notes")) << program.window->files().card().text().toStdString();
    }
    Program program(settingsFile());
    open(program, file);
    EXPECT_FALSE(program.window->files().document().isModified());
    NotesPanel& notes = program.window->notes();
    EXPECT_EQ(notes.sessionNotes().toPlainText(), "Fireflies, Tinted glass; Look, Clear, Nothing.");
    EXPECT_EQ(notes.pixelNotes().toPlainText(), "pdf 1e-300");
    EXPECT_EQ(notes.list().count(), 2);
    // An empty note is none.
    notes.pixelNotes().selectAll();
    notes.pixelNotes().setFocus();
    QTest::keyClick(&notes.pixelNotes(), Qt::Key_Delete);
    EXPECT_EQ(notes.list().count(), 1);
    EXPECT_TRUE(program.window->files().document().hasUnsavedNotes());
}

TEST_F(NotesPanelTest, FiltersAreKeptInSessionsAndFromRunToRun) {
    const QString file = folder.filePath("filter.emca");
    client::SavedFilter saved;
    {
        Program program(settingsFile());
        connectTo(program);
        program.selection.setPixel(Pixel{7, 5});
        ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.window->isSettled(); }));
        FilterPanel& filter = *program.window->views().filter;
        program.window->showDock("filter");
        filter.addRule({"luminance", {}, query::RuleOperator::greater, "0.4"});
        filter.addRule({"v.throughput.r", query::Quantifier::last, query::RuleOperator::greaterEqual, "2"});
        filter.field().setFocus();
        filter.field().moveCursor(QTextCursor::End);
        QTest::keyClicks(&filter.field(), " and depth == 2");
        filter.setAutomatic(true);
        saved = filter.state();
        EXPECT_TRUE(saved.byHand);
        save(program, file);
        const auto opened = client::openSession(file.toStdString());
        ASSERT_TRUE(opened) << opened.error().message;
        EXPECT_EQ(opened->session.filter, saved);
        program.window->files().document().save(file);
        ASSERT_TRUE(waitFor([&] { return !program.session.isSavingSession(); }));
        program.window->close();
    }
    {
        Program program(settingsFile());
        FilterPanel& filter = *program.window->views().filter;
        EXPECT_EQ(filter.state(), saved) << "as it was left";
        EXPECT_FALSE(program.window->action("undo")->isEnabled());
        filter.clear();
        open(program, file);
        EXPECT_EQ(filter.state(), saved) << "as the session has it";
        EXPECT_EQ(filter.countText(), "1 of 4 paths");
        EXPECT_EQ(filter.rowCount(), 2u);
        filter.backToRules();
        EXPECT_TRUE(filter.queryText().startsWith("luminance > 0.4 and last(")) << filter.queryText().toStdString();
    }
}

}  // namespace
}  // namespace emca::explorer
