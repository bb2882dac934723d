#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QLabel>
#include <QPushButton>

#include <cmath>

#include "program/unattended.h"
#include "scene/scene_view.h"
#include "scene/surface_panel.h"
#include "testing/layer_renderer.h"
#include "testing/program.h"
#include "window/toast.h"

// Layers from the renderer to the picture: the real window, the real wire.
namespace emca::explorer {
namespace {

class SurfaceLayersTest : public testing::Test {
  protected:
    void start(Renderer& with) {
        auto started = Server::start(with);
        ASSERT_TRUE(started);
        server = std::move(*started);
    }
    void connect(Program& program) {
        program.window->connectTo({"127.0.0.1", server->port()});
        ASSERT_TRUE(waitFor([&] { return program.session.link() == LinkState::connected && program.window->isSettled() && program.dataset.currentImage(); }));
    }
    static void tick(Program& program, const QString& layer) {
        program.window->showDock("surfaces");
        QCheckBox* found = nullptr;
        const auto isThere = [&] {
            for (QCheckBox* box : program.window->views().surfaces->findChildren<QCheckBox*>("collect:" + layer))
                if (box->isVisible()) found = box;
            return found && found->visibleRegion().contains({8, found->height() / 2});
        };
        ASSERT_TRUE(waitFor(isThere)) << "docks come to the front when the event loop runs";
        QTest::mouseClick(found, Qt::LeftButton, {}, {8, found->height() / 2});
    }
    QTemporaryDir folder;
    QString settings = folder.filePath("settings.ini");
    LayerRenderer layers;
    FakeRenderer plain;
    std::unique_ptr<Server> server;
};

TEST_F(SurfaceLayersTest, TickRenderAndSee) {
    start(layers);
    Program program(settings);
    connect(program);
    EXPECT_EQ(layers.collections, 0) << "nobody asked for layers";
    EXPECT_FALSE(program.dataset.surface());
    tick(program, "hits");
    tick(program, "height");
    auto* button = program.window->views().surfaces->findChild<QPushButton*>("renderLayers");
    ASSERT_TRUE(button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(waitFor([&] { return program.dataset.surface() && program.window->isSettled(); }));
    EXPECT_EQ(layers.collections, 1);
    const SurfaceField& field = *program.dataset.surface();
    ASSERT_EQ(field.layers.size(), 2u);
    EXPECT_EQ(field.find("hits")->samples, 4096u);
    EXPECT_FALSE(program.dataset.currentImage()->preview);
    const SurfaceModel& model = program.window->views().scene->surfaces();
    ASSERT_TRUE(model.shown());
    EXPECT_NEAR(model.statistics()->integral, 4096, 1);

    // A pixel click keeps them, and so does a render without layers.
    program.selection.setPixel(Pixel{3, 3});
    ASSERT_TRUE(waitFor([&] { return !program.dataset.paths().empty(); }));
    EXPECT_EQ(program.dataset.surface().get(), &field);
    tick(program, "hits");
    tick(program, "height");
    program.window->action("render")->trigger();
    ASSERT_TRUE(waitFor([&] { return program.dataset.images().size() == 3 && program.window->isSettled(); }));
    EXPECT_EQ(layers.collections, 1);
    EXPECT_EQ(program.dataset.surface().get(), &field);
}

TEST_F(SurfaceLayersTest, WhatTheServerKeepsComesWithTheConnection) {
    start(layers);
    {
        auto other = client::Connection::open({"127.0.0.1", server->port()});
        ASSERT_TRUE(other);
        client::RenderOptions options;
        options.layers = {"paint"};
        ASSERT_TRUE((*other)->render(options));
    }
    Program program(settings);
    program.window->action("renderOnConnect")->setChecked(false);
    program.window->connectTo({"127.0.0.1", server->port()});
    ASSERT_TRUE(waitFor([&] { return program.dataset.surface() && program.window->isSettled(); }));
    EXPECT_TRUE(program.window->views().scene->surfaces().isColor());
    EXPECT_EQ(layers.collections, 1);
}

TEST_F(SurfaceLayersTest, CancelEndsARenderWithLayers) {
    start(layers);
    Program program(settings);
    connect(program);
    layers.rowMilliseconds = 100;
    program.window->views().surfaces->setWantedLayers({"all"});
    program.window->render();
    ASSERT_TRUE(waitFor([&] { return program.session.renderFraction() > 0; }));
    program.window->action("cancel")->trigger();
    EXPECT_TRUE(waitFor([&] { return program.session.isIdle(); }));
    EXPECT_FALSE(program.dataset.surface());
    EXPECT_FALSE(program.window->toast().isVisible()) << "who cancels knows it";
}

TEST_F(SurfaceLayersTest, ARendererWithoutLayersSaysSo) {
    start(plain);
    Program program(settings);
    connect(program);
    program.window->showDock("surfaces");
    auto* hint = program.window->views().surfaces->findChild<QLabel*>("layerHint");
    EXPECT_TRUE(hint->isVisible());
    EXPECT_TRUE(hint->text().contains("collects no data on surfaces"));
    const std::size_t images = program.dataset.images().size();
    client::RenderOptions options;
    options.layers = {"all"};
    program.session.render(options);
    ASSERT_TRUE(waitFor([&] { return program.window->toast().isVisible(); }));
    EXPECT_EQ(program.dataset.images().size(), images) << "nothing was rendered";
}

TEST_F(SurfaceLayersTest, TheCommandLineMakesAPictureOfTheScene) {
    start(layers);
    const auto picture = [&](const QString& file, QStringList more) {
        const QString path = folder.filePath(file);
        auto options = parseOptions(QStringList{QString("127.0.0.1:%1").arg(server->port()), "--screenshot", path, "--size", "640x480", "--only", "scene",
                                                "--paths", "0"} + more);
        EXPECT_TRUE(options);
        Program program(folder.filePath(file + ".ini"));
        Unattended steps(*options, program.dataset, program.selection, program.session, *program.window);
        int code = -1;
        QString said;
        QObject::connect(&steps, &Unattended::ended, [&](int c, const QString& sentence) { code = c; said = sentence; });
        steps.start();
        EXPECT_TRUE(waitFor([&] { return code >= 0; }, 60000));
        return std::tuple(code, said, QImage(path));
    };
    const auto [code, said, height] = picture("height.png", {"--layers", "all", "--show-layer", "height", "--layer-range", "-2,2", "--eye", "0,0,8", "--target", "0,0,0", "--fov", "40"});
    EXPECT_EQ(code, 0) << said.toStdString();
    ASSERT_EQ(height.size(), QSize(640, 480));
    // The wall's top is yellow, its bottom violet; the bar is at the right.
    const int middle = (640 - 104) / 2;
    const QColor top = height.pixelColor(middle, 90), bottom = height.pixelColor(middle, 390);
    EXPECT_GT(top.green(), top.blue() + 60);
    EXPECT_GT(bottom.blue(), bottom.green());
    const auto [code2, said2, paint] = picture("paint.png", {"--show-layer", "paint", "--layer-exposure", "1", "--eye", "0,0,8", "--target", "0,0,0"});
    EXPECT_EQ(code2, 0) << said2.toStdString();
    EXPECT_GT(paint.pixelColor(200, 240).red(), 200);
    EXPECT_GT(paint.pixelColor(440, 240).green(), 200);
    const auto [code3, said3, none] = picture("none.png", {"--layers", "hits", "--show-layer", "paint"});
    EXPECT_EQ(code3, 5);
    EXPECT_TRUE(said3.contains("paint"));
    const auto [code4, said4, unknown] = picture("unknown.png", {"--layers", "no such"});
    EXPECT_EQ(code4, 5);
}

}  // namespace
}  // namespace emca::explorer
