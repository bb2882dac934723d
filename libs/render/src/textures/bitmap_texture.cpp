#include "textures/bitmap_texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace emca::render {

namespace {

using Wrap = BitmapTexture::Wrap;

/// Brings a coordinate near the unit interval without a change of meaning, so that it fits an int once it is in pixels.
float reduced(float t, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return t - std::floor(t);
        case Wrap::mirror:
            return t - 2.f * std::floor(0.5f * t);
        default:
            return std::clamp(t, -1.f, 2.f);
    }
}

/// Pixel index in [0, size), or -1 for "zero" and -2 for "one".
int wrapped(int i, int size, Wrap wrap) {
    if (i >= 0 && i < size) return i;
    switch (wrap) {
        case Wrap::repeat:
            i %= size;
            return i < 0 ? i + size : i;
        case Wrap::mirror:
            i %= 2 * size;
            if (i < 0) i += 2 * size;
            return i < size ? i : 2 * size - 1 - i;
        case Wrap::clamp:
            return std::clamp(i, 0, size - 1);
        case Wrap::zero:
            return -1;
        case Wrap::one:
            return -2;
    }
    return 0;
}

}  // namespace

BitmapTexture::BitmapTexture(std::shared_ptr<const TextureImage> image, UvMap map, Filter filter, Wrap wrapU,
                             Wrap wrapV)
    : image_(std::move(image)), map_(map), filter_(filter), wrapU_(wrapU), wrapV_(wrapV) {}

Color BitmapTexture::texel(int x, int y) const {
    x = wrapped(x, image_->width(), wrapU_);
    y = wrapped(y, image_->height(), wrapV_);
    if (x < 0 || y < 0) return Color(std::min(x, y) == -2 ? 1.f : 0.f);
    return image_->texel(x, y);
}

Color BitmapTexture::eval(Vec2f uv) const {
    uv = map_(uv);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return {};
    const float x = reduced(uv.x, wrapU_) * static_cast<float>(image_->width());
    const float y = reduced(uv.y, wrapV_) * static_cast<float>(image_->height());
    if (filter_ == Filter::nearest) return texel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));

    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
    const float a = x - 0.5f - left, b = y - 0.5f - top;
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    return (texel(x0, y0) * (1.f - a) + texel(x0 + 1, y0) * a) * (1.f - b) +
           (texel(x0, y0 + 1) * (1.f - a) + texel(x0 + 1, y0 + 1) * a) * b;
}

}  // namespace emca::render
