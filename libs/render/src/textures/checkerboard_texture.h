#pragma once

#include <cmath>

#include "emca/render/texture.h"
#include "textures/uv_map.h"

namespace emca::render {

/// Two by two fields over the unit square: color0 where both coordinates are in the same half of a period.
class CheckerboardTexture final : public Texture {
  public:
    CheckerboardTexture(Color color0, Color color1, UvMap map) : color0_(color0), color1_(color1), map_(map) {}

    Color eval(Vec2f uv) const override {
        uv = map_(uv);
        const bool rightHalf = uv.x - std::floor(uv.x) >= 0.5f;
        const bool lowerHalf = uv.y - std::floor(uv.y) >= 0.5f;
        return rightHalf == lowerHalf ? color0_ : color1_;
    }
    Color mean() const override { return (color0_ + color1_) * 0.5f; }

  private:
    Color color0_, color1_;
    UvMap map_;
};

}  // namespace emca::render
