#include "emca/protocol/frame.h"

#include <new>
#include <string>

namespace emca::protocol {

namespace {
// Root offset and file identifier: every FlatBuffer begins with them.
constexpr std::size_t kSmallestPayload = 8;
}  // namespace

std::array<std::byte, kHeaderBytes> header(const Frame& frame) {
    const auto size = static_cast<std::uint32_t>(frame.size());
    return {std::byte(size & 0xff), std::byte(size >> 8 & 0xff), std::byte(size >> 16 & 0xff), std::byte(size >> 24)};
}

Result<std::size_t> payloadBytes(std::span<const std::byte, kHeaderBytes> header, std::size_t limit) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < kHeaderBytes; ++i) size |= std::to_integer<std::size_t>(header[i]) << (8 * i);
    if (size < kSmallestPayload) {
        return Error{ErrorCode::protocolViolation,
                     "A message of " + std::to_string(size) + " bytes was announced, which none has: the other side does not speak EMCA's protocol."};
    }
    if (size > limit) {
        return Error{ErrorCode::tooLarge, "A message of " + std::to_string(size) + " bytes was announced, but at most " +
                                              std::to_string(limit) + " are accepted here."};
    }
    return size;
}

Result<std::shared_ptr<std::byte[]>> allocatePayload(std::size_t bytes) {
    static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 8);
    auto* memory = new (std::nothrow) std::byte[bytes];
    if (!memory) {
        return Error{ErrorCode::outOfMemory, "There is no memory for a message of " + std::to_string(bytes) + " bytes."};
    }
    return std::shared_ptr<std::byte[]>(memory);
}

}  // namespace emca::protocol
