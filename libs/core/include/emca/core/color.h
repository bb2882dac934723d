#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace emca {

/// Linear Rec. 709 RGB. Radiance: W/(sr m^2); reflectances, weights and throughputs: no unit.
struct Color {
    float r = 0, g = 0, b = 0;
    constexpr Color() = default;
    constexpr explicit Color(float grey) : r(grey), g(grey), b(grey) {}
    constexpr Color(float red, float green, float blue) : r(red), g(green), b(blue) {}
    friend constexpr bool operator==(const Color&, const Color&) = default;
};

/// As Color, with opacity in [0, 1]. Not premultiplied.
struct ColorA {
    float r = 0, g = 0, b = 0, a = 1;
    friend constexpr bool operator==(const ColorA&, const ColorA&) = default;
};

constexpr Color operator+(Color a, Color b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Color operator-(Color a, Color b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Color operator*(Color a, Color b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Color operator*(Color a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Color operator*(float s, Color a) { return a * s; }
constexpr Color operator/(Color a, float s) { return {a.r / s, a.g / s, a.b / s}; }
constexpr Color operator/(Color a, Color b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }
constexpr Color& operator+=(Color& a, Color b) { return a = a + b; }
constexpr Color& operator*=(Color& a, Color b) { return a = a * b; }
constexpr Color& operator*=(Color& a, float s) { return a = a * s; }
constexpr Color& operator/=(Color& a, float s) { return a = a / s; }

/// Relative luminance Y of linear Rec. 709 (ITU-R BT.709-6, section 3.2).
constexpr float luminance(Color c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
constexpr float maxComponent(Color c) { return std::max(c.r, std::max(c.g, c.b)); }
constexpr bool isBlack(Color c) {
    // By the bits, of which a zero of either sign has none but the sign: one test instead of three comparisons.
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return ((bits(c.r) | bits(c.g) | bits(c.b)) << 1) == 0;
}
inline bool isFinite(Color c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

}  // namespace emca
