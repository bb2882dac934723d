#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/vector.h"

namespace emca {

/// Type of a recorded value. The numbers travel (docs/protocol.md) and are the alternatives of Value in order.
enum class ValueType : std::uint8_t {
    boolean = 0, integer = 1, integer2 = 2, integer3 = 3, float1 = 4, float2 = 5, float3 = 6,
    double1 = 7, double2 = 8, double3 = 9, color = 10, colorA = 11, text = 12, spectrum = 13,
};
inline constexpr std::size_t kValueTypeCount = 14;

/// Any recorded value. Spectra are short arrays of float whose wavelengths the renderer knows.
using Value = std::variant<bool, std::int64_t, Vec2i, Vec3i, float, Vec2f, Vec3f, double, Vec2d, Vec3d, Color, ColorA,
                           std::string, std::vector<float>>;
static_assert(std::variant_size_v<Value> == kValueTypeCount);

inline ValueType typeOf(const Value& value) { return static_cast<ValueType>(value.index()); }

/// "bool", "int", "float2", "color", "text", …
const char* name(ValueType type);

/// Bytes of one value in a column: text is a 4-byte index into the string table, spectra have offsets beside them and
/// 4 bytes per entry.
constexpr std::size_t byteSize(ValueType type) {
    constexpr std::size_t kSizes[] = {1, 8, 16, 24, 4, 8, 12, 8, 16, 24, 12, 16, 4, 4};
    return kSizes[static_cast<std::size_t>(type)];
}

/// How many numbers make one value: 1 to 4; 0 for text and spectra.
constexpr int componentCount(ValueType type) {
    constexpr int kCounts[] = {1, 1, 2, 3, 1, 2, 3, 1, 2, 3, 3, 4, 0, 0};
    return kCounts[static_cast<std::size_t>(type)];
}

/// Component i as a number; NaN where the value has none (text, spectra beyond their length).
double component(const Value& value, std::size_t i);

}  // namespace emca
