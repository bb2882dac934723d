#pragma once

#include <optional>
#include <string_view>

#include "emca/core/vector.h"

namespace emca::render {

/// Normals of a rough surface: their density, Smith's shadowing and masking, and sampling of those that are visible.
/// Local space, normals m and directions v have positive z unless said otherwise. Cheap to make: two numbers.
/// Sources: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007;
/// Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014.
class Microfacets {
  public:
    enum class Type { beckmann, ggx };

    /// \param alphaU, alphaV  roughness along the two tangents: root mean square slope times sqrt(2) for Beckmann.
    ///                        Kept at or above 1e-4, where float still resolves the lobe.
    Microfacets(Type type, float alphaU, float alphaV);

    /// D(m), per steradian: integrates to 1 over the projected hemisphere (Heitz 2014, equation 11).
    float density(Vec3f m) const;
    /// Smith's G1: share of the normals m that v sees. 0 if v is on the other side of the microfacet than of the
    /// surface. v may be on either side.
    float maskingG1(Vec3f v, Vec3f m) const;
    /// Normal with density visiblePdf(v, m).
    Vec3f sampleVisible(Vec3f v, Vec2f u) const;
    /// G1(v) D(m) (v.m) / cos v, per steradian (Heitz 2014, equation 16).
    float visiblePdf(Vec3f v, Vec3f m) const;

  private:
    Vec2f sampleBeckmannSlope(float cosTheta, Vec2f u) const;

    Type type_;
    float alphaU_, alphaV_;
};

/// "beckmann" or "ggx"; nothing for other words.
std::optional<Microfacets::Type> microfacetType(std::string_view name);

}  // namespace emca::render
