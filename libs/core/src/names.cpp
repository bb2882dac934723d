#include <iterator>

#include "emca/core/event.h"
#include "emca/core/replay.h"
#include "emca/core/result.h"

namespace emca {

const char* name(ErrorCode code) {
    switch (code) {
        case ErrorCode::internal: return "internal";
        case ErrorCode::invalidArgument: return "invalidArgument";
        case ErrorCode::pixelOutOfRange: return "pixelOutOfRange";
        case ErrorCode::notSupported: return "notSupported";
        case ErrorCode::fileNotFound: return "fileNotFound";
        case ErrorCode::fileUnreadable: return "fileUnreadable";
        case ErrorCode::fileUnwritable: return "fileUnwritable";
        case ErrorCode::connectionFailed: return "connectionFailed";
        case ErrorCode::connectionLost: return "connectionLost";
        case ErrorCode::timedOut: return "timedOut";
        case ErrorCode::protocolViolation: return "protocolViolation";
        case ErrorCode::versionMismatch: return "versionMismatch";
        case ErrorCode::refused: return "refused";
        case ErrorCode::tooLarge: return "tooLarge";
        case ErrorCode::cancelled: return "cancelled";
        case ErrorCode::rendererFailed: return "rendererFailed";
        case ErrorCode::addressInUse: return "addressInUse";
        case ErrorCode::parseFailed: return "parseFailed";
        case ErrorCode::outOfMemory: return "outOfMemory";
    }
    return "unknown";
}

const char* name(Event event) {
    constexpr const char* kNames[] = {"none", "reflect", "transmit", "volume", "emission", "background", "absorb", "pass"};
    const auto i = static_cast<std::size_t>(event);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

const char* name(Lobe lobe) {
    constexpr const char* kNames[] = {"none", "diffuse", "glossy", "specular", "straight"};
    const auto i = static_cast<std::size_t>(lobe);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

const char* name(Subpath subpath) { return subpath == Subpath::light ? "light" : "camera"; }

const char* name(Verdict verdict) {
    constexpr const char* kNames[] = {"unknown", "exact", "close", "different"};
    const auto i = static_cast<std::size_t>(verdict);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

const char* name(LightEnd end) {
    constexpr const char* kNames[] = {"automatic", "hit", "connected"};
    const auto i = static_cast<std::size_t>(end);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

const char* name(SumCheck check) {
    constexpr const char* kNames[] = {"unknown", "matches", "differs"};
    const auto i = static_cast<std::size_t>(check);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

}  // namespace emca
