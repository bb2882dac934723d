// What goes wrong between programs: whatever one client does, the renderer and the others live on.
#include <future>

#include "raw_client.h"

namespace emca::test {
namespace {

using client::Connection;

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
    ASSERT_TRUE(raw.isWelcome());
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
        ASSERT_TRUE(raw.isWelcome());
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
    ASSERT_TRUE(raw.isWelcome());
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
        ASSERT_TRUE(raw.isWelcome());
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
    ASSERT_TRUE(raw.isWelcome());
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

}  // namespace
}  // namespace emca::test
