#pragma once

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <map>
#include <thread>

#include "emca/server/server.h"
#include "plugin/plugin_manager.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"

/// Plugins of all moods in a manager without a window, which notes what they want of one.
namespace emca::explorer {

inline void setMood(const char* mood) { qputenv("EMCA_TEST_MOOD", mood); }

inline QString pluginFile(const char* kind) { return QStringLiteral(EMCA_TEST_PLUGINS "/test_plugin_%1.so").arg(QLatin1String(kind)); }

/// Notes what plugins want of the window.
struct Services : PluginServices {
    std::map<std::string, SceneObject> objects;
    std::function<void(const std::string&, std::size_t)> picked;
    std::shared_ptr<client::Connection> link;
    QStringList said, errors;
    Result<void> setObject(const std::string& owner, const std::string& id, SceneObject object) override {
        if (object.name.empty()) return Error{ErrorCode::invalidArgument, "it needs a name"};
        objects[owner + "/" + id] = std::move(object);
        return {};
    }
    void removeObject(const std::string& owner, const std::string& id) override { objects.erase(owner + "/" + id); }
    void removeObjects(const std::string&) override { objects.clear(); }
    Subscription onPick(const std::string&, std::function<void(const std::string&, std::size_t)> wanted) override {
        picked = std::move(wanted);
        return Subscription([this] { picked = {}; });
    }
    std::shared_ptr<client::Connection> connection() override { return link; }
    void say(const QString& sentence) override { said << sentence; }
    void sayError(const QString& sentence) override { errors << sentence; }
};

/// Answers with what it was asked; "slow" takes its time.
struct Tool : ServerTool {
    explicit Tool(std::string name) : called(std::move(name)) {}
    std::string called;
    std::string name() const override { return called; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) override {
        while (called == "slow" && !monitor.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return std::vector<std::byte>(request.begin(), request.end());
    }
};

class PluginTest : public testing::Test {
  protected:
    void SetUp() override {
        setMood("");
        options.probeProgram = EMCA_PLUGIN_PROBE;
        options.blockLimit = std::chrono::milliseconds(200);
        begin();
    }
    void TearDown() override {
        setMood("");
        manager.reset();
    }
    void begin() {
        manager.reset();
        problems.clear();
        views.clear();
        manager = std::make_unique<PluginManager>(HostContext::Surroundings{dataset, selection, theme, services, settings}, options);
        QObject::connect(manager.get(), &PluginManager::problem, [this](const QString& sentence) { problems << sentence; });
        QObject::connect(manager.get(), &PluginManager::loaded, [this](PluginHost* host) {
            host->view()->resize(300, 200);
            host->view()->show();
            views.push_back(host->view());
        });
    }
    /// Looks for it and waits for the verdict.
    const PluginRecord& tried(const QString& file) {
        options.files = QStringList{file};
        begin();
        manager->start();
        EXPECT_TRUE(waitFor([&] { return manager->isSettled(); }));
        EXPECT_EQ(manager->records().size(), 1u);
        return *manager->records().front();
    }
    const PluginRecord& triedMoody() { return tried(pluginFile("moody")); }
    QString label() const {
        const auto* found = views.empty() ? nullptr : views.back()->findChild<QLabel*>("moodyLabel");
        return found ? found->text() : QString();
    }
    void press(const char* mood) {
        setMood(mood);
        auto* button = views.back()->findChild<QPushButton*>("moodyButton");
        ASSERT_NE(button, nullptr);
        QTest::mouseClick(button, Qt::LeftButton);
    }
    void connectToRenderer() {
        auto started = Server::start(renderer);
        ASSERT_TRUE(started);
        server = std::move(*started);
        for (const char* name : {"echo", "slow"}) ASSERT_TRUE(server->addTool(std::make_shared<Tool>(name)));
        auto opened = client::Connection::open({"127.0.0.1", server->port()});
        ASSERT_TRUE(opened);
        services.link = std::move(*opened);
        auto info = services.link->info();
        ASSERT_TRUE(info);
        dataset.setInfo(*info);
    }

    QTemporaryDir folder;
    QSettings settings{folder.filePath("settings.ini"), QSettings::IniFormat};
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    FakeRenderer renderer;
    std::unique_ptr<Server> server;
    Services services;
    PluginManager::Options options;
    std::unique_ptr<PluginManager> manager;
    std::vector<QPointer<PluginView>> views;
    QStringList problems;
};

}  // namespace emca::explorer
