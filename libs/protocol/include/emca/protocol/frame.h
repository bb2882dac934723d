#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "emca/core/result.h"
#include "emca/core/shared_array.h"

namespace emca::protocol {

/// The payload of one frame: a FlatBuffer with the file identifier "EMCA", aligned to 8 bytes, without its length.
/// Decoded messages look into it and keep it alive.
using Frame = SharedArray<std::byte>;

/// On the wire a frame is its payload's length, 4 bytes, little-endian, and the payload.
inline constexpr std::size_t kHeaderBytes = 4;

inline constexpr std::uint16_t kMinimumVersion = 1, kMaximumVersion = 1;

// A longer frame is not read, not even into memory.
inline constexpr std::size_t kMaximumHandshakeBytes = 4u << 10;   ///< the first frame of each side
inline constexpr std::size_t kMaximumRequestBytes = 16u << 20;    ///< client to server
inline constexpr std::size_t kMaximumReplyBytes = 1u << 30;       ///< server to client
inline constexpr std::size_t kChunkBytes = 4u << 20;              ///< of scenes, images and layers, if the client does not say
inline constexpr std::size_t kMaximumSurfaceLayers = 4096;        ///< of one answer
inline constexpr std::uint64_t kMaximumSurfaceFaces = 1u << 28;   ///< refined ones, of all meshes

std::array<std::byte, kHeaderBytes> header(const Frame& frame);

/// Length of the payload that follows a header.
/// Errors: protocolViolation (shorter than any message), tooLarge (beyond `limit`).
Result<std::size_t> payloadBytes(std::span<const std::byte, kHeaderBytes> header, std::size_t limit);

/// Memory for a payload, aligned to 8 bytes, not initialised. Errors: outOfMemory.
Result<std::shared_ptr<std::byte[]>> allocatePayload(std::size_t bytes);

}  // namespace emca::protocol
