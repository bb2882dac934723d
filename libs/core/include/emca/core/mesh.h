#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"

namespace emca {

using Triangle = std::array<std::uint32_t, 3>;  ///< indices into Mesh::positions, counter-clockwise seen from the front

/// One shape as triangles. Its place in the renderer's list is the `mesh` of setIntersectionSurface, a triangle's place
/// in `triangles` the `face`. Analytic shapes come tessellated.
struct Mesh {
    std::string name;               ///< as the scene calls it; may be empty
    std::string material;           ///< name of its material; may be empty
    std::vector<Vec3f> positions;   ///< world space
    std::vector<Triangle> triangles;
    Color diffuse{0.5f};            ///< rough colour for display, in [0, 1]
    Color emission{0.f};            ///< radiance it emits, black if none
    bool isEmitter() const { return !isBlack(emission); }
};

struct BoundingBox {
    Vec3f min, max;
    bool empty = true;
    void extend(Vec3f p);
    Vec3f centre() const { return (min + max) * 0.5f; }
    float diagonal() const { return empty ? 0.f : length(max - min); }
};

/// Finite positions only: a NaN vertex does not spoil the box.
BoundingBox boundingBox(const std::vector<Mesh>& meshes);

/// Every index inside `positions`; the error names mesh and triangle.
Result<void> validate(const Mesh& mesh);

}  // namespace emca
