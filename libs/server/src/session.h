#pragma once

#include <array>
#include <asio.hpp>
#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "emca/protocol/frame.h"
#include "emca/server/server.h"
#include "request.h"

namespace emca {

class Session;

/// What a session needs of its server. Called from the network thread.
class SessionHost {
  public:
    virtual ~SessionHost() = default;
    virtual const ServerOptions& options() const = 0;
    /// Whether one more client may come in. Counts it if so.
    virtual bool admit(Session& session) = 0;
    virtual void submit(std::shared_ptr<Request> request) = 0;
    /// The client does not want the answer any more. \return true if it was not begun
    virtual bool withdraw(const std::shared_ptr<Request>& request) = 0;
    virtual void readsAgain() = 0;
    virtual void closed(Session& session) = 0;
    virtual void quitRequested() = 0;
    virtual void log(const std::string& text) = 0;
};

/// One connected client: handshake, reading requests, writing answers. Lives in the network thread; the ClientPort
/// functions may be called from any. Whatever the other side does ends this session at worst.
class Session final : public ClientPort, public std::enable_shared_from_this<Session> {
  public:
    Session(asio::ip::tcp::socket socket, SessionHost& host, std::uint64_t id);

    void start();
    /// Says why and closes after the sentence is out; \param request  0 for the connection as a whole
    void refuse(Error error);
    void close();
    bool admitted() const { return state_ == State::open; }
    const std::string& peer() const { return peer_; }

    std::uint64_t id() const override { return id_; }
    bool congested() const override { return queuedBytes_ > kCongestedBytes; }
    void inform(const Request& request, protocol::Body body) override;
    void send(const Request& request, protocol::Body body) override;
    void finish(const Request& request, protocol::Body body) override;
    void stream(const Request& request, Source source) override;

  private:
    enum class State { handshake, open, leaving, closed };
    struct Outgoing {
        protocol::Frame frame;
        std::array<std::byte, protocol::kHeaderBytes> header{};
        std::function<void()> sent;
    };
    struct Stream {
        std::shared_ptr<Request> request;
        Source source;
    };
    /// Beyond it nothing new is begun for this client, and previews are left out.
    static constexpr std::size_t kCongestedBytes = 64u << 20;
    static constexpr std::size_t kPreviewBytes = 8u << 20;
    static constexpr std::size_t kMaximumPending = 64;
    static constexpr std::size_t kMaximumPendingBytes = 64u << 20;
    static constexpr std::size_t kMaximumOutgoing = 4096;   ///< messages

    void readHeader();
    void readPayload(std::size_t bytes);
    void received(const protocol::Frame& frame);
    void receivedHello(const protocol::Message& message);
    void receivedRequest(protocol::Message message, std::size_t bytes);
    void cancel(std::uint64_t request);
    void lost(const std::error_code& error);
    void drain();

    void post(protocol::Frame frame, std::uint64_t finished);
    void reply(std::uint64_t request, protocol::Body body, std::function<void()> sent = {});
    void enqueue(protocol::Frame frame, std::function<void()> sent = {});
    void write();
    bool pullStream();
    void written(std::size_t bytes);
    void forget(std::uint64_t request);
    void keepAlive();

    asio::ip::tcp::socket socket_;
    asio::steady_timer timer_;
    SessionHost& host_;
    const std::uint64_t id_;
    std::string peer_;
    State state_ = State::handshake;
    std::array<std::byte, protocol::kHeaderBytes> header_{};
    std::array<std::byte, 4096> discarded_{};
    std::map<std::uint64_t, std::shared_ptr<Request>> pending_;
    std::size_t pendingBytes_ = 0;
    std::deque<Outgoing> outgoing_;
    std::deque<Stream> streams_;
    bool writing_ = false;
    std::atomic<std::size_t> queuedBytes_{0};
};

}  // namespace emca
