#pragma once

#include "emca/core/color.h"
#include "emca/core/vector.h"

// The person's own lajolla, in the order in which its headers expect each other. They live in the global namespace.
#include "lajolla.h"

#include "camera.h"
#include "intersection.h"
#include "light.h"
#include "material.h"
#include "medium.h"
#include "phase_function.h"
#include "point_and_normal.h"
#include "ray.h"
#include "scene.h"
#include "shape.h"
#include "spectrum.h"
#include "table_dist.h"
#include "transform.h"
#include "vector.h"

// A macro of theirs (flexception.h) would stand in the way of emca::Error.
#undef Error

struct pcg32_state;

namespace emca::lajolla {

/// Spectra are linear Rec. 709 there.
inline Color toColor(const Spectrum& s) { return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z)}; }
inline Vec3f toVec3f(const Vector3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
inline Vector3 toVector3(Vec3f v) { return {Real(v.x), Real(v.y), Real(v.z)}; }

}  // namespace emca::lajolla
