#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emca/core/result.h"
#include "von_mises_fisher.h"

/// What the two halves of the plugin say to each other: a schema of its own, numbers lowest byte first. README.md has the
/// tables.
namespace mixture {

inline constexpr const char* kTool = "spherical mixture";
inline constexpr std::uint32_t kMaximumComponents = 64;

struct Request {
    std::uint32_t components = 8;
    std::uint64_t seed = 1;
    /// Where directions come from: bytes of a light-probe request that the server half hands on; or, if there are none,
    /// `directions`.
    std::vector<std::byte> lightProbe;
    std::vector<WeightedDirection> directions;
};

struct Reply {
    Fit fit;
    std::uint32_t directions = 0;       ///< that the lobes were fitted to
    std::vector<std::byte> lightProbe;  ///< the probe that they were fitted to; empty if there was none
};

std::vector<std::byte> encode(const Request& request);
std::vector<std::byte> encode(const Reply& reply);
/// Errors: protocolViolation (other bytes, cut, too long), invalidArgument (a value that makes no sense).
emca::Result<Request> decodeRequest(std::span<const std::byte> bytes);
emca::Result<Reply> decodeReply(std::span<const std::byte> bytes);

}  // namespace mixture
