#include "emca/render/transform.h"

#include <cmath>
#include <numbers>

namespace emca::render {

namespace {

constexpr std::array<double, 16> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Some vector orthogonal to a unit vector.
Vec3d orthogonal(Vec3d v) {
    const Vec3d other = std::abs(v.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    return normalize(cross(v, other));
}

/// Cofactors of the linear part: its inverse transpose times its determinant.
std::array<Vec3d, 3> cofactors(const Transform& t) {
    const Vec3d a{t(0, 0), t(0, 1), t(0, 2)}, b{t(1, 0), t(1, 1), t(1, 2)}, c{t(2, 0), t(2, 1), t(2, 2)};
    return {cross(b, c), cross(c, a), cross(a, b)};
}

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }
Vec3f toFloat(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

}  // namespace

Transform::Transform() : m_(kIdentity) {}

Transform Transform::translate(Vec3d by) {
    return Transform({1, 0, 0, by.x, 0, 1, 0, by.y, 0, 0, 1, by.z, 0, 0, 0, 1});
}

Transform Transform::scale(Vec3d by) {
    return Transform({by.x, 0, 0, 0, 0, by.y, 0, 0, 0, 0, by.z, 0, 0, 0, 0, 1});
}

Transform Transform::rotate(Vec3d axis, double degrees) {
    const Vec3d a = normalize(axis);
    // Quarter turns are what people write most; sin and cos of rounded multiples of pi would leave 6e-17 in them.
    const double turn = std::remainder(degrees, 360.0);
    const double angle = turn * std::numbers::pi / 180.0;
    const double c = std::abs(turn) == 90 ? 0 : std::abs(turn) == 180 ? -1 : std::cos(angle);
    const double s = std::abs(turn) == 180 ? 0 : turn == 90 ? 1 : turn == -90 ? -1 : std::sin(angle);
    const double d = 1 - c;
    // Rodrigues' formula.
    return Transform({a.x * a.x * d + c, a.x * a.y * d - a.z * s, a.x * a.z * d + a.y * s, 0,
                      a.x * a.y * d + a.z * s, a.y * a.y * d + c, a.y * a.z * d - a.x * s, 0,
                      a.x * a.z * d - a.y * s, a.y * a.z * d + a.x * s, a.z * a.z * d + c, 0,
                      0, 0, 0, 1});
}

Transform Transform::lookAt(Vec3d origin, Vec3d target, Vec3d up) {
    const Vec3d direction = normalize(target - origin);
    Vec3d left = cross(up, direction);
    left = length(left) > 1e-12 * length(up) ? normalize(left) : orthogonal(direction);
    const Vec3d realUp = cross(direction, left);
    return Transform({left.x, realUp.x, direction.x, origin.x,
                      left.y, realUp.y, direction.y, origin.y,
                      left.z, realUp.z, direction.z, origin.z,
                      0, 0, 0, 1});
}

Transform Transform::operator*(const Transform& b) const {
    std::array<double, 16> product{};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            double sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += (*this)(row, k) * b(k, column);
            product[static_cast<std::size_t>(row * 4 + column)] = sum;
        }
    return Transform(product);
}

std::optional<Transform> Transform::inverse() const {
    // Gauss-Jordan elimination with the largest pivot of each column.
    std::array<double, 16> a = m_, inverse = kIdentity;
    const auto at = [](std::array<double, 16>& m, int row, int column) -> double& {
        return m[static_cast<std::size_t>(row * 4 + column)];
    };
    for (int column = 0; column < 4; ++column) {
        int pivot = column;
        for (int row = column + 1; row < 4; ++row)
            if (std::abs(at(a, row, column)) > std::abs(at(a, pivot, column)))
                pivot = row;
        const double value = at(a, pivot, column);
        if (!(std::abs(value) > 0) || !std::isfinite(value))
            return {};
        for (int k = 0; k < 4; ++k) {
            std::swap(at(a, pivot, k), at(a, column, k));
            std::swap(at(inverse, pivot, k), at(inverse, column, k));
        }
        for (int k = 0; k < 4; ++k) {
            at(a, column, k) /= value;
            at(inverse, column, k) /= value;
        }
        for (int row = 0; row < 4; ++row) {
            const double factor = at(a, row, column);
            if (row == column || factor == 0)
                continue;
            for (int k = 0; k < 4; ++k) {
                at(a, row, k) -= factor * at(a, column, k);
                at(inverse, row, k) -= factor * at(inverse, column, k);
            }
        }
    }
    for (const double value : inverse)
        if (!std::isfinite(value))
            return {};
    return Transform(inverse);
}

Vec3f Transform::point(Vec3f p) const {
    const Vec3d d = toDouble(p);
    const auto row = [&](int r) { return (*this)(r, 0) * d.x + (*this)(r, 1) * d.y + (*this)(r, 2) * d.z + (*this)(r, 3); };
    const Vec3d mapped{row(0), row(1), row(2)};
    const double w = row(3);
    return toFloat(w == 1 ? mapped : mapped / w);
}

Vec3f Transform::vector(Vec3f v) const {
    const Vec3d d = toDouble(v);
    const auto row = [&](int r) { return (*this)(r, 0) * d.x + (*this)(r, 1) * d.y + (*this)(r, 2) * d.z; };
    return toFloat({row(0), row(1), row(2)});
}

Vec3f Transform::normal(Vec3f n) const {
    const double det = determinant();
    if (!(std::abs(det) > 0) || !std::isfinite(det))
        return n;
    const auto rows = cofactors(*this);
    const Vec3d d = toDouble(n);
    const Vec3d mapped{dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)};
    // The cofactors are the inverse transpose times the determinant, of which only the sign survives normalising.
    return toFloat(normalize(det < 0 ? -mapped : mapped));
}

double Transform::determinant() const {
    const auto rows = cofactors(*this);
    return dot(Vec3d{(*this)(0, 0), (*this)(0, 1), (*this)(0, 2)}, rows[0]);
}

}  // namespace emca::render
