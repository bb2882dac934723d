// What a client meets that is no EMCA server, or one that misbehaves: one clear error, no hang, no crash.
#include <array>
#include <asio.hpp>
#include <future>

#include "emca/protocol/codec.h"
#include "served.h"

namespace emca::test {
namespace {

using asio::ip::tcp;
using client::Address;
using client::Connection;

/// Listens and treats one caller as its script says, in a thread of its own.
class Stranger {
  public:
    explicit Stranger(std::function<void(tcp::socket&)> script) : acceptor_(context_, {asio::ip::address_v4::loopback(), 0}) {
        thread_ = std::thread([this, script = std::move(script)] {
            std::error_code error;
            tcp::socket socket(context_);
            acceptor_.accept(socket, error);
            if (!error) script(socket);
        });
    }
    ~Stranger() {
        // A caller that never came: call ourselves, so that accept returns.
        std::error_code ignored;
        tcp::socket(context_, tcp::v4()).connect(acceptor_.local_endpoint(ignored), ignored);
        thread_.join();
    }
    Address address() const { return {"127.0.0.1", acceptor_.local_endpoint().port()}; }

  private:
    asio::io_context context_;
    tcp::acceptor acceptor_;
    std::thread thread_;
};

void write(tcp::socket& socket, const std::string& bytes) {
    std::error_code ignored;
    asio::write(socket, asio::buffer(bytes), ignored);
}
void send(tcp::socket& socket, std::uint64_t request, protocol::Body body) {
    const auto frame = protocol::encode({request, std::move(body)});
    const auto header = protocol::header(*frame);
    std::error_code ignored;
    asio::write(socket, asio::buffer(header), ignored);
    asio::write(socket, asio::buffer(frame->data(), frame->size()), ignored);
}
/// Number of the next request, 0 at the end.
std::uint64_t receive(tcp::socket& socket) {
    std::error_code error;
    std::array<std::byte, 4> header{};
    asio::read(socket, asio::buffer(header), error);
    if (error) return 0;
    const std::size_t size = *protocol::payloadBytes(header, protocol::kMaximumRequestBytes);
    const auto payload = *protocol::allocatePayload(size);
    asio::read(socket, asio::buffer(payload.get(), size), error);
    if (error) return 0;
    return protocol::decode(protocol::Frame(payload, payload.get(), size))->request;
}
void waitForEnd(tcp::socket& socket) {
    std::array<char, 64> some{};
    std::error_code error;
    while (!error) socket.read_some(asio::buffer(some), error);
}
void welcome(tcp::socket& socket) {
    receive(socket);
    send(socket, 0, protocol::Welcome{"stranger", 1, {}, 1u << 20});
}

Connection::Options quick() {
    Connection::Options options;
    options.connectTimeout = std::chrono::milliseconds(2000);
    options.silenceTimeout = std::chrono::milliseconds(2000);
    return options;
}

TEST(Stranger, NobodyThere) {
    Address address;
    {
        asio::io_context context;
        tcp::acceptor free(context, {asio::ip::address_v4::loopback(), 0});
        address = {"127.0.0.1", free.local_endpoint().port()};
    }
    const auto opened = Connection::open(address);
    EXPECT_CODE(opened, connectionFailed);
    EXPECT_NE(opened.error().message.find(address.text()), std::string::npos);
    EXPECT_CODE(Connection::open({"no-such-host.invalid", 1}), connectionFailed);
}

TEST(Stranger, SpeaksAnotherLanguage) {
    using namespace std::string_literals;
    for (const std::string& words : {"HTTP/1.1 400 Bad Request\r\n\r\n"s, "SSH-2.0-OpenSSH_9.2\r\n"s, "\x10\0\0\0garbagegarbage!!"s}) {
        Stranger stranger([&words](tcp::socket& socket) {
            write(socket, words);
            waitForEnd(socket);
        });
        EXPECT_CODE(Connection::open(stranger.address(), quick()), protocolViolation);
    }
}

TEST(Stranger, HangsUp) {
    Stranger stranger([](tcp::socket& socket) { socket.close(); });
    EXPECT_CODE(Connection::open(stranger.address(), quick()), protocolViolation);
}

TEST(Stranger, SaysNothing) {
    Stranger stranger([](tcp::socket& socket) { waitForEnd(socket); });
    Connection::Options options;
    options.connectTimeout = std::chrono::milliseconds(50);
    EXPECT_CODE(Connection::open(stranger.address(), options), timedOut);
}

TEST(Stranger, GreetsHalfAndFallsSilent) {
    Stranger stranger([](tcp::socket& socket) {
        write(socket, std::string("\x40\0\0\0EM", 6));
        waitForEnd(socket);
    });
    Connection::Options options;
    options.connectTimeout = std::chrono::milliseconds(50);
    EXPECT_CODE(Connection::open(stranger.address(), options), timedOut);
}

TEST(Stranger, WantsAVersionThatWeDoNotKnow) {
    Stranger stranger([](tcp::socket& socket) {
        receive(socket);
        send(socket, 0, protocol::Welcome{"stranger", 77, {}, 0});
        waitForEnd(socket);
    });
    EXPECT_CODE(Connection::open(stranger.address(), quick()), versionMismatch);
}

TEST(Stranger, AnswersWithSilence) {
    Stranger stranger([](tcp::socket& socket) {
        welcome(socket);
        waitForEnd(socket);
    });
    auto options = quick();
    options.silenceTimeout = std::chrono::milliseconds(50);
    std::promise<Error> lost;
    options.lost = [&](const Error& error) { lost.set_value(error); };
    auto connection = Connection::open(stranger.address(), options);
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->info(), timedOut);
    EXPECT_EQ(lost.get_future().get().code, ErrorCode::timedOut);
    EXPECT_CODE((*connection)->info(), connectionLost);
}

TEST(Stranger, SignsOfLifeKeepARequestAlive) {
    Gate finished;
    Stranger stranger([&](tcp::socket& socket) {
        welcome(socket);
        const std::uint64_t request = receive(socket);
        asio::steady_timer timer(socket.get_executor());
        for (int i = 0; i < 12; ++i) {  // together longer than the silence that is allowed
            timer.expires_after(std::chrono::milliseconds(50));
            timer.wait();
            send(socket, request, protocol::Progress{0.1f, true});
        }
        send(socket, request, Camera{});
        waitForEnd(socket);
    });
    auto options = quick();
    options.silenceTimeout = std::chrono::milliseconds(400);
    auto connection = Connection::open(stranger.address(), options);
    ASSERT_OK(connection);
    EXPECT_TRUE((*connection)->camera().ok());
}

TEST(Stranger, DiesInTheMiddleOfAnAnswer) {
    Stranger stranger([](tcp::socket& socket) {
        welcome(socket);
        receive(socket);
        write(socket, std::string("\x00\x01\0\0\x10\0\0\0EMCA", 12));
        socket.close();
    });
    auto connection = Connection::open(stranger.address(), quick());
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->info(), connectionLost);
    EXPECT_FALSE((*connection)->isOpen());
}

