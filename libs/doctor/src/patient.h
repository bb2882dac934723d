#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "emca/client/connection.h"
#include "emca/doctor/examination.h"
#include "emca/doctor/path_checks.h"
#include "emca/doctor/scene_checks.h"

namespace emca::doctor {

using Clock = std::chrono::steady_clock;
inline double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Sets a flag when a time is over or a person gives up, for requests that must not be waited for any longer.
class Deadline {
  public:
    Deadline(double seconds, std::shared_ptr<std::atomic<bool>> person);
    ~Deadline();
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
    const std::shared_ptr<std::atomic<bool>>& flag() const { return flag_; }

  private:
    std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
    std::mutex mutex_;
    std::condition_variable changed_;
    bool over_ = false;
    std::thread thread_;
};

/// Pixels that were replayed one by one, and what their paths say.
struct Replays {
    struct One {
        Pixel pixel;
        Replay replay;
        double seconds = 0;  ///< the renderer's own time
    };
    static constexpr std::size_t kKept = 8;
    std::vector<One> pixels;
    std::vector<client::Trace> kept;   ///< whole, of the first kKept
    ValueCheck values;
    PathCheck paths;
    std::unique_ptr<SurfaceCheck> surfaces;   ///< null without meshes
    std::unique_ptr<CameraRays> rays;         ///< null without camera
    std::size_t asked = 0, failures = 0;
    std::optional<Error> error;        ///< the first failure
    Pixel failedPixel;
};

/// The server under examination: its connection, and what several checks want to know of it, asked once when first wanted.
class Patient {
  public:
    Patient(client::Address address, const ExaminationOptions& options, const ExaminationObserver& observer);

    const client::Address& address() const { return address_; }
    const ExaminationOptions& options() const { return options_; }
    Result<void> connect();
    client::Connection& connection() { return *connection_; }
    /// Another connection to the same server.
    Result<std::unique_ptr<client::Connection>> another() const { return client::Connection::open(address_, options_.connection); }
    bool interrupted() const { return observer_.cancel && *observer_.cancel; }

    const Result<client::ServerInfo>& info();
    const Result<Camera>& camera();
    const Result<std::vector<Mesh>>& meshes();
    const Result<client::Render>& image();   ///< the first render; all others are compared with it
    const Replays& replays();

    /// What is known already, without asking.
    std::optional<client::ServerInfo> knownInfo() const { return info_ && *info_ ? std::optional(**info_) : std::nullopt; }
    std::uint64_t renderId() const { return image_ && *image_ ? (*image_)->id : 0; }

    bool says(std::string_view capability);
    /// 0 if info() failed.
    std::uint32_t samples();
    client::RenderOptions renderOptions();
    client::TraceOptions traceOptions();     ///< with the settings of renderOptions(), compared with nothing
    /// With progress from `first` to `last` of the running check.
    client::RequestObserver watch(double first = 0, double last = 1) const;
    std::vector<double> imageSeconds;        ///< the renderer's own times of all plain renders with renderOptions()

  private:
    template <typename Options>
    Options withSettings();
    void replayAll(Replays& replays);
    std::vector<Pixel> choosePixels(const client::ServerInfo& info) const;
    const client::Address address_;
    const ExaminationOptions& options_;
    const ExaminationObserver& observer_;
    std::unique_ptr<client::Connection> connection_;
    std::optional<Result<client::ServerInfo>> info_;
    std::optional<Result<Camera>> camera_;
    std::optional<Result<std::vector<Mesh>>> meshes_;
    std::optional<Result<client::Render>> image_;
    std::unique_ptr<Replays> replays_;
};

/// What to do about an error; may be empty.
std::string adviceFor(ErrorCode code);
/// A check that could not be made as a request failed.
Finding broken(std::string check, const Error& error);
/// A check that has nothing to look at.
Finding skipped(std::string check, std::string why);

}  // namespace emca::doctor
