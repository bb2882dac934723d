#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "emca/core/result.h"
#include "emca/server/renderer.h"
#include "emca/server/server_tool.h"

namespace emca {

struct ServerOptions {
    std::string host = "127.0.0.1";  ///< loopback unless told otherwise; "0.0.0.0" or "::" for every interface
    std::uint16_t port = 0;          ///< 0: the system picks one
    std::string token;               ///< if not empty, clients must present it
    std::uint32_t maximumClients = 16;
    std::uint32_t maximumSamplesPerPixel = 1u << 20;   ///< beyond: tooLarge
    std::uint32_t maximumPixelsPerTrace = 1u << 16;
    std::size_t defaultBudget = 256u << 20;   ///< bytes of one recording where the client does not say
    std::size_t maximumBudget = 1u << 30;
    std::size_t surfaceBudget = 256u << 20;   ///< bytes of one collection of surface layers where the client does not say
    std::size_t maximumSurfaceBudget = std::size_t(4) << 30;
    std::uint32_t keptSurfaces = 2;           ///< collections kept, those of the newest renders with layers; at least 1
    std::uint32_t keptImages = 4;             ///< finished renders kept for verdicts; older ones are forgotten
    std::chrono::milliseconds handshakeTimeout{10000};  ///< a stranger that stays silent for so long is sent away
    bool allowQuit = false;                   ///< whether a client's quit request ends the server
    /// Where remarks for people go (a client came, was refused, …). Nothing is printed without it. Called from the
    /// thread that starts the server, then from the server's network thread: be quick.
    std::function<void(const std::string&)> log;
};

/// Serves one renderer to any number of explorers, scripts and command lines. Its threads are its own; the functions
/// below may be called from any thread. Destruction stops it: running work is cancelled and waited for.
class Server {
  public:
    /// Binds and begins to serve. The renderer must outlive the server.
    /// Errors: addressInUse (somebody else listens there), invalidArgument (unknown host).
    static Result<std::unique_ptr<Server>> start(Renderer& renderer, ServerOptions options = {});
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    std::uint16_t port() const;   ///< the one in use, also where 0 was asked for
    std::string address() const;  ///< "127.0.0.1:50013"
    /// Tools answer requests from now on. Errors: invalidArgument (a tool of that name is there).
    Result<void> addTool(std::shared_ptr<ServerTool> tool);
    /// Returns when a client's quit request or stop() ended the server.
    void wait();
    void stop();

  private:
    class Impl;
    explicit Server(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace emca
