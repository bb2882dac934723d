// Regions of SessionController: several pixels in one request, from the history, from a file, with a query.
#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTemporaryDir>
#include <chrono>

#include "emca/server/server.h"
#include "session/session_controller.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"

namespace emca::explorer {
namespace {

class SessionRegionTest : public testing::Test {
  protected:
    void connectAndRender(ServerOptions options = {}) {
        auto started = Server::start(renderer, options);
        ASSERT_TRUE(started);
        server = std::move(*started);
        session.connectTo({"127.0.0.1", server->port()});
        ASSERT_TRUE(waitFor([&] { return session.link() == LinkState::connected && session.isIdle() && !dataset.images().empty(); }));
    }
    /// The views show the paths of just these pixels.
    bool traced(const client::PixelRegion& region) {
        return waitFor([&] {
            return !session.isTracing() && dataset.current().size() == 1 && client::PixelRegion(dataset.current().front()->pixels) == region;
        });
    }
    ReplayCounts verdicts() const { return countReplays(dataset.current().front()->replays); }

    FakeRenderer renderer;
    std::unique_ptr<Server> server;
    client::Dataset dataset;
    client::Selection selection;
    SessionController session{dataset, selection};
    QSignalSpy failures{&session, &SessionController::failed};
    const client::PixelRegion square{PixelRect{4, 3, 8, 6}};
};

TEST_F(SessionRegionTest, ARectangleIsTracedInOneRequestAndEveryPixelIsExact) {
    connectAndRender();
    QSignalSpy finished(&session, &SessionController::traceFinished);
    selection.setRegion(square);
    ASSERT_TRUE(traced(square));
    EXPECT_EQ(finished.count(), 1);
    EXPECT_EQ(dataset.paths().pathCount(), 12u * 4);
    EXPECT_EQ(verdicts().exact, 12u);
    // Paths are told apart by their pixel.
    for (const Pixel pixel : square.pixels()) {
        const auto path = dataset.paths().findPath(pixel, 3);
        ASSERT_TRUE(path);
        EXPECT_EQ(dataset.paths().estimate(*path), FakeRenderer::sampleValue(pixel, 3));
    }
    EXPECT_TRUE(session.lastRequest().startsWith("region 4x3 at (4, 3) in ")) << session.lastRequest().toStdString();
    EXPECT_EQ(dataset.traces().size(), 1u);
}

TEST_F(SessionRegionTest, PixelsPickedOneByOneAreTracedTogether) {
    connectAndRender();
    selection.setPixel(Pixel{1, 1});
    selection.togglePixel({20, 9});
    selection.togglePixel({5, 5});
    const client::PixelRegion three(std::vector<Pixel>{{1, 1}, {20, 9}, {5, 5}});
    ASSERT_TRUE(traced(three));
    EXPECT_EQ(dataset.paths().pathCount(), 12u);
    EXPECT_EQ(verdicts().exact, 3u);
    selection.togglePixel({5, 5});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{1, 1}, {20, 9}})));
}

