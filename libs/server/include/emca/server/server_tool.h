#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/server/renderer.h"

namespace emca {

/// What a tool may ask of the server that it belongs to; outlives its tools' calls.
class ToolHost {
  public:
    /// What another tool of the same server answers, in the calling thread.
    /// Errors: notSupported (there is no such tool), and those of that tool.
    virtual Result<std::vector<std::byte>> ask(const std::string& tool, std::span<const std::byte> request, RequestMonitor& monitor) = 0;

  protected:
    ~ToolHost() = default;
};

/// The renderer's half of a plugin (thesis, section 4.6.6): answers requests of its explorer half with bytes of its own
/// schema, and is told of the begin and end of each replayed pixel, so that it can add data of its own.
/// Called from server threads; replay calls come from the thread that replays.
class ServerTool {
  public:
    virtual ~ServerTool() = default;
    virtual std::string name() const = 0;  ///< unique; how requests address it

    /// Called once, when the tool is added to a server; it may be asked from the first answer() on.
    virtual void setHost(ToolHost&) {}

    /// One request at a time, besides replays and renders; only one thing at a time unless the renderer is concurrent.
    /// \return the reply's bytes. Errors travel to the client as they are.
    virtual Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) = 0;

    /// Whether the functions below are to be called. Asked once. Where a tool observes, replays of many pixels run in one
    /// thread, so that it is told of one pixel at a time.
    virtual bool observesReplay() const { return true; }
    /// The recording is open in this thread: emca::recorder() adds to it.
    virtual void beginPixel(Pixel) {}
    virtual void endPixel(Pixel) {}
    /// A path or vertex of the replayed pixel was begun or ended by the recording thread.
    virtual void beginPath(Pixel, std::int64_t /*sample*/) {}
    virtual void endPath(Pixel, std::int64_t /*sample*/) {}
    virtual void beginVertex(std::int32_t /*depth*/) {}
    virtual void endVertex(std::int32_t /*depth*/) {}
};

}  // namespace emca
