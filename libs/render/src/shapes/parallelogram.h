#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "emca/render/triangle_mesh.h"

namespace emca::render {

/// A mesh of two triangles that form a parallelogram, as most lights are. A point chosen on it is linear in the two
/// random numbers: no triangle has to be chosen first, and strata of the square stay compact.
class Parallelogram {
  public:
    /// Nothing unless the mesh is one: the corner that the others determine may be off by a quarter of `positionError`.
    /// \param positionError  bound on how far rounding puts a point off the triangles, in scene units
    static std::optional<Parallelogram> of(const TriangleMesh& mesh, float positionError);

    /// Uniform by area for uniform u in [0, 1]^2.
    Vec3f at(Vec2f u) const { return corner_ + first_ * u.x + second_ * u.y; }
    Vec3f normal() const { return normal_; }  ///< unit
    float positionError() const { return positionError_; }
    /// The u of a point of it, up to rounding.
    Vec2f parametersOf(Vec3f position) const {
        const Vec3f offset = position - corner_;
        return {std::clamp(dot(offset, dualFirst_), 0.f, 1.f), std::clamp(dot(offset, dualSecond_), 0.f, 1.f)};
    }
    /// The triangle that holds the point.
    std::int32_t face(Vec2f u) const { return u.x + u.y > 1.f ? 1 : 0; }
    /// The point's barycentric coordinates in that triangle: weights of its second and third vertex.
    Vec2f barycentrics(Vec2f u) const {
        const Half& half = halves_[u.x + u.y > 1.f ? 1 : 0];
        return {std::max(half.origin.x + half.alongFirst.x * u.x + half.alongSecond.x * u.y, 0.f),
                std::max(half.origin.y + half.alongFirst.y * u.x + half.alongSecond.y * u.y, 0.f)};
    }

  private:
    /// Of one triangle: barycentric coordinates at u = (0, 0), and how they change with u.x and u.y.
    struct Half {
        Vec2f origin, alongFirst, alongSecond;
    };
    static Half half(std::uint32_t apex, const std::array<std::array<float, 3>, 3>& weights);

    Vec3f corner_, first_, second_, normal_;
    Vec3f dualFirst_, dualSecond_;  ///< dot products with these give parametersOf()
    float positionError_ = 0;
    std::array<Half, 2> halves_;  ///< of the first triangle, which has corner_, and of the second
};

}  // namespace emca::render
