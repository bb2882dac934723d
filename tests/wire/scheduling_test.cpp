// Who works when: several clients, renders beside traces, turns, cancelling.
#include <future>

#include "raw_client.h"

namespace emca::test {
namespace {

using client::RequestObserver;

TEST(Scheduling, TwoClientsWorkAtOnce) {  // a second client hung the published server
    Served served;
    served.start();
    const auto first = served.connect(), second = served.connect();
    auto a = std::async(std::launch::async, [&] { return first->traceRect({0, 0, 16, 12}); });
    auto b = std::async(std::launch::async, [&] { return second->traceRect({0, 0, 16, 12}); });
    const auto one = a.get(), two = b.get();
    ASSERT_OK(one);
    ASSERT_OK(two);
    EXPECT_EQ(one->paths.pathCount(), two->paths.pathCount());
    first->close();
    EXPECT_TRUE(second->tracePixel({0, 0}).ok()) << "closing one client's window quit the published server";
}

TEST(Scheduling, ManyCallsRunAtOnceOnOneConnection) {
    Served served;
    served.start();
    const auto connection = served.connect();
    std::vector<std::future<bool>> calls;
    for (std::uint32_t i = 0; i < 16; ++i) {
        calls.push_back(std::async(std::launch::async, [&connection, i] {
            const auto trace = connection->tracePixel({i, 3});
            return trace.ok() && trace->pixels[0].x == i && trace->paths.pixel(0).x == i;
        }));
    }
    for (auto& call : calls) EXPECT_TRUE(call.get());
}

TEST(Scheduling, ARenderGoesOnWhileAnotherClientTraces) {
    Served served;
    Gate rendering, traced;
    served.renderer.duringImage = [&](RequestMonitor&) {
        rendering.open();
        EXPECT_TRUE(traced.wait());
    };
    served.start();
    const auto painter = served.connect(), tracer = served.connect();
    auto render = std::async(std::launch::async, [&] { return painter->render(); });
    ASSERT_TRUE(rendering.wait());
    EXPECT_TRUE(tracer->tracePixel({2, 2}).ok()) << "the render is still waiting for this trace";
    EXPECT_TRUE(painter->tracePixel({2, 2}).ok()) << "so does the same client";
    traced.open();
    EXPECT_TRUE(render.get().ok());
    EXPECT_GE(served.renderer.mostAtOnce, 2);
}

TEST(Scheduling, ARendererThatDoesOneThingAtATimeIsAskedOneThingAtATime) {
    Served served;
    served.renderer.description.concurrent = false;
    served.start();
    const auto painter = served.connect(), tracer = served.connect();
    std::vector<std::future<bool>> calls;
    for (int i = 0; i < 4; ++i) {
        calls.push_back(std::async(std::launch::async, [&] { return painter->render().ok(); }));
        calls.push_back(std::async(std::launch::async, [&] { return tracer->traceRect({0, 0, 8, 8}).ok(); }));
    }
    for (auto& call : calls) EXPECT_TRUE(call.get());
    EXPECT_EQ(served.renderer.mostAtOnce, 1);
}

/// A renderer that does one thing at a time, busy with an image until `go` opens.
struct Busy {
    Served served;
    Gate rendering, go;
    std::unique_ptr<client::Connection> painter;
    std::future<Result<client::Render>> render;

