#pragma once

#include <cstdint>
#include <functional>

#include "emca/core/mesh.h"
#include "emca/core/vector.h"

namespace emca::adapter {

/// An analytic shape (sphere, cylinder, disk, patch) as triangles: a grid over its parameters (u, v) in [0, 1]^2, with two
/// triangles a cell. So the triangle of a hit follows from the parameters that the renderer computes anyway:
///
///     const ParametricMesh sphere{.columns = 48, .rows = 24, .firstRowIsPoint = true, .lastRowIsPoint = true};
///     mesh = sphere.mesh([&](Vec2f uv) { return pointOnSphere(uv); });
///     emca.setIntersectionSurface(meshIndex, sphere.face(hit.uv));
///
/// A plain value.
struct ParametricMesh {
    std::uint32_t columns = 1, rows = 1;  ///< cells along u and v, at least 1
    /// The edge v = 0 (or 1) is a single point, as at the pole of a sphere: its cells have one triangle each. Both:
    /// at least 2 rows.
    bool firstRowIsPoint = false, lastRowIsPoint = false;
    /// The front is the side to which -(dp/du x dp/dv) looks instead of dp/du x dp/dv.
    bool flipped = false;

    /// \param position  of a parameter, world space; called (columns + 1) * (rows + 1) times
    /// \return  positions and triangles; the rest is for the caller
    Mesh mesh(const std::function<Vec3f(Vec2f uv)>& position) const;

    /// Triangle of mesh() in which a parameter lies; parameters outside of [0, 1]^2 are taken to the edge, NaN to 0.
    std::int32_t face(Vec2f uv) const;

    std::uint32_t faceCount() const { return columns * (2 * rows - std::uint32_t(firstRowIsPoint) - std::uint32_t(lastRowIsPoint)); }
};

}  // namespace emca::adapter
