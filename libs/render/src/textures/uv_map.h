#pragma once

#include "emca/core/vector.h"
#include "emca/render/property_reader.h"

namespace emca::render {

/// Affine map from a surface's texture coordinates to a texture's own.
class UvMap {
  public:
    UvMap() = default;
    /// u' = uu u + uv v + u0, v' = vu u + vv v + v0
    UvMap(float uu, float uv, float u0, float vu, float vv, float v0)
        : uu_(uu), uv_(uv), u0_(u0), vu_(vu), vv_(vv), v0_(v0) {}
    Vec2f operator()(Vec2f t) const { return {uu_ * t.x + uv_ * t.y + u0_, vu_ * t.x + vv_ * t.y + v0_}; }

  private:
    float uu_ = 1, uv_ = 0, u0_ = 0, vu_ = 0, vv_ = 1, v0_ = 0;
};

/// uscale, vscale (or uvscale for both), uoffset, voffset; and to_uv, a transform of the points (u, v, 0), which is
/// applied first. Scene files for Mitsuba 0.4 to 0.6 carry to_uv too, but it never did anything there, nor does it
/// here.
UvMap readUvMap(PropertyReader& read);

}  // namespace emca::render