TEST_F(SessionRegionTest, TheHistoryRepliesAndWhatIsGivenUpShowsNothing) {
    connectAndRender();
    selection.setRegion(square);
    ASSERT_TRUE(traced(square));
    const auto first = dataset.current().front();
    selection.setPaths({{{5, 4}, 2, 0}});
    selection.setPixel(Pixel{1, 1});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{1, 1}})));
    EXPECT_TRUE(selection.state().paths.empty()) << "the path belongs to a pixel that is no longer shown";
    const int asked = renderer.replays;
    selection.setRegion(client::PixelRegion(PixelRect{4, 3, 8, 6}));
    EXPECT_EQ(dataset.current().front(), first) << "at once";
    EXPECT_EQ(renderer.replays, asked);
    selection.setRegion({});
    EXPECT_TRUE(dataset.current().empty());
    EXPECT_TRUE(dataset.paths().empty());
    session.showTrace(first);
    EXPECT_EQ(selection.state().region, square);
    EXPECT_EQ(dataset.current().front(), first);
    EXPECT_EQ(renderer.replays, asked);
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SessionRegionTest, TheLatestRegionWinsAndCanBeCancelled) {
    connectAndRender();
    renderer.pixelMilliseconds = 30000;
    selection.setRegion(square);
    ASSERT_TRUE(waitFor([&] { return renderer.replays >= 1; }));
    EXPECT_EQ(session.tracedPixels(), square);
    session.cancelTrace();
    EXPECT_FALSE(session.isTracing());
    EXPECT_TRUE(session.tracedPixels().empty());
    renderer.pixelMilliseconds = 0;
    session.traceAgain();
    ASSERT_TRUE(traced(square));
    EXPECT_EQ(dataset.traces().size(), 1u);
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SessionRegionTest, VeryManyPathsWaitForAWord) {
    renderer.width = 300;
    renderer.height = 200;
    connectAndRender();
    const client::PixelRegion all(PixelRect{0, 0, 300, 200});
    selection.setPixel(Pixel{7, 7});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{7, 7}})));
    const int asked = renderer.replays;
    selection.setRegion(all);
    EXPECT_EQ(session.heldBack(), 240000u);
    EXPECT_FALSE(session.isTracing());
    EXPECT_TRUE(dataset.current().empty()) << "paths of another pixel are not those of the region";
    session.traceAgain();
    EXPECT_EQ(session.heldBack(), 0u);
    ASSERT_TRUE(traced(all));
    EXPECT_EQ(renderer.replays, asked + 60000);
    EXPECT_EQ(dataset.paths().pathCount(), 240000u);
    EXPECT_EQ(verdicts().exact, 60000u);
}

TEST_F(SessionRegionTest, WithAQueryOnlyItsPathsComeHoweverLargeTheRegionIs) {
    renderer.width = 300;
    renderer.height = 200;
    connectAndRender();
    session.setRegionQuery("estimate.b > 1");   // sample 2 of every pixel
    const client::PixelRegion region(PixelRect{100, 50, 250, 180});
    selection.setRegion(region);
    EXPECT_EQ(session.heldBack(), 0u);
    ASSERT_TRUE(traced(region));
    const auto& trace = dataset.current().front();
    ASSERT_TRUE(trace->matches);
    EXPECT_EQ(trace->matches->paths, region.size() * 4);
    EXPECT_EQ(trace->matches->matched, region.size());
    EXPECT_EQ(dataset.paths().pathCount(), region.size());
    for (Index path = 0; path < dataset.paths().pathCount(); path += 997) EXPECT_EQ(dataset.paths().sample(path), 2);
    // Another question about the same pixels is another reply; one pixel always comes whole.
    session.setRegionQuery("estimate.b > 1 and pixel.x < 110");
    ASSERT_TRUE(waitFor([&] { return !session.isTracing() && dataset.paths().pathCount() == 10u * 130; }));
    session.setRegionQuery("estimate.b > 1");
    EXPECT_EQ(dataset.paths().pathCount(), region.size()) << "known, at once";
    selection.setPixel(Pixel{3, 3});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{3, 3}})));
    EXPECT_EQ(dataset.paths().pathCount(), 4u);
    EXPECT_EQ(failures.count(), 0);
}

TEST_F(SessionRegionTest, WhatDoesNotFitTheBudgetIsCounted) {
    ServerOptions options;
    options.defaultBudget = 1 << 17;
    renderer.depth = 8;
    renderer.samplesPerPixel = 64;
    connectAndRender(options);
    selection.setRegion(client::PixelRegion(PixelRect{0, 0, 20, 12}));
    ASSERT_TRUE(traced(client::PixelRegion(PixelRect{0, 0, 20, 12})));
    EXPECT_GT(dataset.current().front()->stats.droppedByBudget, 0u);
    EXPECT_LT(dataset.paths().vertexCount(), 240u * 64 * 8);
    EXPECT_EQ(verdicts().exact, 240u) << "the pixels are right, whatever was recorded of them";
}

