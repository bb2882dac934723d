#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "link.h"
#include "published_server.h"

namespace emca::bridge {

/// What the thread of a PublishedServer holds: the connection, and how requests and replies go over it.
class PublishedServer::Session {
  public:
    explicit Session(const PublishedServerOptions& options) : options_(options) {}

    /// Connects and greets. The first time, names and plugins are learned; later they must be the same.
    Result<void> connect();
    const PublishedInfo& info() const { return info_; }
    const std::vector<std::int16_t>& plugins() const { return plugins_; }

    Result<PublishedCamera> camera();
    Result<PublishedScene> scene();
    Result<PublishedImage> image(std::uint32_t samplesPerPixel);
    Result<PublishedPixel> pixel(Pixel pixel, std::uint32_t samplesPerPixel);

    /// Says goodbye (or quit), waits a moment for the answer, and closes. \param quit  the server is to end
    void leave(bool quit = false);
    /// From any thread: what waits returns "cancelled".
    void interrupt();

  private:
    struct Open {
        explicit Open(const WireLimits& limits) : in(link, limits) {}
        Link link;
        WireReader in;
        bool swapped = false;
        bool used = false;   ///< has answered a request
    };

    Result<void> greet(Open& open);
    /// Sends a request and the one for the names behind it, and reads until the reply's id. Connects before, again if a
    /// connection that had rested proves to be gone.
    Result<void> begin(std::int16_t id, const std::vector<std::uint32_t>& numbers, std::int16_t reply, std::chrono::milliseconds limit);
    Result<void> send(std::int16_t id, const std::vector<std::uint32_t>& numbers);
    Result<void> awaitReply(std::int16_t reply, std::chrono::milliseconds limit, const std::string& what);
    /// Reads the names' answer behind a reply. A server that does not give it is left; the reply stays good.
    void end();
    /// Error of the reader; the connection, which nobody can read on, is left.
    Error broken();
    Error failed(Error error);
    void log(const std::string& remark) const { if (options_.log) options_.log(remark); }
    std::shared_ptr<Open> current() const;
    void replace(std::shared_ptr<Open> open);

    const PublishedServerOptions& options_;
    PublishedInfo info_;
    std::vector<std::int16_t> plugins_;
    bool known_ = false;                ///< info_ and plugins_ were learned
    std::vector<std::byte> names_;      ///< how an answer with the names begins, in the server's byte order
    mutable std::mutex mutex_;          ///< open_ itself, for interrupt()
    std::shared_ptr<Open> open_;
    bool interrupted_ = false;
};

}  // namespace emca::bridge
