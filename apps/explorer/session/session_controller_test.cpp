#include "session/session_controller.h"

#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTemporaryDir>

#include "emca/imageio/imageio.h"
#include "emca/server/server.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

class SessionTest : public testing::Test {
  protected:
    std::uint16_t serve(std::uint16_t port = 0) {
        ServerOptions options;
        options.port = port;
        for (int attempt = 0; attempt < 200; ++attempt) {
            auto started = Server::start(renderer, options);
            if (started) {
                server = std::move(*started);
                return server->port();
            }
            QTest::qWait(10);
        }
        ADD_FAILURE() << "no server on port " << port;
        return 0;
    }
    void connectAndRender() {
        session.connectTo({"127.0.0.1", serve()});
        ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::connected && session.isIdle() && !dataset.images().empty(); }));
    }
    bool traced(Pixel pixel) {
        return waitFor([&] {
            return dataset.current().size() == 1 && dataset.current().front()->pixels.front() == pixel && !session.isTracing();
        });
    }
    Verdict verdict() const { return dataset.current().front()->replays.front().verdict; }

    FakeRenderer renderer;
    std::unique_ptr<Server> server;
    client::Dataset dataset;
    client::Selection selection;
    SessionController session{dataset, selection};
    QSignalSpy failures{&session, &SessionController::failed};
};

TEST_F(SessionTest, ConnectingBringsInfoCameraMeshesAndAnImage) {
    connectAndRender();
    EXPECT_EQ(dataset.info()->scene, "fake");
    EXPECT_EQ(dataset.camera()->position, (Vec3f{0, 0, 5}));
    ASSERT_TRUE(dataset.meshes());
    EXPECT_EQ(dataset.meshes()->front().name, "wall");
    const client::ImageEntry* image = dataset.currentImage();
    ASSERT_TRUE(image);
    EXPECT_FALSE(image->preview);
    EXPECT_EQ(image->image->color.color({5, 7}), FakeRenderer::pixelValue({5, 7}, 4));
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SessionTest, NobodyListeningIsASentence) {
    session.connectTo({"127.0.0.1", 1});
    ASSERT_TRUE(waitFor([&] { return failures.count() == 1; }));
    EXPECT_EQ(session.link(), LinkState::offline);
    EXPECT_EQ(failures[0][0].value<FailedTask>(), FailedTask::connect);
    EXPECT_FALSE(failures[0][1].toString().isEmpty());
}

TEST_F(SessionTest, ASelectedPixelIsTracedAgainstItsImage) {
    connectAndRender();
    selection.setPixel(Pixel{3, 2});
    ASSERT_TRUE(traced({3, 2}));
    EXPECT_EQ(verdict(), Verdict::exact);
    EXPECT_EQ(dataset.paths().pathCount(), 4u);
    EXPECT_EQ(dataset.paths().estimate(1), FakeRenderer::sampleValue({3, 2}, 1));
}

TEST_F(SessionTest, TheHistoryRepliesWithoutTheRenderer) {
    connectAndRender();
    selection.setPixel(Pixel{3, 2});
    ASSERT_TRUE(traced({3, 2}));
    selection.setPixel(Pixel{4, 4});
    ASSERT_TRUE(traced({4, 4}));
    const int asked = renderer.replays;
    selection.setPixel(Pixel{3, 2});
    // At once: no event loop runs in between.
    EXPECT_EQ(dataset.current().front()->pixels.front(), (Pixel{3, 2}));
    EXPECT_EQ(renderer.replays, asked);
    EXPECT_EQ(dataset.traces().size(), 2u);
    session.traceAgain();
    ASSERT_TRUE(waitFor([&] { return renderer.replays == asked + 1 && !session.isTracing(); }, 3000)) << renderer.replays << " after " << asked;
}

TEST_F(SessionTest, TheLatestClickWins) {
    connectAndRender();
    renderer.pixelMilliseconds = 30000;
    selection.setPixel(Pixel{1, 1});
    ASSERT_TRUE(waitFor([&] { return renderer.replays == 1; }, 3000)) << renderer.replays;
    renderer.pixelMilliseconds = 0;
    selection.setPixel(Pixel{2, 2});
    ASSERT_TRUE(traced({2, 2}));
    EXPECT_EQ(dataset.traces().size(), 1u);
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SessionTest, ACancelledRenderKeepsWhatArrivedAndIsNoFailure) {
    session.setRenderOnConnect(false);
    session.connectTo({"127.0.0.1", serve()});
    ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::connected; }));
    renderer.rowMilliseconds = 40;
    session.render({});
    EXPECT_TRUE(dataset.currentImage()->preview);
    const auto preview = dataset.currentImage()->image;
    ASSERT_TRUE(waitFor([&] { return !isBlack(preview->color.color({1, 1})); }));
    EXPECT_TRUE(waitFor([&] { return session.renderFraction() > 0; }));
    session.cancelRender();
    EXPECT_FALSE(session.isRendering());
    EXPECT_FALSE(dataset.currentImage()->preview);
    EXPECT_EQ(dataset.images().size(), 1u);
    EXPECT_EQ(failures.count(), 0);
    renderer.rowMilliseconds = 0;
    session.render({});
    ASSERT_TRUE(waitFor([&] { return !session.isRendering(); }));
    EXPECT_EQ(dataset.currentImage()->image->color.color({2, 9}), FakeRenderer::pixelValue({2, 9}, 4));
}

