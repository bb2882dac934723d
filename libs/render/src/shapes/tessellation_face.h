#pragma once

#include <cstdint>

#include "emca/core/vector.h"

namespace emca::render {

/// Triangle of makeSphere() that a ray from the centre along `local` goes through. Object space.
std::int32_t sphereFace(Vec3f local);

/// Triangle of makeDisk() at an angle of `turn` times 2 pi.
std::int32_t diskFace(float turn);

}  // namespace emca::render
