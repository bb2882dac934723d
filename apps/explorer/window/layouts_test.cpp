#include "window/layouts.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QTabBar>
#include <QTableView>

#include "paths/vertex_table.h"
#include "paths/vertex_table_model.h"
#include "plots/path_plot.h"
#include "scene/scene_view.h"
#include "testing/program.h"
#include "window/layout_plan.h"
#include "window/panel_dock.h"

namespace emca::explorer {
namespace {

class LayoutsTest : public MainWindowTest {
  protected:
    static bool shows(const Program& program, const QString& dock) { return program.window->dock(dock)->isVisibleTo(program.window.get()); }
    /// In front of its tabs.
    static bool seen(const Program& program, const QString& dock) { return !program.window->dock(dock)->visibleRegion().isEmpty(); }
    static void key(Program& program, Qt::Key key) {
        QTest::keyClick(program.window.get(), key, Qt::ControlModifier);
        QTest::qWait(30);
    }
};

TEST_F(LayoutsTest, PresetsAreAKeyAway) {
    Program program(settingsFile());
    key(program, Qt::Key_2);
    EXPECT_TRUE(seen(program, "plots-luminance"));
    EXPECT_TRUE(seen(program, "outliers"));
    EXPECT_TRUE(seen(program, "vertex"));
    EXPECT_FALSE(shows(program, "sceneOptions"));
    key(program, Qt::Key_3);
    EXPECT_TRUE(seen(program, "history"));
    EXPECT_GT(program.window->dock("image")->width(), program.window->width() * 2 / 5) << "the image takes most";
    EXPECT_FALSE(shows(program, "paths"));
    key(program, Qt::Key_4);
    EXPECT_TRUE(seen(program, "notes"));
    EXPECT_GT(program.window->dock("scene")->width(), program.window->width() / 2);
    EXPECT_FALSE(shows(program, "outliers"));
    // What a preset hides can be called at any time.
    program.window->showDock("outliers");
    QTest::qWait(30);
    EXPECT_TRUE(seen(program, "outliers"));
    key(program, Qt::Key_1);
    for (const auto& [name, dock] : program.window->docks()) EXPECT_TRUE(shows(program, name)) << name.toStdString();
    EXPECT_TRUE(seen(program, "outliers"));
}

TEST_F(LayoutsTest, EveryDockThatAPlanNamesExists) {
    Program program(settingsFile());
    QStringList actions;
    for (const LayoutPlan& plan : layoutPlans()) {
        ASSERT_TRUE(program.window->action("layout-" + plan.name)) << plan.name.toStdString();
        int rest = 0;
        for (const auto& column : plan.columns)
            for (const auto& row : column.rows)
                for (const auto& cell : row.cells) {
                    rest += cell.rest;
                    for (const QString& name : cell.docks) EXPECT_TRUE(name.startsWith("plugin-") || program.window->dock(name)) << plan.name.toStdString() << ": " << name.toStdString();
                }
        EXPECT_EQ(rest, 1) << "new docks have a place in " << plan.name.toStdString();
    }
}

TEST_F(LayoutsTest, OwnLayoutsAreSavedNamedAndRemoved) {
    {
        Program program(settingsFile());
        program.window->dock("paths")->hide();
        program.window->views().plots[0].widget->setLog(true);
        SceneOptions options = program.window->views().scene->options();
        options.lineWidth = 3.5f;
        options.arrows = false;
        program.window->views().scene->setOptions(options);
        program.window->action("saveLayout")->trigger();
        auto* field = program.window->findChild<QLineEdit*>("name");
        ASSERT_TRUE(field && field->isVisible());
        field->selectAll();
        QTest::keyClicks(field, "Lecture 3 / glass & fog");
        QTest::keyClick(field, Qt::Key_Return);
        EXPECT_FALSE(field->isVisible());
        EXPECT_EQ(program.window->layouts().own(), QStringList{"Lecture 3 / glass & fog"});
        QApplication::setActiveWindow(program.window.get());
        key(program, Qt::Key_1);
        EXPECT_TRUE(shows(program, "paths"));
        options.lineWidth = 1;
        program.window->views().scene->setOptions(options);
        program.window->views().plots[0].widget->setLog(false);
        program.window->close();
    }
    Program program(settingsFile());
    EXPECT_TRUE(shows(program, "paths")) << "as it was left";
    EXPECT_FLOAT_EQ(program.window->views().scene->options().lineWidth, 1);
    key(program, Qt::Key_5);
    EXPECT_FALSE(shows(program, "paths"));
    EXPECT_TRUE(program.window->views().plots[0].widget->isLog());
    EXPECT_FLOAT_EQ(program.window->views().scene->options().lineWidth, 3.5f);
    EXPECT_FALSE(program.window->views().scene->options().arrows);
    program.window->layouts().remove("Lecture 3 / glass & fog");
    EXPECT_TRUE(program.window->layouts().own().isEmpty());
    EXPECT_FALSE(program.window->layouts().apply("Lecture 3 / glass & fog"));
}

TEST_F(LayoutsTest, PlacesSizesTabsAndColumnsOutliveTheProgram) {
    int width = 0;
    {
        Program program(settingsFile());
        program.window->showDock("plots-depth");
        program.window->showDock("notes");
        program.window->resizeDocks({program.window->dock("image"), program.window->dock("scene")}, {500, 700}, Qt::Horizontal);
        QTest::qWait(30);
        width = program.window->dock("image")->width();
        program.window->views().vertex->findChild<QTableView*>()->horizontalHeader()->resizeSection(VertexTableModel::kQuantity, 222);
        program.window->close();
    }
    Program program(settingsFile());
    QTest::qWait(50);
    EXPECT_NEAR(program.window->dock("image")->width(), width, 4);
    EXPECT_TRUE(seen(program, "plots-depth"));
    EXPECT_TRUE(seen(program, "notes"));
    EXPECT_EQ(program.window->views().vertex->findChild<QTableView*>()->horizontalHeader()->sectionSize(VertexTableModel::kQuantity), 222);
}

/// A window with docks of its own, as plugins bring them.
struct Docks {
    QMainWindow window;
    std::vector<PanelDock*> docks;
    void add(const QString& name) {
        docks.push_back(new PanelDock(name, name, new QLabel(name), &window));
        window.addDockWidget(Qt::LeftDockWidgetArea, docks.back());
    }
    Layouts::Options none() { return {[] { return QVariantMap(); }, [](const QVariantMap&) {}}; }
};

TEST_F(LayoutsTest, ALayoutSurvivesADockThatIsMissingAndTakesOneThatIsNew) {
    QSettings settings(settingsFile(), QSettings::IniFormat);
    const auto make = [&](const QStringList& names) {
        auto made = std::make_unique<Docks>();
        made->window.resize(1200, 800);
        for (const QString& name : names) made->add(name);
        return made;
    };
    const auto layouts = [&](Docks& d) { return new Layouts(d.window, settings, [&d] { return d.docks; }, d.none(), &d.window); };
    {
        auto with = make({"image", "outliers", "plugin-x"});
        with->window.show();
        with->window.splitDockWidget(with->docks[0], with->docks[2], Qt::Horizontal);
        with->docks[1]->hide();
        layouts(*with)->keep();
    }
    {
        auto without = make({"image", "outliers", "filter"});
        without->window.show();
        Layouts* kept = layouts(*without);
        EXPECT_TRUE(kept->restore()) << "the plugin is gone, the rest stays";
        EXPECT_TRUE(without->docks[0]->isVisible());
        EXPECT_FALSE(without->docks[1]->isVisibleTo(&without->window));
        EXPECT_TRUE(without->docks[2]->isVisibleTo(&without->window)) << "what the layout does not know is shown";
        kept->keep();
    }
    auto again = make({"image", "outliers", "filter", "plugin-x"});
    again->window.show();
    EXPECT_TRUE(layouts(*again)->restore());
    QTest::qWait(30);
    EXPECT_TRUE(again->docks[3]->isVisible()) << "the plugin is back where it was";
    EXPECT_GT(again->docks[3]->x(), again->docks[0]->x());
    settings.setValue("window/state", QByteArray("no state"));
    EXPECT_FALSE(layouts(*again)->restore()) << "what is no layout changes nothing";
    EXPECT_TRUE(again->docks[3]->isVisible());
}

}  // namespace
}  // namespace emca::explorer
