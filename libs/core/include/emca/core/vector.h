#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace emca {

/// Two components, stored in order. What they mean (random numbers, texture coordinates) the owner says.
template <typename T>
struct Vec2 {
    T x{}, y{};
    friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

/// Three components, stored in order. Positions and directions are in world space, in scene units, unless said otherwise.
template <typename T>
struct Vec3 {
    T x{}, y{}, z{};
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
    constexpr T operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
};

using Vec2f = Vec2<float>;
using Vec2d = Vec2<double>;
using Vec2i = Vec2<std::int64_t>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec3i = Vec3<std::int64_t>;

template <typename T> constexpr Vec2<T> operator+(Vec2<T> a, Vec2<T> b) { return {a.x + b.x, a.y + b.y}; }
template <typename T> constexpr Vec2<T> operator-(Vec2<T> a, Vec2<T> b) { return {a.x - b.x, a.y - b.y}; }
template <typename T> constexpr Vec2<T> operator*(Vec2<T> a, T s) { return {a.x * s, a.y * s}; }
template <typename T> constexpr Vec2<T> operator*(T s, Vec2<T> a) { return {a.x * s, a.y * s}; }

template <typename T> constexpr Vec3<T> operator+(Vec3<T> a, Vec3<T> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <typename T> constexpr Vec3<T> operator-(Vec3<T> a, Vec3<T> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <typename T> constexpr Vec3<T> operator-(Vec3<T> a) { return {-a.x, -a.y, -a.z}; }
template <typename T> constexpr Vec3<T> operator*(Vec3<T> a, T s) { return {a.x * s, a.y * s, a.z * s}; }
template <typename T> constexpr Vec3<T> operator*(T s, Vec3<T> a) { return a * s; }
template <typename T> constexpr Vec3<T> operator/(Vec3<T> a, T s) { return {a.x / s, a.y / s, a.z / s}; }
template <typename T> constexpr Vec3<T>& operator+=(Vec3<T>& a, Vec3<T> b) { return a = a + b; }
template <typename T> constexpr Vec3<T>& operator-=(Vec3<T>& a, Vec3<T> b) { return a = a - b; }
template <typename T> constexpr Vec3<T>& operator*=(Vec3<T>& a, T s) { return a = a * s; }

template <typename T> constexpr T dot(Vec3<T> a, Vec3<T> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <typename T> constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T> T length(Vec3<T> a) { return std::sqrt(dot(a, a)); }

/// Unit vector along `a`; `a` itself if its length is 0.
template <typename T> Vec3<T> normalize(Vec3<T> a) {
    const T l = length(a);
    return l > T(0) ? a / l : a;
}

template <typename T> bool isFinite(Vec3<T> a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

}  // namespace emca
