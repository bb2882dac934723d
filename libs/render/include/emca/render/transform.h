#pragma once

#include <array>
#include <optional>

#include "emca/core/vector.h"

namespace emca::render {

/// Affine or projective map of 3D space: row-major 4x4 matrix acting on column vectors. Kept in double, as scene files
/// chain many of them; points come in and go out as float.
class Transform {
  public:
    Transform();  ///< identity
    explicit Transform(const std::array<double, 16>& rowMajor) : m_(rowMajor) {}

    static Transform translate(Vec3d by);
    static Transform scale(Vec3d by);
    static Transform rotate(Vec3d axis, double degrees);
    /// Camera-to-world with +z along the viewing direction and +x to the left of the image, as Mitsuba's lookat.
    static Transform lookAt(Vec3d origin, Vec3d target, Vec3d up);

    /// First `b`, then this.
    Transform operator*(const Transform& b) const;
    /// Nothing if singular.
    std::optional<Transform> inverse() const;

    Vec3f point(Vec3f p) const;    ///< divides by w
    Vec3f vector(Vec3f v) const;   ///< linear part
    /// Multiplies by the inverse transpose and normalises. Identity for singular matrices.
    Vec3f normal(Vec3f n) const;
    double determinant() const;    ///< of the linear part; negative: mirrors
    double operator()(int row, int column) const { return m_[static_cast<std::size_t>(row * 4 + column)]; }
    friend bool operator==(const Transform&, const Transform&) = default;

  private:
    std::array<double, 16> m_;
};

}  // namespace emca::render
