#include "emca/core/value.h"

#include <iterator>
#include <limits>

namespace emca {

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
                return i == 0 ? double(v.r) : i == 1 ? double(v.g) : i == 2 ? double(v.b) : kNone;
            } else if constexpr (std::is_same_v<T, ColorA>) {
                return i == 0 ? double(v.r) : i == 1 ? double(v.g) : i == 2 ? double(v.b) : i == 3 ? double(v.a) : kNone;
            } else if constexpr (std::is_same_v<T, std::vector<float>>) {
                return i < v.size() ? double(v[i]) : kNone;
            } else {
                return kNone;
            }
        },
        value);
}

}  // namespace emca
