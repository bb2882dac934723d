#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/mesh.h"

namespace emca::explorer {

/// One mesh with positions joined that are equal but for rounding (a millionth of its size), and the faces around each.
struct Welded {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
    std::vector<Vec3f> faceNormals;          ///< length: twice the area
    std::vector<std::uint32_t> firstFace;    ///< per position + 1, into `faces`
    std::vector<std::uint32_t> faces;
};

/// \param skipped  counts up by the triangles with an index beyond the positions, or a position that is not finite
Welded weld(const Mesh& mesh, std::uint64_t& skipped);

}  // namespace emca::explorer
