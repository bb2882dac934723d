#include "textures/bitmap_texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace emca::render {

namespace {

using Wrap = BitmapTexture::Wrap;

/// Largest integer not above t; std::floor is a call where the processor's baseline has no instruction for it.
int floorToInt(float t) {
    const int truncated = static_cast<int>(t);
    return truncated - static_cast<int>(t < static_cast<float>(truncated));
}

/// The same as a float, for any finite t: floats beyond 2^24 are integers.
float floorOf(float t) { return std::abs(t) < 0x1p24f ? static_cast<float>(floorToInt(t)) : t; }

/// Brings a coordinate near the unit interval without a change of meaning, so that it fits an int once it is in pixels.
float reduced(float t, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return t - floorOf(t);
        case Wrap::mirror:
            return t - 2.f * floorOf(0.5f * t);
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

inline Color BitmapTexture::texel(int x, int y) const {
    if ((x | y) < 0) return Color(std::min(x, y) == -2 ? 1.f : 0.f);
    return image_->texel(x, y);
}

Color BitmapTexture::eval(Vec2f uv) const {
    uv = map_(uv);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return {};
    const float x = reduced(uv.x, wrapU_) * static_cast<float>(image_->width());
    const float y = reduced(uv.y, wrapV_) * static_cast<float>(image_->height());
    const auto column = [&](int i) { return wrapped(i, image_->width(), wrapU_); };
    const auto row = [&](int i) { return wrapped(i, image_->height(), wrapV_); };
    if (filter_ == Filter::nearest) return texel(column(floorToInt(x)), row(floorToInt(y)));

    const int left = floorToInt(x - 0.5f), top = floorToInt(y - 0.5f);
    const float a = x - 0.5f - static_cast<float>(left), b = y - 0.5f - static_cast<float>(top);
    const int x0 = column(left), x1 = column(left + 1), y0 = row(top), y1 = row(top + 1);
    return (texel(x0, y0) * (1.f - a) + texel(x1, y0) * a) * (1.f - b) +
           (texel(x0, y1) * (1.f - a) + texel(x1, y1) * a) * b;
}

}  // namespace emca::render
