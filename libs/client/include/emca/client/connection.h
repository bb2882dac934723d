#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/image.h"
#include "emca/core/match_counts.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "emca/core/replay.h"
#include "emca/core/result.h"
#include "emca/core/surface_field.h"

namespace emca::client {

/// Where a renderer listens.
struct Address {
    std::string host = "127.0.0.1";
    std::uint16_t port = 50013;
    /// "host:port", "[v6]:port", "host" or "port". Errors: invalidArgument.
    static Result<Address> parse(const std::string& text);
    std::string text() const;
    friend bool operator==(const Address&, const Address&) = default;
};

/// A layer of 3D data on surfaces that a render has collected.
struct CollectedLayer {
    LayerDescription description;
    std::uint64_t samples = 0;   ///< values added; an exact count
    double total = 0;            ///< their sum
    friend bool operator==(const CollectedLayer&, const CollectedLayer&) = default;
};

/// What the renderer and its server say about themselves.
struct ServerInfo {
    std::string renderer, scene, integrator, sampler;
    std::uint32_t width = 0, height = 0;
    std::uint32_t samplesPerPixel = 1;
    std::uint64_t seed = 0;
    std::uint64_t triangles = 0, meshes = 0;
    std::uint32_t maximumSamplesPerPixel = 0, maximumPixelsPerTrace = 0;
    std::vector<std::string> capabilities;
    std::vector<std::string> tools;         ///< names of server tools
    std::uint64_t latestRender = 0;         ///< render id of the newest finished image, 0 if none
    std::vector<LayerDescription> layers;   ///< 3D data that a render can collect (RenderOptions::layers)
    std::uint64_t surfaceRender = 0;        ///< the newest render with layers that the server keeps, 0 if none
    std::vector<CollectedLayer> collected;  ///< its layers
    std::uint64_t maximumSurfaceBudget = 0; ///< bytes
};

/// A finished image: its pixels, and the id under which the server keeps it for verdicts.
struct Render {
    std::uint64_t id = 0;
    std::uint32_t samplesPerPixel = 0;
    std::uint64_t seed = 0;
    std::string integrator, sampler;
    double seconds = 0;          ///< the renderer's own time
    RenderedImage image;
    std::vector<LayerDescription> layers;  ///< collected on surfaces meanwhile: Connection::surface fetches them
    SurfaceCounts surfaceCounts;           ///< all 0 without layers
    std::uint64_t surfaceFaces = 0;        ///< refined faces that have values
    std::vector<std::uint64_t> layerSamples;  ///< values added to each of them; exact counts
};

/// Zero or empty: as the scene says.
struct RenderOptions {
    std::uint32_t samplesPerPixel = 0;
    std::string integrator, sampler;
    std::uint64_t seed = 0;
    bool hasSeed = false;
    bool preview = true;    ///< send tiles while rendering
    std::vector<std::string> layers;  ///< 3D data to collect on surfaces, names out of ServerInfo::layers; empty: none
    std::uint64_t surfaceBudget = 0;  ///< bytes for them; 0: the server's default
};

enum class VerdictAgainst : std::uint8_t { latestMatching = 0, renderId = 1, givenColors = 2, nothing = 3 };

struct TraceOptions {
    std::uint32_t samplesPerPixel = 0;        ///< 0: those of the render that the verdict is about, else the scene's
    std::string integrator, sampler;
    std::uint64_t seed = 0;
    bool hasSeed = false;
    VerdictAgainst against = VerdictAgainst::latestMatching;
    std::uint64_t renderId = 0;               ///< with VerdictAgainst::renderId
    std::vector<Color> colors;                ///< with VerdictAgainst::givenColors: one per pixel, of an opened image
    /// Names of the columns wanted, core ones as docs/protocol.md names them; empty: all.
    std::vector<std::string> columns;
    std::string query;                        ///< only paths for which it is true (docs/queries.md); empty: all
    KeepMatches keep = KeepMatches::all;      ///< with a query: which of its paths the reply brings
    std::uint32_t keepCount = 0;              ///< with KeepMatches::brightest
    std::uint64_t budget = 0;                 ///< bytes of the recording; 0: the server's default
    bool locations = false;                   ///< source line of each value
};

/// Recorded paths of the pixels that were asked for.
struct Trace {
    std::vector<Pixel> pixels;        ///< as asked, in that order
    std::vector<Replay> replays;      ///< one per pixel
    std::uint32_t samplesPerPixel = 0;
    PathSet paths;
    RecordingStats stats;
    double renderSeconds = 0;         ///< the renderer's own time
    double totalSeconds = 0;          ///< from sending the request to the decoded reply
    std::uint64_t renderId = 0;       ///< the kept image that it was compared with; 0 if none
    std::uint64_t seed = 0;           ///< with these settings it was replayed
    std::string integrator, sampler;
    std::optional<MatchCounts> matches;  ///< what the query found, where there was one
};

/// How a server introduced itself in the handshake.
struct Greeting {
    std::string software;            ///< what serves, e.g. "EMCA server"; may be empty
    std::uint16_t version = 0;       ///< of the protocol (docs/protocol.md), the one both sides speak
};

/// Told while a request runs; calls come from the connection's own thread, so they must be quick.
struct RequestObserver {
    std::function<void(double fraction)> progress;                                     ///< in [0, 1]
    std::function<void(PixelRect rect, std::span<const Color> colors)> preview;        ///< renders only
    /// Set from anywhere to give up; the call returns ErrorCode::cancelled.
    std::shared_ptr<std::atomic<bool>> cancel;
};

/// One open connection to a renderer. Every function blocks until its answer is there, may be called from any thread,
/// and several may run at once (a pixel can be traced while an image renders). After connectionLost every further call
/// fails with connectionLost; open a new one.
/// Common errors: connectionLost, timedOut, protocolViolation, cancelled, and what the server replies.
class Connection {
  public:
    struct Options {
        std::string token;
        std::chrono::milliseconds connectTimeout{5000};
        /// Longest silence of the server during a request (it reports progress while it works).
        std::chrono::milliseconds silenceTimeout{30000};
        std::size_t maximumFrameBytes = std::size_t(1) << 30;
        /// Called once from the connection's thread when it is lost; not when it is closed by us.
        std::function<void(const Error&)> lost;
    };

