#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>

#include <memory>

#include "emca/server/server.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"
#include "window/main_window.h"

namespace emca::explorer {

/// The program without its main(), on settings of its own.
struct Program {
    explicit Program(const QString& settingsFile) : settings(settingsFile, QSettings::IniFormat) {
        theme.applyTo(*qApp);
        window = std::make_unique<MainWindow>(dataset, selection, session, theme, settings);
        window->resize(1600, 900);
        window->show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(window.get()));
        // Without a window manager nobody else gives the focus, and shortcuts need it.
        QApplication::setActiveWindow(window.get());
    }
    QSettings settings;
    Theme theme;
    client::Dataset dataset;
    client::Selection selection;
    SessionController session{dataset, selection};
    std::unique_ptr<MainWindow> window;
};

class MainWindowTest : public testing::Test {
  protected:
    QString settingsFile() const { return folder.filePath("settings.ini"); }
    void connectTo(Program& program) {
        auto started = Server::start(renderer);
        ASSERT_TRUE(started);
        server = std::move(*started);
        program.window->connectTo({"127.0.0.1", server->port()});
        ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.window->isSettled() && program.dataset.currentImage(); }));
    }
    QTemporaryDir folder;
    FakeRenderer renderer;
    std::unique_ptr<Server> server;
};

}  // namespace emca::explorer
