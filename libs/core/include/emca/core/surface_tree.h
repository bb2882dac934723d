#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emca/core/surface_field.h"

// How a triangle's subdivision is walked: shared by who records, who rebuilds and who looks a face up.
namespace emca::detail {

/// Reads the bits of a SurfaceSubdivision, which may come from anywhere.
class SubdivisionReader {
  public:
    explicit SubdivisionReader(std::span<const std::uint8_t> bits) : bits_(bits) {}

    /// Whether the next triangle, `level` divisions below its base face, is divided. False, and failed(), at the end.
    bool divided(std::uint32_t level) {
        if (level >= kMaxSurfaceLevel || bits_.empty()) return false;  // no bits: nothing of the mesh is divided
        if (next_ >= bits_.size() * 8) {
            failed_ = true;
            return false;
        }
        const bool bit = bits_[next_ / 8] >> (next_ % 8) & 1;
        ++next_;
        return bit;
    }
    bool failed() const { return failed_; }
    std::uint64_t position() const { return next_; }

    /// After the last triangle: nothing missing, nothing left over but the zeros that fill the last byte.
    bool complete() const {
        if (failed_ || bits_.empty()) return !failed_;
        return (next_ + 7) / 8 == bits_.size() && (next_ % 8 == 0 || bits_.back() >> (next_ % 8) == 0);
    }

  private:
    std::span<const std::uint8_t> bits_;
    std::uint64_t next_ = 0;
    bool failed_ = false;
};

/// Where the point (u, v) of a triangle lies in one of its four children: barycentric coordinates in units of 2^-30, so
/// that every step down is exact. Coordinates u + v <= kOne stay so.
constexpr std::uint32_t kOne = 1u << 30;
constexpr std::uint32_t descend(std::uint32_t& u, std::uint32_t& v) {
    // Without branches: which child it is cannot be predicted, and this is done for every level of every sample.
    const std::uint32_t u2 = 2 * u, v2 = 2 * v;
    const std::uint32_t first = u2 >= kOne, second = (v2 >= kOne) & ~first;
    const std::uint32_t middle = (u2 + v2 > kOne) & ~(first | second);
    // The one in the middle is turned around: kOne - u2 instead of u2.
    const std::uint32_t turn = 0 - middle;
    u = (u2 ^ turn) - turn + ((middle - first) << 30);
    v = (v2 ^ turn) - turn + ((middle - second) << 30);
    return first + 2 * second + 3 * middle;
}

/// The children that contain the point, from the whole triangle down: two bits a level, the first in the highest, for
/// kMaxSurfaceLevel levels. As descend(), but for all levels at once (points on an edge may go to the other side): a
/// child of level k is a cell of a grid of 2^-k, halved by its diagonal, and the carry of u + v into that digit tells on
/// which side of it the point is. On the upper side, digits count backwards.
constexpr std::uint32_t surfacePath(std::uint32_t u, std::uint32_t v) {
    const std::uint32_t border = (u + v) >> 30;  // on the edge opposite to the first vertex: just inside
    const std::uint32_t fromU = border & static_cast<std::uint32_t>(u > v);
    u -= fromU;
    v -= border - fromU;
    const std::uint32_t side = (u + v) ^ u ^ v, above = side >> 1;
    const std::uint32_t first = u ^ above, second = v ^ above, middle = ~(first | second) & (side ^ above);
    const auto spread = [](std::uint32_t x) {  // the 16 highest of 30 digits, to every other bit
        x = x >> 14 & 0xffffu;
        x = (x | x << 8) & 0x00ff00ffu;
        x = (x | x << 4) & 0x0f0f0f0fu;
        x = (x | x << 2) & 0x33333333u;
        return (x | x << 1) & 0x55555555u;
    };
    return spread(first | middle) | spread(second | middle) << 1;
}
constexpr std::uint32_t firstChild(std::uint32_t path) { return path >> 30; }
constexpr std::uint32_t below(std::uint32_t path) { return path << 2; }

/// From weights of the second and third vertex, moved into the triangle. Finite ones only.
constexpr void toFixed(float fu, float fv, std::uint32_t& u, std::uint32_t& v) {
    const auto fixed = [](float f) { return f >= 1.f ? kOne : f > 0.f ? std::uint32_t(f * float(kOne)) : 0u; };
    u = fixed(fu);
    v = fixed(fv);
    if (u + v > kOne) {  // outside the edge opposite to the first vertex: along its normal in barycentric space
        const std::uint32_t excess = u + v - kOne, half = (excess + 1) / 2;
        const std::uint32_t fromU = u < half ? u : v < half ? excess - v : half;
        u -= fromU;
        v -= excess - fromU;
    }
}

}  // namespace emca::detail
