#pragma once

// EMCA's headers stand before Mitsuba's, which define macros of short names (Log, Assert, Epsilon). Of Mitsuba's,
// scene.h comes first: the others count on what it includes.
#include "emca/core/color.h"
#include "emca/core/vector.h"
#include "emca/recorder/recordable.h"

#include <mitsuba/render/scene.h>

#include <mitsuba/core/plugin.h>

namespace emca::mitsuba06 {

namespace mts = mitsuba;

inline Color toColor(const mts::Spectrum& spectrum) {
    mts::Float r = 0, g = 0, b = 0;
    spectrum.toLinearRGB(r, g, b);
    return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)};
}

/// Points, vectors and normals.
template <typename T>
Vec3f toVec3f(const T& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace emca::mitsuba06

/// Spectra are recorded as linear Rec. 709.
template <>
struct emca::Recordable<mitsuba::Spectrum> {
    static Color convert(const mitsuba::Spectrum& spectrum) { return emca::mitsuba06::toColor(spectrum); }
};
