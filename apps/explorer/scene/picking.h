#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "view_pose.h"

namespace emca::explorer {

/// Pixels with x in [x0, x1] and y in [y0, y1], as a dragged rectangle; corners in any order.
struct ScreenRect {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    ScreenRect normalized() const;
    bool contains(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

/// A line between two points, for picking; `id` is the caller's.
struct PickSegment {
    Vec3f from, to;
    std::uint32_t id = 0;
};

/// Tells whether point i can be picked; null: all.
using PickFilter = std::function<bool(std::uint32_t)>;

/// The point that a person means: of those within `radius` pixels of (x, y) the one nearest to the eye; of equally deep
/// ones the one nearest to the cursor. Points that are not finite are never picked. On the CPU and exact, so that it
/// neither depends on a driver nor costs a rendered frame.
std::optional<std::uint32_t> pickPoint(const Projection& projection, std::span<const Vec3f> points, double x, double y,
                                       double radius, const PickFilter& filter = {});

/// The front-most segment within `radius` pixels, by its depth where it is nearest to the cursor. Parts behind the eye
/// do not count.
std::optional<std::uint32_t> pickSegment(const Projection& projection, std::span<const PickSegment> segments, double x,
                                         double y, double radius);

/// All points inside the rectangle, in order.
std::vector<std::uint32_t> pointsInside(const Projection& projection, std::span<const Vec3f> points, ScreenRect rect,
                                        const PickFilter& filter = {});

/// Whether a part of the segment in front of the eye lies inside the rectangle.
bool crosses(const Projection& projection, Vec3f from, Vec3f to, ScreenRect rect);

}  // namespace emca::explorer
