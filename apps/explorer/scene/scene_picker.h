#pragma once

#include <optional>
#include <span>
#include <vector>

#include "path_geometry.h"
#include "picking.h"

namespace emca::explorer {

/// What can be picked: both lists ascend.
struct PickContext {
    const PathSet& paths;
    const PathGeometry& geometry;
    std::span<const Index> selected;  ///< drawn bright: they come first
    std::span<const Index> drawn;     ///< the others that are visible
};

struct Picked {
    Index path = 0;
    std::optional<Index> vertex;      ///< nothing if a line was hit
};

inline constexpr double kVertexRadius = 9, kLineRadius = 5;   ///< pixels around the cursor

/// What is under the cursor: vertices before lines, selected paths before others, the front-most of each.
std::optional<Picked> pickAt(const PickContext& context, const Projection& projection, double x, double y);
/// As pickAt, but only vertices.
std::optional<Index> pickVertex(const PickContext& context, const Projection& projection, double x, double y);

struct PickedInside {
    std::vector<Index> paths;         ///< ascending
    std::optional<Index> vertex;      ///< if exactly one is inside
};
/// Paths with a vertex inside the rectangle; without any, those that cross it.
PickedInside pickInside(const PickContext& context, const Projection& projection, ScreenRect rect);

}  // namespace emca::explorer
