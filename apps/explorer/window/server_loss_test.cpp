// A server that dies, at any byte of the conversation and during everything that takes time: the window says so, nothing
// that was there goes, and one can go on.
#include <gtest/gtest.h>

#include <QAction>
#include <QPushButton>

#include "base/state_overlay.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "scene/surface_panel.h"
#include "testing/cutting_proxy.h"
#include "testing/layer_renderer.h"
#include "testing/program.h"
#include "window/toast.h"

namespace emca::explorer {
namespace {

class ServerLossTest : public MainWindowTest {
  protected:
    void SetUp() override {
        auto started = Server::start(layered);
        ASSERT_TRUE(started);
        server = std::move(*started);
        program = std::make_unique<Program>(settingsFile());
        QObject::connect(&program->session, &SessionController::failed, program->window.get(),
                         [this](FailedTask, const QString& sentence) { sentences << sentence; });
    }
    void TearDown() override { program.reset(); }

    /// A click in the image traces the pixel, exactly, and all views have it.
    void expectUsable(const std::string& when) {
        if (program->session.link() == LinkState::offline) {
            for (QPushButton* button : program->window->toast().findChildren<QPushButton*>())
                if (button->text() == "Try again") QTest::mouseClick(button, Qt::LeftButton);
        }
        ASSERT_TRUE(waitFor([&] { return program->session.link() == LinkState::connected && program->window->isSettled(); })) << when;
        // Of an image that was cut, what came stays as an incomplete one; it takes a render to be compared with.
        if (!program->dataset.currentImage() || program->dataset.currentImage()->title.find("incomplete") != std::string::npos ||
            program->dataset.currentImage()->renderId == 0)
            QTest::keyClick(program->window.get(), Qt::Key_R, Qt::ControlModifier);
        ASSERT_TRUE(waitFor([&] { return program->window->isSettled() && program->dataset.currentImage() && !program->dataset.currentImage()->preview; })) << when;
        ImageCanvas& canvas = program->window->views().image->canvas();
        QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf({7, 5}).center().toPoint());
        ASSERT_TRUE(waitFor([&] { return !program->dataset.paths().empty() && program->dataset.paths().pixel(0) == Pixel{7, 5} && program->window->isSettled(); })) << when;
        EXPECT_EQ(program->dataset.current().front()->replays.front().verdict, Verdict::exact) << when;
        ASSERT_TRUE(program->dataset.meshes()) << when;
    }
    /// Every failure is a sentence.
    void expectWords(const std::string& when) {
        ASSERT_FALSE(sentences.isEmpty()) << when;
        for (const QString& sentence : sentences) EXPECT_TRUE(sentence.size() > 15 && sentence.endsWith('.')) << when << ": " << sentence.toStdString();
    }
    LayerRenderer layered;
    std::unique_ptr<Program> program;
    QStringList sentences;
};

TEST_F(ServerLossTest, CutAtAnyByteOfTheFirstConversation) {
    std::int64_t whole = 0;
    {
        CuttingProxy proxy(server->port());
        program->window->connectTo({"127.0.0.1", proxy.port()});
        expectUsable("whole");
        whole = proxy.bytesSent();
    }
    ASSERT_GT(whole, 3000);
    // Handshake, info, camera, scene and image all end somewhere between these.
    for (std::int64_t bytes : {std::int64_t(0), std::int64_t(1), std::int64_t(30), std::int64_t(150), std::int64_t(400), std::int64_t(900), whole / 3, whole / 2, whole * 4 / 5}) {
        const std::string when = std::to_string(bytes) + " of " + std::to_string(whole) + " bytes";
        program = std::make_unique<Program>(folder.filePath(QString::number(bytes) + ".ini"));
        sentences.clear();
        QObject::connect(&program->session, &SessionController::failed, program->window.get(),
                         [this](FailedTask, const QString& sentence) { sentences << sentence; });
        CuttingProxy proxy(server->port(), bytes);
        program->window->connectTo({"127.0.0.1", proxy.port()});
        const bool died = waitFor([&] { return proxy.hasCut() && !sentences.isEmpty(); }, 5000);
        if (died) {
            expectWords(when);
            EXPECT_TRUE(!program->window->toast().sentence().isEmpty() || !program->window->views().image->overlay().sentence().isEmpty() ||
                        program->session.link() == LinkState::connected) << when;
        }
        expectUsable(when);
        program.reset();
    }
}

TEST_F(ServerLossTest, WhileItTracesThePathsOfBeforeStay) {
    CuttingProxy proxy(server->port());
    program->window->connectTo({"127.0.0.1", proxy.port()});
    expectUsable("before");
    const auto before = program->dataset.current().front();
    const std::size_t images = program->dataset.images().size();
    layered.pixelMilliseconds = 2000;
    ImageCanvas& canvas = program->window->views().image->canvas();
    QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf({2, 2}).center().toPoint());
    ASSERT_TRUE(waitFor([&] { return program->session.isTracing(); }));
    proxy.cutNow();
    ASSERT_TRUE(waitFor([&] { return !sentences.isEmpty(); }));
    layered.pixelMilliseconds = 0;
    expectWords("trace");
    EXPECT_FALSE(program->window->toast().sentence().isEmpty());
    EXPECT_EQ(program->dataset.images().size(), images);
    EXPECT_EQ(program->dataset.traces().front(), before) << "what was traced stays in the history";
    expectUsable("after a trace");
}