    void start() {
        served.renderer.description.concurrent = false;
        served.renderer.duringImage = [this](RequestMonitor&) {
            rendering.open();
            EXPECT_TRUE(go.wait());
        };
        served.start();
        painter = served.connect();
        render = std::async(std::launch::async, [this] { return painter->render(); });
        ASSERT_TRUE(rendering.wait());
    }
};

TEST(Scheduling, ARequestThatWaitsBehindALongOneHearsThatItsServerLives) {
    Busy busy;
    ASSERT_NO_FATAL_FAILURE(busy.start());
    RawClient raw(busy.served.server->port());
    ASSERT_TRUE(raw.isWelcome());
    raw.send(1, protocol::CameraRequest{});
    const auto sign = raw.receive();
    ASSERT_TRUE(sign);
    const auto* progress = std::get_if<protocol::Progress>(&sign->body);
    ASSERT_NE(progress, nullptr);
    EXPECT_TRUE(progress->waiting);
    busy.go.open();
    EXPECT_TRUE(busy.render.get().ok());
    EXPECT_TRUE(raw.receives<Camera>());
}

TEST(Scheduling, ClientsTakeTurns) {
    Served served;
    served.renderer.description.concurrent = false;
    Gate working, queued;
    std::vector<std::uint32_t> order;  // one worker thread
    served.renderer.duringPixel = [&](Pixel pixel, RequestMonitor&) {
        order.push_back(pixel.x);
        working.open();
        EXPECT_TRUE(queued.wait());
    };
    served.start();
    RawClient greedy(served.server->port()), modest(served.server->port());
    for (RawClient* client : {&greedy, &modest}) {
        ASSERT_TRUE(client->isWelcome());
    }
    const auto ask = [](RawClient& client, std::uint64_t number, std::uint32_t x) {
        protocol::TraceRequest request;
        request.pixels = {{x, 0}};
        client.send(number, request);
    };
    for (std::uint32_t i = 0; i < 6; ++i) ask(greedy, i + 1, 0);
    ASSERT_TRUE(working.wait());
    ask(modest, 1, 1);
    // Immediate answers show that what was sent before them has been queued.
    greedy.send(100, protocol::SurfaceRequest{});
    modest.send(100, protocol::SurfaceRequest{});
    ASSERT_TRUE(greedy.receives<protocol::Failure>());
    ASSERT_TRUE(modest.receives<protocol::Failure>());
    queued.open();
    ASSERT_TRUE(modest.receives<protocol::TraceResult>());
    for (int i = 0; i < 6; ++i) ASSERT_TRUE(greedy.receives<protocol::TraceResult>());
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 0, 0, 0, 0, 0}));
}

TEST(Scheduling, CancelReachesARunningRender) {
    Served served;
    Gate rendering, ended;
    served.renderer.duringImage = [&](RequestMonitor& monitor) {
        rendering.open();
        while (!monitor.cancelled()) std::this_thread::yield();
        ended.open();
    };
    served.start();
    const auto connection = served.connect();
    RequestObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    auto render = std::async(std::launch::async, [&] { return connection->render({}, observer); });
    ASSERT_TRUE(rendering.wait());
    *observer.cancel = true;
    EXPECT_CODE(render.get(), cancelled);
    EXPECT_TRUE(ended.wait()) << "the renderer heard of it";
    EXPECT_EQ(connection->info()->latestRender, 0u) << "half an image is none";
    served.renderer.duringImage = nullptr;
    EXPECT_TRUE(connection->render().ok());
}

TEST(Scheduling, CancelTakesBackWhatWaits) {
    Busy busy;
    int pixels = 0;
    busy.served.renderer.duringPixel = [&](Pixel, RequestMonitor&) { ++pixels; };
    ASSERT_NO_FATAL_FAILURE(busy.start());
    RawClient raw(busy.served.server->port());
    ASSERT_TRUE(raw.isWelcome());
    protocol::TraceRequest request;
    request.pixels = {{0, 0}};
    raw.send(5, request);
    raw.send(5, protocol::Cancel{});
    raw.send(77, protocol::Cancel{});  // of nothing: ignored
    const auto answer = raw.receive();
    ASSERT_TRUE(answer);
    const auto* failure = std::get_if<protocol::Failure>(&answer->body);
    ASSERT_NE(failure, nullptr);
    EXPECT_EQ(answer->request, 5u);
    EXPECT_EQ(failure->error.code, ErrorCode::cancelled);
    busy.go.open();
    EXPECT_TRUE(busy.render.get().ok());
    EXPECT_EQ(pixels, 0);
}

}  // namespace
}  // namespace emca::test
