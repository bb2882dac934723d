#pragma once

// How core types and the structs of emca.fbs lie on each other: columns are copied as they are in memory.

#include <bit>
#include <cstddef>
#include <type_traits>

#include "emca/core/color.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "emca/core/pixel.h"
#include "emca/core/shared_array.h"
#include "emca_generated.h"

namespace emca::protocol {

static_assert(std::endian::native == std::endian::little, "columns are copied as they are: swap their bytes here first");

template <typename Core>
struct WireOf { using type = Core; };
template <> struct WireOf<Pixel> { using type = wire::Pixel; };
template <> struct WireOf<Vec3f> { using type = wire::Vec3; };
template <> struct WireOf<Color> { using type = wire::Color; };
template <> struct WireOf<Triangle> { using type = wire::Triangle; };
template <> struct WireOf<NextEvent> { using type = wire::NextEvent; };
template <> struct WireOf<Contribution> { using type = wire::Contribution; };
template <> struct WireOf<Splat> { using type = wire::Splat; };
template <> struct WireOf<std::byte> { using type = std::uint8_t; };
template <typename Core> using Wire = typename WireOf<Core>::type;

template <typename Core>
constexpr bool sameLayout() {
    return sizeof(Core) == sizeof(Wire<Core>) && alignof(Core) == alignof(Wire<Core>) &&
           std::is_trivially_copyable_v<Core> && std::is_standard_layout_v<Core>;
}
static_assert(sameLayout<Pixel>() && sameLayout<Vec3f>() && sameLayout<Color>() && sameLayout<Triangle>());
static_assert(sameLayout<NextEvent>() && sameLayout<Contribution>() && sameLayout<Splat>());
static_assert(offsetof(NextEvent, visible) == 12 && offsetof(Contribution, misWeight) == 12);
static_assert(offsetof(Contribution, technique) == 16 && offsetof(Contribution, end) == 20 && offsetof(Splat, value) == 8);

inline wire::Vec3 toWire(Vec3f v) { return {v.x, v.y, v.z}; }
inline wire::Color toWire(Color c) { return {c.r, c.g, c.b}; }
inline wire::Rect toWire(const PixelRect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

inline Vec3f fromWire(const wire::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Color fromWire(const wire::Color& c) { return {c.r(), c.g(), c.b()}; }
inline PixelRect fromWire(const wire::Rect& r) { return {r.x0(), r.y0(), r.x1(), r.y1()}; }

}  // namespace emca::protocol
