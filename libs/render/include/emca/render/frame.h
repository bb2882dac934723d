#pragma once

#include <cmath>

#include "emca/core/vector.h"

namespace emca::render {

/// Orthonormal basis around a normal; local z is the normal. All directions of BSDFs are in such a frame.
struct Frame {
    Vec3f s, t, n;

    /// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
    static Frame fromNormal(Vec3f normal) {
        const float sign = std::copysign(1.f, normal.z);
        const float a = -1.f / (sign + normal.z);
        const float b = normal.x * normal.y * a;
        return {{1.f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
                {b, sign + normal.y * normal.y * a, -normal.y},
                normal};
    }
    Vec3f toLocal(Vec3f world) const { return {dot(world, s), dot(world, t), dot(world, n)}; }
    Vec3f toWorld(Vec3f local) const { return s * local.x + t * local.y + n * local.z; }
};

}  // namespace emca::render
