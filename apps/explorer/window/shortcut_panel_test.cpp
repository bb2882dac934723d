#include "window/shortcut_panel.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenuBar>
#include <QTreeWidget>
#include <algorithm>
#include <map>

#include "base/view_keys.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "testing/program.h"

namespace emca::explorer {
namespace {

class ShortcutPanelTest : public MainWindowTest {
  protected:
    static QString textOf(const QAction& action) { return action.text().remove('&').remove(QStringLiteral("…")); }
};

TEST_F(ShortcutPanelTest, EveryActionWithAKeyIsListedAndNoTwoClash) {
    Program program(settingsFile());
    const auto entries = ShortcutPanel::entriesOf(*program.window);
    std::map<QString, QString> taken;
    int keys = 0;
    for (const QAction* action : program.window->findChildren<QAction*>()) {
        for (const QKeySequence& shortcut : action->shortcuts()) {
            if (shortcut.isEmpty()) continue;
            // Those of text fields (cut, paste) work in them alone.
            if (action->shortcutContext() == Qt::WidgetShortcut || action->shortcutContext() == Qt::WidgetWithChildrenShortcut) continue;
            ++keys;
            EXPECT_TRUE(std::ranges::any_of(entries, [&](const auto& entry) { return entry.action == action; })) << textOf(*action).toStdString();
            const auto [other, fresh] = taken.emplace(shortcut.toString(), textOf(*action));
            EXPECT_TRUE(fresh) << shortcut.toString().toStdString() << ": " << other->second.toStdString() << " and " << textOf(*action).toStdString();
        }
    }
    EXPECT_GT(keys, 25);
    for (const auto& entry : entries) EXPECT_FALSE(entry.text.isEmpty()) << entry.group.toStdString();
}

/// What views say of their keys is true: each one is taken, although the window may have it as well.
TEST_F(ShortcutPanelTest, EveryKeyThatAViewListsIsTakenByIt) {
    Program program(settingsFile());
    connectTo(program);
    program.selection.setPixel(Pixel{3, 4});
    ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.window->isSettled(); }));
    std::map<QString, QAction*> ofWindow;
    for (QAction* action : program.window->findChildren<QAction*>())
        for (const QKeySequence& shortcut : action->shortcuts())
            if (!shortcut.isEmpty() && action->shortcutContext() == Qt::WindowShortcut) ofWindow[shortcut.toString()] = action;
    QStringList titles;
    for (QWidget* widget : program.window->findChildren<QWidget*>()) {
        QString title;
        for (const ViewKey& key : viewKeys(*widget, &title)) {
            const QKeySequence sequence(key.keys);
            ASSERT_EQ(sequence.count(), 1) << key.keys.toStdString();
            const int code = sequence[0] & ~int(Qt::KeyboardModifierMask);
            const Qt::KeyboardModifiers modifiers(QFlag(sequence[0] & int(Qt::KeyboardModifierMask)));
            QKeyEvent press(QEvent::KeyPress, code, modifiers, modifiers || code > 255 ? QString() : QString(QChar(code)).toLower());
            QApplication::sendEvent(widget, &press);
            const std::string what = title.toStdString() + ": " + key.keys.toStdString();
            EXPECT_TRUE(press.isAccepted()) << what;
            QKeyEvent release(QEvent::KeyRelease, code, modifiers);
            QApplication::sendEvent(widget, &release);
            // A key of the window that the view does not claim never reaches it: then both have to mean the same.
            if (const auto found = ofWindow.find(sequence.toString()); found != ofWindow.end()) {
                QKeyEvent override(QEvent::ShortcutOverride, code, modifiers);
                override.ignore();
                QApplication::sendEvent(widget, &override);
                const bool same = QStringList{"F", "R", "Esc", "C", "N"}.contains(key.keys);
                EXPECT_TRUE(override.isAccepted() || same) << what << " is " << found->second->text().toStdString();
            }
        }
        if (!title.isEmpty()) titles << title;
    }
    for (const char* view : {"Image", "Scene", "Plots", "Paths", "Intersection"}) EXPECT_TRUE(titles.contains(view)) << view;
}

TEST_F(ShortcutPanelTest, WordsFindAndEnterDoesIt) {
    Program program(settingsFile());
    connectTo(program);
    MainWindow& window = *program.window;
    ImageCanvas& canvas = window.views().image->canvas();
    canvas.setFocus();
    QTest::keyClick(&canvas, Qt::Key_F1);
    ShortcutPanel& panel = window.shortcuts();
    ASSERT_TRUE(panel.isVisible());
    EXPECT_TRUE(panel.field().hasFocus());
    QStringList groups;
    for (int i = 0; i < panel.list().topLevelItemCount(); ++i) groups << panel.list().topLevelItem(i)->text(0);
    EXPECT_EQ(groups.removeDuplicates(), 0) << "a menu with another one in it is one group, and the other one the next";
    // Letters that are keys of the window are text here.
    QTest::keyClicks(&panel.field(), "light theme");
    QTest::keyClick(&panel.field(), Qt::Key_Return);
    EXPECT_FALSE(panel.isVisible());
    EXPECT_FALSE(program.theme.isDark());
    EXPECT_TRUE(canvas.hasFocus()) << "the focus comes back";
    QTest::keyClick(&canvas, Qt::Key_F1);
    QTest::keyClicks(&panel.field(), "ctrl+r");
    ASSERT_TRUE(panel.list().currentItem());
    EXPECT_EQ(panel.list().currentItem()->text(0), "Render");
    QTest::keyClick(&panel.field(), Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&panel.field(), "no such thing");
    EXPECT_FALSE(panel.list().isVisible());
    QTest::keyClick(&panel.field(), Qt::Key_Escape);
    EXPECT_FALSE(panel.isVisible());
    EXPECT_EQ(program.selection.state().pixel, std::nullopt);
    // A click does it too; a second F1 closes.
    QTest::keyClick(&canvas, Qt::Key_F1);
    QTest::keyClick(&panel.field(), Qt::Key_F1);
    EXPECT_FALSE(panel.isVisible());
    QTest::keyClick(&canvas, Qt::Key_F1);
    QTest::keyClicks(&panel.field(), "dark theme");
    QTreeWidgetItem* item = panel.list().currentItem();
    ASSERT_TRUE(item);
    QTest::mouseClick(panel.list().viewport(), Qt::LeftButton, {}, panel.list().visualItemRect(item).center());
    EXPECT_TRUE(program.theme.isDark());
}

}  // namespace
}  // namespace emca::explorer
