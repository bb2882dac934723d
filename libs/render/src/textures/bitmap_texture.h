#pragma once

#include <memory>

#include "emca/render/texture.h"
#include "textures/texture_image.h"
#include "textures/uv_map.h"

namespace emca::render {

/// An image over the unit square of texture coordinates: u to the right, v downwards, (0, 0) the corner of the first
/// pixel of the first row. (Loaders of OBJ files turn v round, as that format counts it upwards.)
class BitmapTexture final : public Texture {
  public:
    enum class Filter { nearest, bilinear };
    enum class Wrap { repeat, mirror, clamp, zero, one };

    BitmapTexture(std::shared_ptr<const TextureImage> image, UvMap map, Filter filter, Wrap wrapU, Wrap wrapV);

    Color eval(Vec2f uv) const override;
    Color mean() const override { return image_->mean(); }

  private:
    /// \param x, y  as wrapped(): inside the image, or negative for what is outside of it
    Color texel(int x, int y) const;

    std::shared_ptr<const TextureImage> image_;
    UvMap map_;
    Filter filter_;
    Wrap wrapU_, wrapV_;
};

}  // namespace emca::render
