// Plugins in the real window: their docks, selection both ways, objects in the 3D view, the page, and the end.
#include "window/window_plugins.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QMenu>
#include <QPushButton>

#include <atomic>
#include <chrono>
#include <thread>

#include "emca/explorer/plugin.h"
#include "scene/scene_objects.h"
#include "scene/scene_view.h"
#include "testing/cutting_proxy.h"
#include "testing/program.h"
#include "window/layouts.h"
#include "window/panel_dock.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

class WindowPluginsTest : public MainWindowTest {
  protected:
    void TearDown() override { qunsetenv("EMCA_TEST_MOOD"); }
    std::unique_ptr<WindowPlugins> load(Program& program, const QStringList& files) {
        PluginManager::Options options;
        options.files = files;
        options.probeProgram = EMCA_PLUGIN_PROBE;
        auto plugins = std::make_unique<WindowPlugins>(*program.window, program.dataset, program.selection, program.session, program.theme, program.settings, options);
        plugins->start();
        EXPECT_TRUE(waitFor([&] { return program.window->isSettled(); }));
        return plugins;
    }
    static QString file(const char* kind) { return QStringLiteral(EMCA_TEST_PLUGINS "/test_plugin_%1.so").arg(QLatin1String(kind)); }
    void press(Program& program, const char* mood) {
        qputenv("EMCA_TEST_MOOD", mood);
        auto* button = program.window->findChild<QPushButton*>("moodyButton");
        ASSERT_NE(button, nullptr);
        QTest::mouseClick(button, Qt::LeftButton);
    }
};

TEST_F(WindowPluginsTest, HasADockLinkedSelectionAndObjects) {
    Program program(settingsFile());
    const auto plugins = load(program, {file("moody")});
    PanelDock* dock = program.window->dock("plugin-moody");
    ASSERT_NE(dock, nullptr);
    program.window->showDock("plugin-moody");
    ASSERT_TRUE(waitFor([&] { return !dock->visibleRegion().isEmpty(); }));
    connectTo(program);
    program.selection.setPixel(Pixel{3, 4});
    ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == renderer.samplesPerPixel; }));
    auto* label = program.window->findChild<QLabel*>("moodyLabel");
    EXPECT_TRUE(label->text().startsWith("4 paths")) << label->text().toStdString();
    press(program, "select");
    EXPECT_TRUE(program.selection.state().vertex.has_value());
    press(program, "object");
    SceneObjects& objects = program.window->views().scene->objects();
    ASSERT_NE(objects.find({"moody", "bounds"}), nullptr);
    objects.pick({"moody", "bounds"}, 0);
    EXPECT_EQ(label->text(), "bounds0");
    press(program, "throw in click");
    EXPECT_EQ(objects.find({"moody", "bounds"}), nullptr);
    ASSERT_TRUE(waitFor([&] { return program.window->toast().sentence().contains("Moody"); }));
    // All else goes on.
    qputenv("EMCA_TEST_MOOD", "");
    program.selection.setPixel(Pixel{5, 6});
    EXPECT_TRUE(waitFor([&] { return program.dataset.current().size() == 1 && program.dataset.current()[0]->pixels[0] == Pixel{5, 6}; }));
    EXPECT_TRUE(plugins->manager().end());
}

/// A tool that answers when it is told to stop, and never before.
struct SlowTool : ServerTool {
    std::string name() const override { return "slow"; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte>, RequestMonitor& monitor) override {
        asked = true;
        while (!monitor.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return std::vector<std::byte>();
    }
    std::atomic<bool> asked{false};
};

TEST_F(WindowPluginsTest, AServerThatDiesWhileAPluginAsksIsSaidToIt) {
    auto started = Server::start(renderer);
    ASSERT_TRUE(started);
    server = std::move(*started);
    const auto tool = std::make_shared<SlowTool>();
    ASSERT_TRUE(server->addTool(tool));
    CuttingProxy proxy(server->port());
    Program program(settingsFile());
    const auto plugins = load(program, {file("moody")});
    program.window->showDock("plugin-moody");
    program.window->connectTo({"127.0.0.1", proxy.port()});
    ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.dataset.currentImage() && program.window->isSettled(); }));
    program.selection.setPixel(Pixel{3, 4});
    ASSERT_TRUE(waitFor([&] { return program.dataset.paths().pathCount() == renderer.samplesPerPixel; }));
    const auto before = program.dataset.current();
    press(program, "ask and wait");
    ASSERT_TRUE(waitFor([&] { return tool->asked.load(); }));
    auto* label = program.window->findChild<QLabel*>("moodyLabel");
    const QString text = label->text();
    proxy.cutNow();
    ASSERT_TRUE(waitFor([&] { return label->text() != text; }));
    EXPECT_TRUE(label->text().size() > 15 && label->text().endsWith('.')) << label->text().toStdString();
    qputenv("EMCA_TEST_MOOD", "");
    // Nothing is lost, the line comes back by itself, and all goes on.
    EXPECT_EQ(program.dataset.current(), before);
    ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.window->isSettled(); }));
    program.selection.setPixel(Pixel{5, 6});
    EXPECT_TRUE(waitFor([&] { return program.dataset.current().size() == 1 && program.dataset.current()[0]->pixels[0] == Pixel{5, 6}; }));
    EXPECT_TRUE(plugins->manager().end());
}

TEST_F(WindowPluginsTest, RefusedOnesAreNamedAndListed) {
    Program program(settingsFile());
    const auto plugins = load(program, {file("other_version")});
    EXPECT_TRUE(program.window->toast().sentence().contains("version 99")) << program.window->toast().sentence().toStdString();
    auto* toPage = program.window->toast().findChild<QPushButton*>();
    ASSERT_NE(toPage, nullptr);
    QTest::mouseClick(toPage, Qt::LeftButton);
    EXPECT_TRUE(waitFor([&] { return !program.window->dock("plugins")->visibleRegion().isEmpty(); }));
}

TEST_F(WindowPluginsTest, LayoutsBringTheirSettingsBack) {
    Program program(settingsFile());
    const auto plugins = load(program, {file("moody")});
    program.window->showDock("plugin-moody");
    ASSERT_TRUE(waitFor([&] { return program.window->findChild<QPushButton*>("moodyButton")->isVisible(); }));
    press(program, "set");
    program.window->layouts().saveAs("mine");
    program.settings.setValue("plugins/moody/word", "another");
    ASSERT_TRUE(program.window->layouts().apply("mine"));
    EXPECT_EQ(program.window->findChild<QLabel*>("moodyLabel")->text(), "kept");
}

TEST_F(WindowPluginsTest, TheWindowMayEndFirstOrLast) {
    {
        Program program(settingsFile());
        const auto plugins = load(program, {file("moody")});
        EXPECT_TRUE(plugins->manager().end());
    }
    auto program = std::make_unique<Program>(settingsFile());
    const auto plugins = load(*program, {file("moody")});
    program->window.reset();
    EXPECT_TRUE(plugins->manager().end());
}

}  // namespace
}  // namespace emca::explorer
