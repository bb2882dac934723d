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

/// The renderer's half of a plugin (thesis, section 4.6.6): answers requests of its explorer half with bytes of its own
/// schema, and is told of the begin and end of each replayed pixel, so that it can add data of its own.
/// Called from server threads; replay calls come from the thread that replays.
class ServerTool {
  public:
    virtual ~ServerTool() = default;
    virtual std::string name() const = 0;  ///< unique; how requests address it

    /// \return the reply's bytes. Errors travel to the client as they are.
    virtual Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) = 0;

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
