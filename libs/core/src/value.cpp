#include "emca/core/value.h"

#include <limits>

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

const char* name(SumCheck check) {
    constexpr const char* kNames[] = {"unknown", "matches", "differs"};
    const auto i = static_cast<std::size_t>(check);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

const char* name(ValueType type) {
    constexpr const char* kNames[] = {"bool",   "int",     "int2",    "int3",    "float", "float2", "float3",
                                      "double", "double2", "double3", "color",   "rgba",  "text",   "spectrum"};
    const auto i = static_cast<std::size_t>(type);
    return i < std::size(kNames) ? kNames[i] : "unknown";
}

double component(const Value& value, std::size_t i) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return std::visit(
        [i](const auto& v) -> double {
            using T = std::decay_t<decltype(v)>;
            if constexpr (std::is_arithmetic_v<T>) {
                return i == 0 ? static_cast<double>(v) : kNone;
            } else if constexpr (std::is_same_v<T, Vec2i> || std::is_same_v<T, Vec2f> || std::is_same_v<T, Vec2d>) {
                return i == 0 ? static_cast<double>(v.x) : i == 1 ? static_cast<double>(v.y) : kNone;
            } else if constexpr (std::is_same_v<T, Vec3i> || std::is_same_v<T, Vec3f> || std::is_same_v<T, Vec3d>) {
                return i < 3 ? static_cast<double>(v[i]) : kNone;
            } else if constexpr (std::is_same_v<T, Color>) {
                return i == 0 ? v.r : i == 1 ? v.g : i == 2 ? v.b : kNone;
            } else if constexpr (std::is_same_v<T, ColorA>) {
                return i == 0 ? v.r : i == 1 ? v.g : i == 2 ? v.b : i == 3 ? v.a : kNone;
            } else if constexpr (std::is_same_v<T, std::vector<float>>) {
                return i < v.size() ? v[i] : kNone;
            } else {
                return kNone;
            }
        },
        value);
}

}  // namespace emca