TEST_F(SessionRegionTest, MorePixelsThanTheRendererTakesAreASentence) {
    ServerOptions options;
    options.maximumPixelsPerTrace = 10;
    connectAndRender(options);
    selection.setRegion(square);
    ASSERT_EQ(failures.count(), 1);
    const QString sentence = failures[0][1].toString();
    EXPECT_TRUE(sentence.startsWith("Region 4x3 at (4, 3) was not traced") && sentence.contains("at most 10")) << sentence.toStdString();
    session.setRegionQuery("depth > 0");
    ASSERT_TRUE(traced(square)) << "with a query it is allowed";
}

TEST_F(SessionRegionTest, AnOpenedImageIsComparedPixelByPixel) {
    connectAndRender();
    client::ImageEntry changed = *dataset.currentImage();
    auto image = std::make_shared<RenderedImage>(*changed.image);
    image->color.setColor({5, 4}, Color(9));
    changed.image = image;
    changed.renderId = 0;
    dataset.addImage(changed);
    selection.setRegion(square);
    ASSERT_TRUE(traced(square));
    EXPECT_EQ(verdicts().exact, 11u);
    EXPECT_EQ(verdicts().different, 1u);
    EXPECT_EQ(verdicts().worst(), Verdict::different);
}

TEST_F(SessionRegionTest, ASessionKeepsTheRegionAndShowsItWithoutARenderer) {
    connectAndRender();
    selection.setPixel(Pixel{4, 3});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{4, 3}})));
    selection.setPixel(Pixel{4, 4});
    ASSERT_TRUE(traced(client::PixelRegion(std::vector<Pixel>{{4, 4}})));
    selection.setRegion(square);
    ASSERT_TRUE(traced(square));
    selection.setPaths({{{5, 4}, 2, 0}, {{6, 4}, 2, 0}});
    selection.setVertex({{{6, 4}, 2, 0}, 2, Subpath::camera});
    const client::Selection::State state = selection.state();
    QTemporaryDir folder;
    const QString file = folder.filePath("region.emca");
    QSignalSpy saved(&session, &SessionController::sessionSaveEnded);
    session.saveSession(file);
    ASSERT_TRUE(waitFor([&] { return saved.count() == 1; }));
    server.reset();

    client::Dataset later;
    client::Selection chosen;
    SessionController reader(later, chosen);
    QSignalSpy opened(&reader, &SessionController::sessionOpened), failed(&reader, &SessionController::failed);
    reader.openSession(file);
    ASSERT_TRUE(waitFor([&] { return opened.count() == 1; }));
    EXPECT_EQ(chosen.state(), state);
    EXPECT_EQ(later.paths().pathCount(), 48u);
    chosen.setPixel(Pixel{4, 3});
    EXPECT_EQ(later.paths().pathCount(), 4u) << "that pixel alone";
    chosen.setRegion(square);
    EXPECT_EQ(later.paths().pathCount(), 48u);
    EXPECT_EQ(failed.count(), 0);
    // Never traced together, but one by one; of the third nothing is known.
    chosen.setRegion(client::PixelRegion(PixelRect{4, 3, 5, 5}));
    ASSERT_EQ(later.current().size(), 2u);
    EXPECT_EQ(later.paths().pathCount(), 8u);
    EXPECT_EQ(failed.count(), 0);
    chosen.setRegion(client::PixelRegion(std::vector<Pixel>{{4, 3}, {20, 9}}));
    EXPECT_EQ(later.paths().pathCount(), 4u);
    ASSERT_EQ(failed.count(), 1);
    EXPECT_TRUE(failed[0][1].toString().startsWith("1 of 2 pixels were traced before")) << failed[0][1].toString().toStdString();
}

}  // namespace
}  // namespace emca::explorer
