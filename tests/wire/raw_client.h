#pragma once

#include <array>
#include <asio.hpp>
#include <optional>
#include <string>

#include "emca/protocol/codec.h"
#include "served.h"

namespace emca::test {

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
    /// Greets; true if the server says welcome.
    bool isWelcome() {
        greet();
        return receives<protocol::Welcome>();
    }

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
    asio::ip::tcp::socket socket_{context_};
    std::error_code ignored_;
};

inline void expectAlive(const Served& served) {
    const auto connection = served.connect();
    ASSERT_NE(connection, nullptr);
    EXPECT_TRUE(connection->tracePixel({1, 1}).ok());
}

}  // namespace emca::test
