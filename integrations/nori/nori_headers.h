#pragma once

// EMCA's headers first: Nori defines macros with common names (Epsilon, INV_PI, another M_PI).
#include "emca/core/color.h"
#include "emca/core/vector.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"

// The person's own Nori.
#include <nori/accel.h>
#include <nori/bbox.h>
#include <nori/block.h>
#include <nori/bsdf.h>
#include <nori/camera.h>
#include <nori/color.h>
#include <nori/emitter.h>
#include <nori/frame.h>
#include <nori/integrator.h>
#include <nori/mesh.h>
#include <nori/ray.h>
#include <nori/rfilter.h>
#include <nori/sampler.h>
#include <nori/scene.h>

namespace emca::nori_adapter {

inline Color toColor(const nori::Color3f& c) { return {c.coeff(0), c.coeff(1), c.coeff(2)}; }
template <typename Vector>
Vec3f toVec3f(const Vector& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace emca::nori_adapter
