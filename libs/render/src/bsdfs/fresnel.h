#pragma once

#include "emca/core/color.h"
#include "emca/core/vector.h"

namespace emca::render {

/// What happens to light at a smooth boundary between two dielectrics.
struct DielectricFresnel {
    float reflectance = 1;     ///< unpolarised, in [0, 1]; 1 under total internal reflection
    float cosTransmitted = 0;  ///< of the refracted direction: opposite sign to the incident cosine; 0 if there is none
};

/// \param cosIncident  signed cosine between the normal and the direction, both pointing away from the surface;
///                     negative: the light is on the inner side
/// \param eta          n(inner side, against the normal) / n(outer side)
/// Source: Born and Wolf, "Principles of Optics", 7th edition, section 1.5.2.
DielectricFresnel fresnelDielectric(float cosIncident, float eta);

/// Unpolarised reflectance of a conductor with index eta + i k relative to the medium outside, per channel.
/// \param cosIncident  in [0, 1]
/// Source: Born and Wolf, section 14.2; the closed form is that of Lazányi and Szirmay-Kalos, WSCG 2005, section 2.
Color fresnelConductor(float cosIncident, Color eta, Color k);

/// Average reflectance of a smooth dielectric boundary under uniform diffuse light, 2 int_0^1 F(cos) cos dcos.
/// \param eta  n(far side) / n(side of the light); below 1 for light inside that meets the boundary from within
float fresnelDiffuseReflectance(float eta);

/// Direction of v mirrored at the normal m; all point away from the surface.
inline Vec3f reflectAbout(Vec3f v, Vec3f m) { return m * (2.f * dot(v, m)) - v; }
/// Mirrored at the shading normal.
inline Vec3f reflectLocal(Vec3f v) { return {-v.x, -v.y, v.z}; }

/// Refracted direction of v about the normal m (m has positive z: points to the outer side).
/// \param cosTransmitted  as fresnelDielectric(dot(v, m), eta) returns it, not 0
inline Vec3f refractAbout(Vec3f v, Vec3f m, float cosTransmitted, float eta) {
    const float scale = cosTransmitted < 0.f ? 1.f / eta : eta;
    return normalize(m * (dot(v, m) * scale + cosTransmitted) - v * scale);
}
/// Refracted direction at the shading normal.
inline Vec3f refractLocal(Vec3f v, float cosTransmitted, float eta) {
    const float scale = cosTransmitted < 0.f ? 1.f / eta : eta;
    return normalize(Vec3f{-scale * v.x, -scale * v.y, cosTransmitted});
}

}  // namespace emca::render
