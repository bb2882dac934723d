#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "emca/protocol/messages.h"

namespace emca {

class ClientPort;

/// One request from its arrival to its last answer. The session and the worker share it.
struct Request {
    std::uint64_t id = 0;
    protocol::Body body;
    std::size_t bytes = 0;                    ///< of its frame, which `body` keeps alive
    std::shared_ptr<ClientPort> client;
    std::atomic<bool> cancelled{false};       ///< by the client, by its end, or by the server's
    std::atomic<bool> running{false};
    std::atomic<float> fraction{0};
};

/// A connected client as the workers see it. All functions may be called from any thread and never wait.
class ClientPort {
  public:
    /// Makes the next message of a long answer, or none at its end.
    using Source = std::function<std::optional<protocol::Body>()>;

    virtual ~ClientPort() = default;
    virtual std::uint64_t id() const = 0;
    /// True while it does not read what it asked for: no further request of it is begun.
    virtual bool congested() const = 0;
    /// Something about a running request; left out if the client reads too slowly.
    virtual void inform(const Request& request, protocol::Body body) = 0;
    /// A message that comes before those of stream() or finish().
    virtual void send(const Request& request, protocol::Body body) = 0;
    /// The last message of a request.
    virtual void finish(const Request& request, protocol::Body body) = 0;
    /// The rest of an answer, made piece by piece as fast as the client reads; the end of the source ends the request.
    virtual void stream(const Request& request, Source source) = 0;
};

}  // namespace emca