TEST_F(ServerLossTest, WhileItRendersWhatHasArrivedIsNoWholeImage) {
    CuttingProxy proxy(server->port());
    program->window->connectTo({"127.0.0.1", proxy.port()});
    expectUsable("before");
    const auto first = program->dataset.currentImage()->image;
    layered.rowMilliseconds = 60;
    QTest::keyClick(program->window.get(), Qt::Key_R, Qt::ControlModifier);
    ASSERT_TRUE(waitFor([&] { return program->session.isRendering() && program->dataset.images().size() > 1; }));
    proxy.cutNow();
    ASSERT_TRUE(waitFor([&] { return !program->session.isRendering() && !sentences.isEmpty(); }));
    layered.rowMilliseconds = 0;
    expectWords("render");
    EXPECT_EQ(program->dataset.images().front().image, first);
    for (const client::ImageEntry& entry : program->dataset.images()) EXPECT_FALSE(entry.preview) << entry.title;
    expectUsable("after a render");
}

TEST_F(ServerLossTest, WhileItSendsLayersTheImageStays) {
    program->window->views().surfaces->setWantedLayers({"all"});
    std::int64_t withoutLayers = 0;
    {
        CuttingProxy proxy(server->port());
        program->window->connectTo({"127.0.0.1", proxy.port()});
        expectUsable("whole");
        ASSERT_TRUE(program->dataset.surface());
        withoutLayers = proxy.bytesSent();
    }
    // Layers come last: from back to front, until the line is cut before they are complete.
    program = std::make_unique<Program>(folder.filePath("layers.ini"));
    QObject::connect(&program->session, &SessionController::failed, program->window.get(),
                     [this](FailedTask, const QString& sentence) { sentences << sentence; });
    sentences.clear();
    program->window->views().surfaces->setWantedLayers({"all"});
    CuttingProxy proxy(server->port(), withoutLayers * 7 / 10);
    program->window->connectTo({"127.0.0.1", proxy.port()});
    ASSERT_TRUE(waitFor([&] { return proxy.hasCut() && !sentences.isEmpty(); }));
    expectWords("layers");
    expectUsable("after layers");
}

TEST_F(ServerLossTest, GoneForGoodEverythingCanStillBeLookedAt) {
    CuttingProxy proxy(server->port());
    program->window->connectTo({"127.0.0.1", proxy.port()});
    expectUsable("before");
    server.reset();
    proxy.cutNow();
    ASSERT_TRUE(waitFor([&] { return program->session.link() == LinkState::reconnecting; }));
    EXPECT_FALSE(program->window->toast().sentence().isEmpty());
    EXPECT_EQ(program->dataset.paths().pathCount(), 4u);
    QTest::keyClick(program->window.get(), Qt::Key_BracketRight);
    EXPECT_TRUE(program->selection.state().currentPath) << "one can go on with what is there";
    EXPECT_TRUE(program->window->action("saveSession")->isEnabled());
    EXPECT_FALSE(program->window->action("render")->isEnabled());
}

}  // namespace
}  // namespace emca::explorer
