#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/client/connection.h"
#include "emca/core/result.h"
#include "emca/doctor/finding.h"

// `emca doctor`: does a server do what views, queries and people rely on? docs/integrations/doctor.md has a section for
// each check.
namespace emca::doctor {

struct ExaminationOptions {
    std::uint32_t pixels = 0;           ///< to replay; 0: 100, or 20 if `quick`
    std::uint64_t pixelSeed = 1;        ///< chooses them; the same seed chooses the same
    std::uint32_t samplesPerPixel = 0;  ///< 0: the scene's, but at most 16
    std::uint64_t seed = 0;             ///< of the renderer
    bool hasSeed = false;
    std::string integrator, sampler;    ///< empty: as the scene says
    bool quick = false;                 ///< leaves out what takes long: concurrent, cancel, overhead, layers
    std::vector<std::string> only;      ///< names of checks; empty: all
    double cancelLimitSeconds = 2;      ///< longer work after a cancel is a fault
    client::Connection::Options connection;
};

/// Told while an examination runs, in the calling thread but for `progress`, which comes from the connection's: be quick.
struct ExaminationObserver {
    std::function<void(std::string_view check)> began;
    std::function<void(double fraction)> progress;      ///< of the running check, in [0, 1]
    std::function<void(const Finding& finding)> finished;
    std::shared_ptr<std::atomic<bool>> cancel;           ///< set from anywhere to give up
};

struct Examination {
    std::vector<Finding> findings;       ///< in the order of checkNames()
    std::optional<client::ServerInfo> info;
    client::Greeting greeting;
    std::uint32_t samplesPerPixel = 0;   ///< with which it was examined
    std::uint64_t renderId = 0;          ///< the image that pixels were compared with; 0: none
    /// The connection could not be opened, or was lost and not opened again: checks after that are missing.
    std::optional<Error> lost;
    bool interrupted = false;            ///< the observer's `cancel` was set

    std::size_t count(Outcome outcome) const;
    const Finding* find(std::string_view check) const;
};

/// Names of all checks, in the order in which they run.
std::span<const std::string_view> checkNames();

/// Examines the server at an address; takes as long as a few renders of its image and `pixels` replays. Blocks, throws
/// nothing. What is wrong with the server is a finding, never an error.
/// Errors: invalidArgument (`only` names a check that there is not).
Result<Examination> examine(const client::Address& address, const ExaminationOptions& options, const ExaminationObserver& observer = {});

}  // namespace emca::doctor
