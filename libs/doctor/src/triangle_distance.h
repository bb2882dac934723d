#pragma once

#include "emca/core/vector.h"

namespace emca::doctor {

/// The point of a triangle that is nearest to `p`, and on what part of it that lies.
struct NearestPoint {
    Vec3d point;
    int edge = -1;  ///< 0: on the edge from a to b, 1: b to c, 2: c to a; -1: inside
};

NearestPoint nearestPoint(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

}  // namespace emca::doctor
