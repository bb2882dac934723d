#pragma once

#include <array>
#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "emca/client/connection.h"
#include "emca/protocol/frame.h"
#include "emca/protocol/messages.h"

namespace emca::client {

/// The socket and what waits for answers on it. Shared by the connection and by the calls that run, so that one may go
/// before the other.
class Link : public std::enable_shared_from_this<Link> {
  public:
    /// Looks at one message of an answer, in the connection's thread. \return the outcome if it was the last one
    using Handler = std::function<std::optional<Result<void>>(protocol::Body& body)>;

    Link(Address address, Connection::Options options);
    ~Link();

    /// Connects and greets; the thread runs afterwards.
    Result<void> open();
    bool isOpen() const { return open_; }
    const Address& address() const { return address_; }
    /// Does not change after open().
    const Greeting& greeting() const { return greeting_; }
    void close();

    /// Sends a request and waits until `handler` has its last message, or until failure, loss, silence or cancel.
    /// After the return the handler is not called any more.
    Result<void> request(protocol::Body body, Handler handler, const std::atomic<bool>* cancel = nullptr);

  private:
    using Clock = std::chrono::steady_clock;
    struct Pending {
        Handler handler;
        std::optional<Result<void>> outcome;
    };

    Result<void> connect(Clock::time_point deadline);
    Result<void> greet(Clock::time_point deadline);
    /// Runs the network in this thread until `done` or the deadline. \return false at the deadline
    bool runUntil(const bool& done, Clock::time_point deadline);
    Result<void> waitFor(std::uint64_t number, Pending& pending, const std::atomic<bool>* cancel, Clock::time_point sent);
    Clock::time_point lastSign() const { return Clock::time_point(Clock::duration(lastReceived_.load())); }

    void readHeader();
    void readPayload(std::size_t bytes);
    void received(const protocol::Frame& frame);
    void send(protocol::Frame frame);
    void write();
    /// The connection is over; every waiting call gets the error. In the connection's thread.
    void fail(Error error);

    const Address address_;
    const Connection::Options options_;
    Greeting greeting_;
    asio::io_context context_{1};
    asio::ip::tcp::socket socket_{context_};
    std::thread thread_;
    std::atomic<bool> open_{false}, closing_{false};
    std::atomic<Clock::rep> lastReceived_{0};
    std::array<std::byte, protocol::kHeaderBytes> header_{};
    std::size_t maximumRequestBytes_ = protocol::kMaximumRequestBytes;

    struct Outgoing {
        protocol::Frame frame;
        std::array<std::byte, protocol::kHeaderBytes> header;
    };
    std::deque<Outgoing> outgoing_;  // connection's thread

    std::mutex closeMutex_;                        // joining happens once
    std::mutex mutex_;                             // the members below, and every call of a handler
    std::condition_variable changed_;
    std::map<std::uint64_t, Pending*> pending_;    // each lives on the stack of its call
    std::uint64_t nextRequest_ = 1;
    std::optional<Error> lost_;
};

}  // namespace emca::client
