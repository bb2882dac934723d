// Everything that can be clicked or filled in says what it is for.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTabBar>
#include <QToolBar>

#include "paths/filter_panel.h"
#include "testing/layer_renderer.h"
#include "testing/program.h"
#include "window/connect_panel.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

class TooltipsTest : public MainWindowTest {
  protected:
    static bool isControl(const QWidget& widget) {
        return qobject_cast<const QAbstractButton*>(&widget) || qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QComboBox*>(&widget) ||
               qobject_cast<const QLineEdit*>(&widget) || qobject_cast<const QSlider*>(&widget) || qobject_cast<const QPlainTextEdit*>(&widget);
    }
    /// Inside of something that says it: the field of a spin box, the arrow of a line.
    static bool isPart(const QWidget& widget) {
        const QWidget* parent = widget.parentWidget();
        return widget.objectName().startsWith("qt_") || qobject_cast<const QAbstractSpinBox*>(parent) || qobject_cast<const QComboBox*>(parent) ||
               qobject_cast<const QLineEdit*>(parent) || qobject_cast<const QTabBar*>(parent) || qobject_cast<const QAbstractItemView*>(parent) ||
               qobject_cast<const QHeaderView*>(parent);
    }
    static std::string placeOf(const QWidget& widget) {
        QString text = widget.metaObject()->className();
        if (!widget.objectName().isEmpty()) text += " \"" + widget.objectName() + '"';
        if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) text += " [" + button->text() + ']';
        for (const QWidget* at = widget.parentWidget(); at; at = at->parentWidget())
            if (const auto* dock = qobject_cast<const PanelDock*>(at)) text += " in " + dock->objectName();
        return text.toStdString();
    }
    static void expectTips(const QWidget& inside, int& controls) {
        for (const QWidget* widget : inside.findChildren<QWidget*>()) {
            if (!widget->isVisibleTo(&inside)) continue;
            if (isControl(*widget) && !isPart(*widget)) {
                ++controls;
                EXPECT_FALSE(widget->toolTip().trimmed().isEmpty()) << placeOf(*widget);
            }
            const auto* header = qobject_cast<const QHeaderView*>(widget);
            if (!header || header->orientation() != Qt::Horizontal || !header->model()) continue;
            for (int section = 0; section < header->count(); ++section) {
                if (header->isSectionHidden(section)) continue;
                ++controls;
                EXPECT_FALSE(header->model()->headerData(section, Qt::Horizontal, Qt::ToolTipRole).toString().isEmpty())
                    << "column " << section << " of " << placeOf(*header);
            }
        }
    }
    LayerRenderer layered;
};

TEST_F(TooltipsTest, EveryControlAndColumnHasOne) {
    auto started = Server::start(layered);
    ASSERT_TRUE(started);
    server = std::move(*started);
    Program program(settingsFile());
    program.window->connectTo({"127.0.0.1", server->port()});
    ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.window->isSettled() && program.dataset.currentImage(); }));
    program.selection.setPixel(Pixel{7, 5});
    ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty() && program.window->isSettled(); }));
    program.window->views().filter->addRule({"v.throughput.r", {}, query::RuleOperator::greater, "1"});
    int controls = 0;
    // Each dock in front of its tabs in turn, so that what it hides while behind is seen.
    for (const auto& [name, dock] : program.window->docks()) {
        program.window->showDock(name);
        QTest::qWait(20);
        expectTips(*dock, controls);
    }
    for (const QToolBar* bar : program.window->findChildren<QToolBar*>()) expectTips(*bar, controls);
    expectTips(program.window->connectPanel(), controls);
    EXPECT_GT(controls, 70);
}

}  // namespace
}  // namespace emca::explorer
