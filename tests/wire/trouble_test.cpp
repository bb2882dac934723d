// What goes wrong between programs: whatever one client does, the renderer and the others live on.
#include <array>
#include <asio.hpp>
#include <future>

#include "emca/protocol/codec.h"
#include "served.h"

namespace emca::test {
namespace {

using asio::ip::tcp;
using client::Connection;
using client::RequestObserver;

/// A socket without manners.
class RawClient {
  public:
    explicit RawClient(std::uint16_t port) { socket_.connect({asio::ip::address_v4::loopback(), port}); }

    void write(const std::string& bytes) { asio::write(socket_, asio::buffer(bytes), ignored_); }
    void send(std::uint64_t request, protocol::Body body) {
        const auto frame = protocol::encode({request, std::move(body)});
        const auto header = protocol::header(*frame);
        asio::write(socket_, asio::buffer(header), ignored_);
        asio::write(socket_, asio::buffer(frame->data(), frame->size()), ignored_);
    }
    void greet(const std::string& token = {}) { send(0, protocol::Hello{"raw", 1, 1, {}, token}); }

    /// The next message, or nothing at the end of the connection.
    std::optional<protocol::Message> receive() {
        std::array<std::byte, 4> header{};
        asio::read(socket_, asio::buffer(header), ignored_);
        if (ignored_) return std::nullopt;
        const auto size = protocol::payloadBytes(header, protocol::kMaximumReplyBytes);
        if (!size) return std::nullopt;
        auto payload = *protocol::allocatePayload(*size);
        asio::read(socket_, asio::buffer(payload.get(), *size), ignored_);
        if (ignored_) return std::nullopt;
        auto message = protocol::decode(protocol::Frame(payload, payload.get(), *size));
        EXPECT_TRUE(message.ok()) << message.error().message;
        return message ? std::optional(*message) : std::nullopt;
    }
    /// The refusal that comes instead of a welcome, then the end.
    ErrorCode refusal() {
        const auto message = receive();
        const auto* refusal = message ? std::get_if<protocol::Refusal>(&message->body) : nullptr;
        if (!refusal) return ErrorCode::internal;
        EXPECT_FALSE(refusal->error.message.empty());
        EXPECT_FALSE(receive()) << "the server closes after a refusal";
        return refusal->error.code;
    }
    template <typename Wanted>
    bool receives() {
        while (const auto message = receive()) {
            if (std::holds_alternative<Wanted>(message->body)) return true;
            if (!std::holds_alternative<protocol::Progress>(message->body)) return false;
        }
        return false;
    }
    void vanish() {
        socket_.set_option(asio::socket_base::linger(true, 0));  // a reset, as of a process that was killed
        socket_.close();
    }