TEST(Stranger, AnnouncesMoreThanIsAllowed) {
    Stranger stranger([](tcp::socket& socket) {
        welcome(socket);
        receive(socket);
        write(socket, std::string("\xff\xff\xff\x7f", 4));
        waitForEnd(socket);
    });
    auto options = quick();
    options.maximumFrameBytes = 1u << 20;
    auto connection = Connection::open(stranger.address(), options);
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->info(), tooLarge);
}

TEST(Stranger, AnswersAnotherQuestion) {
    Stranger stranger([](tcp::socket& socket) {
        welcome(socket);
        send(socket, receive(socket), protocol::Done{});
        send(socket, receive(socket), protocol::ImageRows{0, 1, std::vector<Color>(1), std::vector<float>(1), {}, true});
        send(socket, receive(socket), protocol::SceneChunk{5, 0, 0, {}, true});
        protocol::TraceResult other;  // of no pixel at all
        send(socket, receive(socket), other);
        other.pixels = {{3, 4}};
        other.replays.resize(1);
        send(socket, receive(socket), other);
        const std::uint64_t last = receive(socket);
        send(socket, last + 50, protocol::Done{});  // of a call that was cancelled, say: ignored
        send(socket, last, Camera{});
        waitForEnd(socket);
    });
    auto connection = Connection::open(stranger.address(), quick());
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->info(), protocolViolation);
    EXPECT_CODE((*connection)->render(), protocolViolation);
    EXPECT_CODE((*connection)->meshes(), protocolViolation);
    EXPECT_CODE((*connection)->tracePixel({4, 3}), protocolViolation);
    EXPECT_CODE((*connection)->tracePixel({4, 3}), protocolViolation);
    EXPECT_TRUE((*connection)->camera().ok());
}

TEST(Stranger, CannotKeepACallThatIsCancelled) {
    Gate asked;
    std::promise<std::uint64_t> cancelled;
    Stranger stranger([&](tcp::socket& socket) {
        welcome(socket);
        const std::uint64_t request = receive(socket);
        asked.open();
        cancelled.set_value(receive(socket) == request ? request : 0);
        waitForEnd(socket);
    });
    auto connection = Connection::open(stranger.address(), quick());
    ASSERT_OK(connection);
    client::RequestObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    auto call = std::async(std::launch::async, [&] { return (*connection)->tracePixel({0, 0}, {}, observer); });
    ASSERT_TRUE(asked.wait());
    *observer.cancel = true;
    EXPECT_CODE(call.get(), cancelled);  // without waiting for the other side
    EXPECT_NE(cancelled.get_future().get(), 0u) << "which is told, by the request's number";
}

TEST(Stranger, AnOversizedRequestIsNotSent) {
    Stranger stranger([](tcp::socket& socket) {
        welcome(socket);
        waitForEnd(socket);
    });
    auto connection = Connection::open(stranger.address(), quick());
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->tracePixels(std::vector<Pixel>(200000)), tooLarge);
    EXPECT_TRUE((*connection)->isOpen());
    Connection::Options chatty;
    chatty.token = std::string(5000, 'x');
    EXPECT_CODE(Connection::open(stranger.address(), chatty), tooLarge);
}

}  // namespace
}  // namespace emca::test
