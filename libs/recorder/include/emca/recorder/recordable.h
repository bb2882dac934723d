#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "emca/core/color.h"
#include "emca/core/value.h"
#include "emca/core/vector.h"

namespace emca {

/// How a renderer's own type becomes a recorded one, where its shape does not say it. Specialise with
/// `static auto convert(const T&)` that returns a type that is recordable already. Example: a spectrum class.
template <typename T>
struct Recordable {};

namespace detail {

template <typename T>
concept HasConversion = requires(const T& v) { Recordable<T>::convert(v); };

template <typename T>
concept HasXyz = requires(const T& v) { { v.x } -> std::convertible_to<double>; v.y; v.z; };
template <typename T>
concept HasXy = !HasXyz<T> && requires(const T& v) { { v.x } -> std::convertible_to<double>; v.y; };
template <typename T>
concept HasRgba = requires(const T& v) { { v.r } -> std::convertible_to<double>; v.g; v.b; v.a; };
template <typename T>
concept HasRgb = !HasRgba<T> && requires(const T& v) { { v.r } -> std::convertible_to<double>; v.g; v.b; };
/// x(), y(), z() as functions (Eigen, Mitsuba 3).
template <typename T>
concept HasXyzCalls = !HasXyz<T> && requires(const T& v) { { v.x() } -> std::convertible_to<double>; v.y(); v.z(); };

/// The stored component type: integers as int64, float as float, double as double.
template <typename T>
using Component = std::conditional_t<std::is_integral_v<T>, std::int64_t, std::conditional_t<std::same_as<T, float>, float, double>>;

/// Brings any recordable value to the type in which it is stored: bool, int64, float, double, their Vec2/Vec3, Color,
/// ColorA, string_view or span of float.
template <typename T>
constexpr auto stored(const T& v) {
    if constexpr (HasConversion<T>) {
        return stored(Recordable<T>::convert(v));
    } else if constexpr (std::same_as<T, bool> || std::same_as<T, float> || std::same_as<T, double> ||
                         std::same_as<T, Color> || std::same_as<T, ColorA> || std::same_as<T, std::string_view> ||
                         std::same_as<T, std::span<const float>>) {
        return v;
    } else if constexpr (std::is_integral_v<T>) {
        return static_cast<std::int64_t>(v);
    } else if constexpr (std::convertible_to<T, std::string_view>) {
        return std::string_view(v);
    } else if constexpr (HasXyz<T>) {
        using C = Component<std::remove_cvref_t<decltype(v.x)>>;
        return Vec3<C>{static_cast<C>(v.x), static_cast<C>(v.y), static_cast<C>(v.z)};
    } else if constexpr (HasXyzCalls<T>) {
        using C = Component<std::remove_cvref_t<decltype(v.x())>>;
        return Vec3<C>{static_cast<C>(v.x()), static_cast<C>(v.y()), static_cast<C>(v.z())};
    } else if constexpr (HasXy<T>) {
        using C = Component<std::remove_cvref_t<decltype(v.x)>>;
        return Vec2<C>{static_cast<C>(v.x), static_cast<C>(v.y)};
    } else if constexpr (HasRgba<T>) {
        return ColorA{static_cast<float>(v.r), static_cast<float>(v.g), static_cast<float>(v.b), static_cast<float>(v.a)};
    } else if constexpr (HasRgb<T>) {
        return Color{static_cast<float>(v.r), static_cast<float>(v.g), static_cast<float>(v.b)};
    } else if constexpr (std::convertible_to<const T&, std::span<const float>>) {
        return std::span<const float>(v);
    } else {
        static_assert(HasConversion<T>, "EMCA cannot record this type: specialise emca::Recordable for it");
    }
}

/// The type of a column of stored values T.
template <typename T>
constexpr ValueType storedType() {
    if constexpr (std::same_as<T, bool>) return ValueType::boolean;
    else if constexpr (std::same_as<T, std::int64_t>) return ValueType::integer;
    else if constexpr (std::same_as<T, Vec2i>) return ValueType::integer2;
    else if constexpr (std::same_as<T, Vec3i>) return ValueType::integer3;
    else if constexpr (std::same_as<T, float>) return ValueType::float1;
    else if constexpr (std::same_as<T, Vec2f>) return ValueType::float2;
    else if constexpr (std::same_as<T, Vec3f>) return ValueType::float3;
    else if constexpr (std::same_as<T, double>) return ValueType::double1;
    else if constexpr (std::same_as<T, Vec2d>) return ValueType::double2;
    else if constexpr (std::same_as<T, Vec3d>) return ValueType::double3;
    else if constexpr (std::same_as<T, Color>) return ValueType::color;
    else if constexpr (std::same_as<T, ColorA>) return ValueType::colorA;
    else if constexpr (std::same_as<T, std::string_view>) return ValueType::text;
    else {
        static_assert(std::same_as<T, std::span<const float>>);
        return ValueType::spectrum;
    }
}

/// A value, or a callable that makes one only while something is recorded.
template <typename T>
constexpr decltype(auto) resolved(T&& valueOrCallable) {
    if constexpr (std::invocable<T>)
        return std::forward<T>(valueOrCallable)();
    else
        return std::forward<T>(valueOrCallable);
}

template <typename T>
Vec3f toPosition(const T& v) {
    const auto s = stored(v);
    return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z)};
}

template <typename T>
Color toColor(const T& v) {
    const auto s = stored(v);
    using S = std::remove_cvref_t<decltype(s)>;
    if constexpr (std::same_as<S, Color>)
        return s;
    else if constexpr (std::same_as<S, ColorA>)
        return {s.r, s.g, s.b};
    else if constexpr (std::is_arithmetic_v<S>)
        return Color(static_cast<float>(s));
    else
        return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z)};
}

}  // namespace detail
}  // namespace emca
