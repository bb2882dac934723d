#pragma once

#include <memory>

#include "emca/core/color.h"
#include "emca/core/vector.h"

namespace emca::render {

/// A colour that may vary over a surface. Immutable; safe from all threads.
class Texture {
  public:
    virtual ~Texture() = default;
    virtual Color eval(Vec2f uv) const = 0;          ///< linear Rec. 709
    virtual Color mean() const = 0;                  ///< average over [0, 1]^2
    virtual bool isConstant() const { return false; }
    float evalScalar(Vec2f uv) const { return luminance(eval(uv)); }
};

class ConstantTexture final : public Texture {
  public:
    explicit ConstantTexture(Color value) : value_(value) {}
    Color eval(Vec2f) const override { return value_; }
    Color mean() const override { return value_; }
    bool isConstant() const override { return true; }

  private:
    Color value_;
};

}  // namespace emca::render