TEST_F(SessionTest, ARendererThatRestartsIsFoundAgainAndNothingIsForgotten) {
    connectAndRender();
    selection.setPixel(Pixel{3, 2});
    ASSERT_TRUE(traced({3, 2}));
    const std::uint16_t port = server->port();
    server.reset();
    ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::reconnecting; }));
    EXPECT_EQ(dataset.images().size(), 1u);
    EXPECT_EQ(dataset.traces().size(), 1u);
    serve(port);
    ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::connected && session.isIdle(); }));
    EXPECT_EQ(dataset.images().size(), 1u) << "the image is kept, none is rendered anew";
    // The new server does not know the render; its pixels are compared by value.
    selection.setPixel(Pixel{6, 6});
    ASSERT_TRUE(traced({6, 6}));
    EXPECT_EQ(verdict(), Verdict::exact);
}

TEST_F(SessionTest, AnotherSceneForgetsPathsAndKeepsImages) {
    connectAndRender();
    selection.setPixel(Pixel{3, 2});
    ASSERT_TRUE(traced({3, 2}));
    renderer.scene = "another";
    session.connectTo({"127.0.0.1", serve()});
    ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::connected && session.isIdle(); }));
    EXPECT_TRUE(dataset.traces().empty());
    EXPECT_FALSE(selection.state().pixel);
    EXPECT_EQ(dataset.images().size(), 1u);
}

TEST_F(SessionTest, AnOpenedImageIsTracedAgainstItsOwnPixels) {
    connectAndRender();
    QTemporaryDir folder;
    const QString file = folder.filePath("saved.exr");
    QSignalSpy saved(&session, &SessionController::imageSaved);
    session.saveImage(file);
    ASSERT_TRUE(waitFor([&] { return saved.count() == 1; }));
    session.openImage(file);
    ASSERT_TRUE(waitFor([&] { return dataset.images().size() == 2 && session.isIdle(); }));
    EXPECT_EQ(dataset.currentImage()->title, "saved.exr");
    selection.setPixel(Pixel{9, 9});
    ASSERT_TRUE(traced({9, 9}));
    EXPECT_EQ(verdict(), Verdict::exact);
    EXPECT_EQ(dataset.current().front()->samplesPerPixel, 4u);
}

TEST_F(SessionTest, AnImageOfAnotherSizeIsShownButNotTraced) {
    connectAndRender();
    QTemporaryDir folder;
    const QString file = folder.filePath("small.pfm");
    ASSERT_TRUE(imageio::write(file.toStdString(), Image(8, 8)));
    session.openImage(file);
    ASSERT_TRUE(waitFor([&] { return dataset.images().size() == 2; }));
    const int asked = renderer.replays;
    selection.setPixel(Pixel{3, 3});
    ASSERT_EQ(failures.count(), 1);
    const QString sentence = failures[0][1].toString();
    EXPECT_TRUE(sentence.contains("8 × 8") && sentence.contains("24 × 16")) << sentence.toStdString();
    EXPECT_EQ(renderer.replays, asked);
}

TEST_F(SessionTest, AReferenceIsReadWithoutTakingTheImagesPlace) {
    connectAndRender();
    const auto shown = dataset.currentImage()->image;
    QTemporaryDir folder;
    const QString file = folder.filePath("reference.pfm");
    ASSERT_TRUE(imageio::write(file.toStdString(), Image(24, 16)));
    std::shared_ptr<const RenderedImage> reference;
    QObject::connect(&session, &SessionController::referenceOpened, &session, [&](const auto& opened) { reference = opened; });
    session.openReference(file);
    ASSERT_TRUE(waitFor([&] { return reference != nullptr; }));
    EXPECT_EQ(dataset.currentImage()->image, shown);
    ASSERT_EQ(dataset.images().size(), 2u);
    EXPECT_EQ(dataset.images()[1].image, reference);
    EXPECT_EQ(dataset.images()[1].title, "reference.pfm");
    session.openReference("/nowhere/reference.exr");
    ASSERT_TRUE(waitFor([&] { return failures.count() == 1; }));
    EXPECT_EQ(failures[0][0].value<FailedTask>(), FailedTask::openImage);
    EXPECT_EQ(dataset.images().size(), 2u);
}

TEST_F(SessionTest, AFileThatIsNoImageIsASentence) {
    session.openImage("/nowhere/image.exr");
    ASSERT_TRUE(waitFor([&] { return failures.count() == 1; }));
    EXPECT_EQ(failures[0][0].value<FailedTask>(), FailedTask::openImage);
    EXPECT_TRUE(dataset.images().empty());
}

TEST_F(SessionTest, WithoutARendererAClickSaysSo) {
    selection.setPixel(Pixel{1, 1});
    ASSERT_EQ(failures.count(), 1);
    EXPECT_EQ(failures[0][0].value<FailedTask>(), FailedTask::trace);
}

TEST_F(SessionTest, DestructionWhileEverythingRunsReturnsSoon) {
    auto* busy = new SessionController(dataset, selection);
    renderer.rowMilliseconds = 1000;
    renderer.pixelMilliseconds = 30000;
    busy->connectTo({"127.0.0.1", serve()});
    ASSERT_TRUE(waitFor([&] { return busy->isRendering(); }));
    selection.setPixel(Pixel{1, 1});
    QElapsedTimer clock;
    clock.start();
    delete busy;
    EXPECT_LT(clock.elapsed(), 10000);
}

}  // namespace
}  // namespace emca::explorer
