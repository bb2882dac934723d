// Any bytes as a light-probe request or reply: refused, or valid and the same bytes when encoded again.
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "emca/probe/light_probe.h"

namespace {

template <typename Message>
void sameAgain(const Message& message, std::span<const std::byte> bytes) {
    const auto again = emca::probe::encode(message);
    // Bytes 6 and 7 are reserved: read over, written as 0.
    if (again.size() != bytes.size() || std::memcmp(again.data(), bytes.data(), 6) != 0 ||
        std::memcmp(again.data() + 8, bytes.data() + 8, bytes.size() - 8) != 0) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    if (const auto request = emca::probe::decodeRequest(bytes)) {
        if (!emca::probe::validate(*request)) std::abort();
        sameAgain(*request, bytes);
    }
    if (const auto probe = emca::probe::decodeProbe(bytes)) {
        if (probe->image.width() != probe->map.width() || probe->image.height() != probe->map.height()) std::abort();
        sameAgain(*probe, bytes);
    }
    return 0;
}