  private:
    asio::io_context context_;
    tcp::socket socket_{context_};
    std::error_code ignored_;
};

void expectAlive(const Served& served) {
    const auto connection = served.connect();
    ASSERT_NE(connection, nullptr);
    EXPECT_TRUE(connection->tracePixel({1, 1}).ok());
}

TEST(Trouble, TwoClientsWorkAtOnce) {  // a second client hung the published server
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

TEST(Trouble, ManyCallsRunAtOnceOnOneConnection) {
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

TEST(Trouble, ARenderGoesOnWhileAnotherClientTraces) {
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

TEST(Trouble, ARendererThatDoesOneThingAtATimeIsAskedOneThingAtATime) {
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

TEST(Trouble, ARequestThatWaitsBehindALongOneHearsThatItsServerLives) {
    Served served;
    served.renderer.description.concurrent = false;
    Gate rendering, heard;
    served.renderer.duringImage = [&](RequestMonitor&) {
        rendering.open();
        EXPECT_TRUE(heard.wait());
    };
    served.start();
    const auto painter = served.connect();
    auto render = std::async(std::launch::async, [&] { return painter->render(); });
    ASSERT_TRUE(rendering.wait());
    RawClient raw(served.server->port());
    raw.greet();
    ASSERT_TRUE(raw.receives<protocol::Welcome>());
    raw.send(1, protocol::CameraRequest{});
    const auto sign = raw.receive();
    ASSERT_TRUE(sign);
    const auto* progress = std::get_if<protocol::Progress>(&sign->body);
    ASSERT_NE(progress, nullptr);
    EXPECT_TRUE(progress->waiting);
    heard.open();
    EXPECT_TRUE(render.get().ok());
    EXPECT_TRUE(raw.receives<Camera>());
}

TEST(Trouble, ClientsTakeTurns) {
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
        client->greet();
        ASSERT_TRUE(client->receives<protocol::Welcome>());
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

TEST(Trouble, CancelReachesARunningRender) {
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

TEST(Trouble, CancelTakesBackWhatWaits) {
    Served served;
    served.renderer.description.concurrent = false;
    Gate rendering, go;
    int pixels = 0;
    served.renderer.duringPixel = [&](Pixel, RequestMonitor&) { ++pixels; };
    served.renderer.duringImage = [&](RequestMonitor&) {
        rendering.open();
        EXPECT_TRUE(go.wait());
    };
    served.start();
    const auto painter = served.connect();
    auto render = std::async(std::launch::async, [&] { return painter->render(); });
    ASSERT_TRUE(rendering.wait());
    RawClient raw(served.server->port());
    raw.greet();
    ASSERT_TRUE(raw.receives<protocol::Welcome>());
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
    go.open();
    EXPECT_TRUE(render.get().ok());
    EXPECT_EQ(pixels, 0);
}

TEST(Trouble, WorkOfAVanishedClientIsCancelled) {  // aborted the published renderer
    Served served;
    Gate rendering, noticed;
    served.renderer.duringImage = [&](RequestMonitor& monitor) {
        rendering.open();
        while (!monitor.cancelled()) std::this_thread::yield();
        noticed.open();
    };
    served.start();
    RawClient raw(served.server->port());
    raw.greet();
    ASSERT_TRUE(raw.receives<protocol::Welcome>());
    raw.send(1, protocol::RenderRequest{});
    ASSERT_TRUE(rendering.wait());
    raw.vanish();
    EXPECT_TRUE(noticed.wait());
    expectAlive(served);
}

TEST(Trouble, AClientMayVanishInTheMiddleOfAReply) {
    Served served;
    Mesh mesh;
    for (std::uint32_t i = 0; i < 3'000'000; ++i) mesh.positions.push_back({float(i), 0, 0});  // more than sockets buffer
    served.renderer.scene = {mesh};
    served.start();
    for (int i = 0; i < 3; ++i) {
        RawClient raw(served.server->port());
        raw.greet();
        ASSERT_TRUE(raw.receives<protocol::Welcome>());
        raw.send(1, protocol::SceneRequest{});
        raw.send(2, protocol::TraceRequest{});
        ASSERT_TRUE(raw.receive());
        raw.vanish();
    }
    expectAlive(served);
}

TEST(Trouble, AClickDoesNotWaitForAScene) {
    Served served;
    Mesh mesh;
    for (std::uint32_t i = 0; i < 6'000'000; ++i) mesh.positions.push_back({float(i), 0, 0});
    served.renderer.scene = {mesh};
    served.start();
    RawClient raw(served.server->port());
    raw.greet();
    ASSERT_TRUE(raw.receives<protocol::Welcome>());
    raw.send(1, protocol::SceneRequest{});
    ASSERT_TRUE(raw.receives<protocol::SceneChunk>());
    protocol::TraceRequest click;
    click.pixels = {{1, 1}};
    raw.send(2, click);
    int chunks = 1;
    bool traced = false, last = false;
    while (!last) {
        const auto message = raw.receive();
        ASSERT_TRUE(message);
        if (std::holds_alternative<protocol::TraceResult>(message->body)) traced = true;
        if (const auto* chunk = std::get_if<protocol::SceneChunk>(&message->body)) {
            ++chunks;
            last = chunk->last;
        }
    }
    EXPECT_GE(chunks, 17) << "72 MB in pieces of 4 MiB";
    EXPECT_TRUE(traced) << "the pixel came between the chunks";
}

TEST(Trouble, GarbageOnThePortIsSentAway) {  // stopped the published server
    Served served;
    served.start();
    for (const std::string& garbage : {std::string("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), std::string(5000, '\0'),
                                      std::string(5000, '\xff'), std::string("\x10\0\0\0EMCAEMCAEMCAEMCA", 20)}) {
        RawClient raw(served.server->port());
        raw.write(garbage);
        const ErrorCode code = raw.refusal();
        EXPECT_TRUE(code == ErrorCode::tooLarge || code == ErrorCode::protocolViolation) << name(code);
    }
    expectAlive(served);
}

TEST(Trouble, GarbageAfterTheGreetingEndsOnlyThisClient) {
    Served served;
    served.start();
    const auto bystander = served.connect();
    for (const std::string& garbage : {std::string("\xff\xff\xff\xff", 4), std::string("\x08\0\0\0EMCAEMCA", 12)}) {
        RawClient raw(served.server->port());
        raw.greet();
        ASSERT_TRUE(raw.receives<protocol::Welcome>());
        raw.write(garbage);
        const auto answer = raw.receive();
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->request, 0u);
        EXPECT_TRUE(std::holds_alternative<protocol::Failure>(answer->body));
        EXPECT_FALSE(raw.receive());
    }
    EXPECT_TRUE(bystander->tracePixel({1, 1}).ok());
}

TEST(Trouble, ARequestNumberInUseEndsTheClient) {
    Served served;
    Gate working, go;
    served.renderer.duringPixel = [&](Pixel, RequestMonitor&) {
        working.open();
        EXPECT_TRUE(go.wait());
    };
    served.start();
    RawClient raw(served.server->port());
    raw.greet();
    ASSERT_TRUE(raw.receives<protocol::Welcome>());
    protocol::TraceRequest request;
    request.pixels = {{0, 0}};
    raw.send(1, request);
    ASSERT_TRUE(working.wait());
    raw.send(1, request);
    EXPECT_TRUE(raw.receives<protocol::Failure>());
    go.open();
    EXPECT_FALSE(raw.receive());
    expectAlive(served);
}

TEST(Trouble, HalfAGreetingAndSilenceIsSentAway) {
    Served served;
    ServerOptions options;
    options.handshakeTimeout = std::chrono::milliseconds(30);
    served.start(options);
    RawClient raw(served.server->port());
    raw.write(std::string("\x40\0\0\0EM", 6));
    EXPECT_EQ(raw.refusal(), ErrorCode::timedOut);
    expectAlive(served);
}

TEST(Trouble, StrangersThatStaySilentKeepNobodyOut) {
    Served served;
    ServerOptions options;
    options.maximumClients = 1;
    served.start(options);
    std::vector<std::unique_ptr<RawClient>> strangers;
    for (int i = 0; i < 20; ++i) strangers.push_back(std::make_unique<RawClient>(served.server->port()));
    expectAlive(served);
}

TEST(Trouble, OneClientTooManyIsToldSo) {
    Served served;
    ServerOptions options;
    options.maximumClients = 2;
    served.start(options);
    auto first = served.connect(), second = served.connect();
    const auto third = Connection::open(served.address());
    EXPECT_CODE(third, refused);
    EXPECT_NE(third.error().message.find("2 clients"), std::string::npos);
}

TEST(Trouble, AnotherVersionIsToldWhichOnesAreSpoken) {
    Served served;
    served.start();
    RawClient raw(served.server->port());
    raw.send(0, protocol::Hello{"from the future", 900, 901, {}, {}});
    const auto answer = raw.receive();
    ASSERT_TRUE(answer);
    const auto* refusal = std::get_if<protocol::Refusal>(&answer->body);
    ASSERT_NE(refusal, nullptr);
    EXPECT_EQ(refusal->error.code, ErrorCode::versionMismatch);
    EXPECT_NE(refusal->error.message.find("900"), std::string::npos) << refusal->error.message;
    EXPECT_EQ(refusal->maximumVersion, protocol::kMaximumVersion);
    RawClient wide(served.server->port());
    wide.send(0, protocol::Hello{"knows both", 0, 901, {}, {}});
    const auto welcome = wide.receive();
    ASSERT_TRUE(welcome);
    ASSERT_TRUE(std::holds_alternative<protocol::Welcome>(welcome->body));
    EXPECT_EQ(std::get<protocol::Welcome>(welcome->body).version, protocol::kMaximumVersion);
}

TEST(Trouble, TheTokenMustBeRight) {
    Served served;
    ServerOptions options;
    options.token = "open sesame";
    served.start(options);
    EXPECT_CODE(Connection::open(served.address()), refused);
    for (const char* wrong : {"open sesam", "open sesame!", "opEn sesame", ""}) {
        Connection::Options with;
        with.token = wrong;
        EXPECT_CODE(Connection::open(served.address(), with), refused);
    }
    Connection::Options right;
    right.token = "open sesame";
    EXPECT_TRUE(Connection::open(served.address(), right).ok());
}

TEST(Trouble, APortInUseIsSaid) {
    Served served;
    served.start();
    ServerOptions options;
    options.port = served.server->port();
    const auto second = Server::start(served.renderer, options);
    EXPECT_CODE(second, addressInUse);
    EXPECT_NE(second.error().message.find(std::to_string(options.port)), std::string::npos);
    options.port = 0;
    options.host = "no such host.invalid";
    EXPECT_CODE(Server::start(served.renderer, options), invalidArgument);
}

TEST(Trouble, TheServerListensOnLoopbackUnlessTold) {  // the published one listened everywhere and said nothing
    std::vector<std::string> remarks;
    ServerOptions options;
    options.log = [&](const std::string& text) { remarks.push_back(text); };
    {
        Served served(options);
        EXPECT_EQ(served.server->address(), "127.0.0.1:" + std::to_string(served.server->port()));
    }
    EXPECT_TRUE(remarks.empty());
    options.host = "0.0.0.0";
    Served open(options);
    ASSERT_FALSE(remarks.empty());
    EXPECT_NE(remarks[0].find("every machine"), std::string::npos) << remarks[0];
}

TEST(Trouble, AnExceptionInTheRendererIsAReply) {
    Served served;
    served.renderer.duringPixel = [](Pixel pixel, RequestMonitor&) {
        if (pixel.x == 3) throw std::runtime_error("the BSDF is negative");
        if (pixel.x == 4) throw 42;
    };
    served.renderer.duringImage = [](RequestMonitor&) { throw std::logic_error("no film"); };
    served.start();
    const auto connection = served.connect();
    const auto thrown = connection->tracePixel({3, 0});
    EXPECT_CODE(thrown, rendererFailed);
    EXPECT_NE(thrown.error().message.find("the BSDF is negative"), std::string::npos);
    EXPECT_CODE(connection->tracePixel({4, 0}), rendererFailed);
    EXPECT_CODE(connection->render(), rendererFailed);
    const auto after = connection->tracePixel({5, 0});
    ASSERT_OK(after);
    EXPECT_EQ(after->paths.pathCount(), 4u) << "nothing is left of the failed recording";
}

class BrokenInfo final : public FakeRenderer {
  public:
    RendererInfo info() const override { throw std::runtime_error("no scene"); }
};

TEST(Trouble, ARendererThatCannotSayWhatItIsIsNotServed) {
    BrokenInfo renderer;
    EXPECT_CODE(Server::start(renderer), rendererFailed);
}

class WrongSize final : public FakeRenderer {
  public:
    Result<RenderedImage> renderImage(const RenderSettings&, RequestMonitor&) override {
        RenderedImage image;
        image.color = Image(3, 3);
        return image;
    }
    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>&, const RenderSettings&, Recording&, RequestMonitor&) override {
        return std::vector<Color>(5);
    }
};

TEST(Trouble, ARendererThatReturnsTheWrongSizeIsFoundOut) {
    WrongSize renderer;
    const auto server = Server::start(renderer);
    ASSERT_OK(server);
    const auto connection = Connection::open({"127.0.0.1", (*server)->port()});
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->render(), rendererFailed);
    EXPECT_CODE((*connection)->tracePixel({0, 0}), rendererFailed);
}

TEST(Trouble, QuitEndsTheServerWhereThatIsAllowed) {
    Served served;
    ServerOptions options;
    options.allowQuit = true;
    served.start(options);
    const auto connection = served.connect();
    EXPECT_TRUE(connection->quitServer().ok());
    served.server->wait();
    served.server->stop();
    EXPECT_FALSE(connection->camera().ok());
}

TEST(Trouble, TheServersEndIsALostConnectionWithOneClearError) {
    Served served;
    Gate working, told;
    served.renderer.duringPixel = [&](Pixel, RequestMonitor& monitor) {
        working.open();
        while (!monitor.cancelled()) std::this_thread::yield();
    };
    served.start();
    std::atomic<int> lost{0};
    Connection::Options options;
    options.lost = [&](const Error& error) {
        EXPECT_EQ(error.code, ErrorCode::connectionLost);
        ++lost;
        told.open();
    };
    const auto connection = served.connect(options);
    auto trace = std::async(std::launch::async, [&] { return connection->tracePixel({0, 0}); });
    ASSERT_TRUE(working.wait());
    served.server.reset();
    const auto result = trace.get();
    ASSERT_FALSE(result.ok());
    EXPECT_TRUE(told.wait());
    EXPECT_FALSE(connection->isOpen());
    EXPECT_CODE(connection->info(), connectionLost);
    EXPECT_EQ(lost, 1);
}

TEST(Trouble, ClosingEndsCallsThatWaitAndIsNoLoss) {
    Served served;
    Gate working;
    served.renderer.duringPixel = [&](Pixel, RequestMonitor& monitor) {
        working.open();
        while (!monitor.cancelled()) std::this_thread::yield();
    };
    served.start();
    std::atomic<int> lost{0};
    Connection::Options options;
    options.lost = [&](const Error&) { ++lost; };
    const auto connection = served.connect(options);
    auto trace = std::async(std::launch::async, [&] { return connection->tracePixel({0, 0}); });
    ASSERT_TRUE(working.wait());
    connection->close();
    EXPECT_CODE(trace.get(), connectionLost);
    EXPECT_CODE(connection->camera(), connectionLost);
    EXPECT_EQ(lost, 0);
}

class NotedTool final : public ServerTool {
  public:
    std::string name() const override { return "notes"; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor&) override {
        if (request.empty()) return Error{ErrorCode::invalidArgument, "The notes need at least one byte."};
        if (request[0] == std::byte{1}) throw std::runtime_error("torn page");
        return std::vector<std::byte>(request.rbegin(), request.rend());
    }
    void beginPixel(Pixel) override {
        notes += "(";
        recorder().setPathIndex(1000);
        recorder().addPathData("note", 5.f);
    }
    void endPixel(Pixel) override { notes += ")"; }
    void beginPath(Pixel, std::int64_t) override { notes += "["; }
    void endPath(Pixel, std::int64_t) override { notes += "]"; }
    void beginVertex(std::int32_t) override { notes += "<"; }
    void endVertex(std::int32_t) override { notes += ">"; }
    std::string notes;
};

TEST(Tools, AnswerRequestsAndAddDataToReplays) {
    Served served;
    served.renderer.verticesPerPath = 2;
    served.start();
    const auto tool = std::make_shared<NotedTool>();
    ASSERT_OK(served.server->addTool(tool));
    EXPECT_CODE(served.server->addTool(std::make_shared<NotedTool>()), invalidArgument);
    const auto connection = served.connect();
    EXPECT_EQ(connection->info()->tools, std::vector<std::string>{"notes"});
    const std::vector<std::byte> request{std::byte{2}, std::byte{3}};
    const auto answer = connection->askTool("notes", request);
    ASSERT_OK(answer);
    EXPECT_EQ(*answer, (std::vector<std::byte>{std::byte{3}, std::byte{2}}));
    EXPECT_CODE(connection->askTool("notes", {}), invalidArgument);
    EXPECT_CODE(connection->askTool("notes", std::vector<std::byte>(1, std::byte{1})), rendererFailed);

    client::TraceOptions options;
    options.samplesPerPixel = 1;
    const auto trace = connection->tracePixel({0, 0}, options);
    ASSERT_OK(trace);
    EXPECT_EQ(tool->notes, "([][<><>])");
    const auto path = trace->paths.findPath({0, 0}, 1000);
    ASSERT_TRUE(path);
    const auto columns = trace->paths.find(Scope::path, "note");
    ASSERT_EQ(columns.size(), 1u);
    EXPECT_EQ(trace->paths.last(*columns[0], *path), Value(5.f));
}

}  // namespace
}  // namespace emca::test