    /// Errors: connectionFailed, versionMismatch, refused, protocolViolation (something else listens there), timedOut.
    static Result<std::unique_ptr<Connection>> open(const Address& address, Options options);
    static Result<std::unique_ptr<Connection>> open(const Address& address) { return open(address, Options()); }
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    const Address& address() const;
    const Greeting& greeting() const;
    bool isOpen() const;
    /// Calls that wait in other threads return connectionLost. So does destruction; it must not come from a callback.
    void close();

    Result<ServerInfo> info();
    Result<Camera> camera();
    /// World space; large scenes arrive in chunks and are put together. Progress goes by triangles.
    Result<std::vector<Mesh>> meshes(const RequestObserver& observer = {});
    /// Errors besides: invalidArgument (settings that the renderer cannot do, unknown layers), tooLarge (samples, budget).
    Result<Render> render(const RenderOptions& options = {}, const RequestObserver& observer = {});
    /// Surface layers of a render that the server keeps (the newest ones that had layers). The field obeys all rules of
    /// validate(), with meshes() of this connection if they came before, else with the triangle counts that the server
    /// says.
    /// \param renderId  0: the newest that has layers
    /// \param layers    names; empty: all that were collected
    /// Errors besides: invalidArgument (no such render or layer is kept), notSupported (the renderer has no layers).
    Result<SurfaceField> surface(std::uint64_t renderId = 0, std::vector<std::string> layers = {},
                                 const RequestObserver& observer = {});
    /// Errors besides: pixelOutOfRange, invalidArgument (samples), tooLarge.
    Result<Trace> tracePixel(Pixel pixel, const TraceOptions& options = {}, const RequestObserver& observer = {});
    Result<Trace> tracePixels(std::vector<Pixel> pixels, const TraceOptions& options = {}, const RequestObserver& observer = {});
    Result<Trace> traceRect(PixelRect rect, const TraceOptions& options = {}, const RequestObserver& observer = {});
    /// Bytes of a server tool's own schema.
    Result<std::vector<std::byte>> askTool(const std::string& tool, std::span<const std::byte> request,
                                           const RequestObserver& observer = {});
    /// Asks the server to end. Errors: notSupported, unless it was started so that clients may end it.
    Result<void> quitServer();

  private:
    class Impl;
    explicit Connection(std::unique_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;  // calls that run hold it too
};

}  // namespace emca::client
