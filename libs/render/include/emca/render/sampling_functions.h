#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "emca/core/vector.h"

/// Maps from the unit square to the domains of light transport, each with the density it has. `u` is in [0, 1)^2;
/// the closed interval is harmless. Local space: z is the axis or normal. Densities are per steradian for directions
/// and per unit area for points in the plane.

namespace emca::render {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;  ///< largest float below 1

inline float square(float x) { return x * x; }
/// Square root for arguments that only rounding makes negative.
inline float safeSqrt(float x) { return std::sqrt(std::max(x, 0.f)); }

/// Sine and cosine of an angle of at most pi / 4, to the last place: the first terms of their series.
inline std::pair<float, float> sinCosSmall(float angle) {
    // In pairs of terms, which do not wait for each other (Estrin's scheme).
    const float x = angle * angle, x2 = x * x;
    return {angle * ((1.f - x * (1.f / 6)) + x2 * ((1.f / 120 - x * (1.f / 5040)) + x2 * (1.f / 362880))),
            (1.f - x * 0.5f) + x2 * ((1.f / 24 - x * (1.f / 720)) + x2 * (1.f / 40320))};
}

/// Exchanges a and b where `condition` holds, without a branch: where it is random, half of all branches would be
/// predicted wrongly.
inline void swapIf(bool condition, float& a, float& b) {
    const auto bitsA = std::bit_cast<std::uint32_t>(a), bitsB = std::bit_cast<std::uint32_t>(b);
    const std::uint32_t change = (bitsA ^ bitsB) & (0u - static_cast<std::uint32_t>(condition));
    a = std::bit_cast<float>(bitsA ^ change);
    b = std::bit_cast<float>(bitsB ^ change);
}

/// Point in the unit disk; area-preserving and continuous, so that strata of the square stay compact.
/// Source: Shirley and Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
inline Vec2f squareToConcentricDisk(Vec2f u) {
    float radius = 2.f * u.x - 1.f;  // signed; of the two coordinates the larger one
    float across = 2.f * u.y - 1.f;
    const bool aboutY = !(std::abs(radius) > std::abs(across));  // the angle is then measured from the y axis
    swapIf(aboutY, radius, across);
    if (radius == 0.f) return {0.f, 0.f};
    const auto [sine, cosine] = sinCosSmall((kPi / 4.f) * (across / radius));
    Vec2f point{radius * cosine, radius * sine};
    swapIf(aboutY, point.x, point.y);
    return point;
}
inline constexpr float squareToConcentricDiskPdf() { return kInvPi; }

/// Direction about z with density cos(theta) / pi (Malley's method).
inline Vec3f squareToCosineHemisphere(Vec2f u) {
    const Vec2f d = squareToConcentricDisk(u);
    // The larger coordinate in the square is the radius in the disk: known before d is.
    const float radius = std::max(std::abs(2.f * u.x - 1.f), std::abs(2.f * u.y - 1.f));
    return {d.x, d.y, safeSqrt(1.f - radius * radius)};
}
inline float squareToCosineHemispherePdf(float cosTheta) { return std::max(cosTheta, 0.f) * kInvPi; }

/// Direction with polar cosine `cosTheta` and azimuth 2 pi `u`.
inline Vec3f directionFromCosine(float cosTheta, float u) {
    const float sinTheta = safeSqrt(1.f - cosTheta * cosTheta);
    const float phi = 2.f * kPi * u;
    return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}

inline Vec3f squareToUniformSphere(Vec2f u) { return directionFromCosine(1.f - 2.f * u.x, u.y); }
inline constexpr float squareToUniformSpherePdf() { return 0.25f * kInvPi; }

inline Vec3f squareToUniformHemisphere(Vec2f u) { return directionFromCosine(u.x, u.y); }
inline float squareToUniformHemispherePdf(float cosTheta) { return cosTheta >= 0.f ? 0.5f * kInvPi : 0.f; }

/// Direction within the cone about z whose half angle has cosine `cosMax`.
inline Vec3f squareToUniformCone(Vec2f u, float cosMax) {
    return directionFromCosine(1.f - u.x * (1.f - cosMax), u.y);
}
/// Density inside that cone; the caller knows whether a direction is inside.
inline float squareToUniformConePdf(float cosMax) { return 0.5f * kInvPi / (1.f - cosMax); }

/// Barycentric coordinates (b1, b2) of a point uniform in a triangle; b0 = 1 - b1 - b2. Density: 1 / area.
/// Source: Turk, "Generating Random Points in Triangles", Graphics Gems, 1990.
inline Vec2f squareToUniformTriangle(Vec2f u) {
    const float root = std::sqrt(1.f - u.x);
    return {1.f - root, u.y * root};
}

}  // namespace emca::render
