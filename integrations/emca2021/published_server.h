#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "emca/core/pixel.h"
#include "messages.h"

namespace emca::bridge {

struct PublishedServerOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 50013;
    std::chrono::milliseconds connectLimit{10000};
    std::chrono::milliseconds answerLimit{300000};  ///< silence before a reply begins; images may take any time
    std::chrono::milliseconds silenceLimit{10000};  ///< silence within a reply
    std::chrono::milliseconds goodbyeLimit{2000};   ///< for taking leave, after which the connection is closed anyway
    bool quitAtEnd = false;                         ///< at the end, tell the server to end too
    WireLimits limits;
    std::function<void(const std::string&)> log;    ///< remarks for people; from any thread
};

/// One published server and the only connection to it: such a server has room for a single client, does one thing after
/// the other, and ends itself when its client vanishes. So a thread of its own asks, one request at a time; a caller that
/// gives up leaves the reply to that thread, which reads it to its end. A connection that the server dropped is opened
/// again with the next request. All functions may be called from any thread.
///
/// Behind each request goes one for the server's names, whose answer is known: so the end of a reply without length is seen
/// at once, and so is a server that does not answer at all because its renderer failed.
class PublishedServer {
  public:
    /// Connects and asks for its names. Errors: connectionFailed, timedOut, protocolViolation (something else listens there).
    static Result<std::unique_ptr<PublishedServer>> open(PublishedServerOptions options);
    /// Takes leave of the server; a running request is given up.
    ~PublishedServer();
    PublishedServer(const PublishedServer&) = delete;
    PublishedServer& operator=(const PublishedServer&) = delete;

    const PublishedInfo& info() const { return info_; }                 ///< as it was at the beginning
    const std::vector<std::int16_t>& plugins() const { return plugins_; }

    /// Asked while a call waits; true: return "cancelled".
    using Cancelled = std::function<bool()>;

    // Errors: those of open(), connectionLost, cancelled, rendererFailed (it did not answer but went on).
    Result<PublishedCamera> camera(const Cancelled& cancelled = {});
    Result<PublishedScene> scene(const Cancelled& cancelled = {});
    Result<PublishedImage> image(std::uint32_t samplesPerPixel, const Cancelled& cancelled = {});
    Result<PublishedPixel> pixel(Pixel pixel, std::uint32_t samplesPerPixel, const Cancelled& cancelled = {});

  private:
    class Session;
    explicit PublishedServer(PublishedServerOptions options);
    template <typename T>
    Result<T> call(std::function<Result<T>(Session&)> ask, const Cancelled& cancelled);
    Result<void> start();
    void work();

    PublishedServerOptions options_;
    PublishedInfo info_;
    std::vector<std::int16_t> plugins_;
    std::unique_ptr<Session> session_;

    std::mutex mutex_;
    std::condition_variable changed_;                  // a job, its end, or the end of all
    std::deque<std::function<void(Session&)>> jobs_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace emca::bridge
