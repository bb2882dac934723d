#include "emitters/environment_emitters.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

std::optional<EmitterSample> ConstantEmitter::sample(Vec3f from, Vec2f u) const {
    const Vec3f direction = squareToUniformSphere(u);
    const float far = 2.f * sceneRadius_;
    return EmitterSample{from + direction * far, direction, far, radiance_, squareToUniformSpherePdf()};
}

float ConstantEmitter::power() const { return 4.f * square(kPi * sceneRadius_) * luminance(radiance_); }

float ConstantEmitter::environmentPdf(Vec3f) const { return squareToUniformSpherePdf(); }

EnvironmentMap::EnvironmentMap(const Image& image, const Transform& toWorld, float scale)
    : width_(image.width()),
      height_(image.height()),
      toWorld_(toWorld),
      toLocal_(toWorld.inverse().value_or(Transform())) {
    texels_.reserve(std::size_t(width_) * height_);
    for (std::uint32_t y = 0; y < height_; ++y) {
        for (std::uint32_t x = 0; x < width_; ++x) {
            const Color c = image.color({x, y}) * scale;
            const bool usable = isFinite(c) && c.r >= 0.f && c.g >= 0.f && c.b >= 0.f;
            texels_.push_back(usable ? c : Color(0.f));
        }
    }

    // The weight of a texel is the mean of the interpolated image over it (weights 1 6 1 / 8 per axis), so that no
    // direction that has light is impossible.
    std::vector<float> weights(texels_.size());
    double red = 0, green = 0, blue = 0, sines = 0;
    for (std::uint32_t y = 0; y < height_; ++y) {
        const float sine = std::sin(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height_));
        for (std::uint32_t x = 0; x < width_; ++x) {
            Color mean(0.f);
            constexpr float kWeights[3] = {0.125f, 0.75f, 0.125f};
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    mean += texel(std::int64_t(x) + dx, std::int64_t(y) + dy) * (kWeights[dx + 1] * kWeights[dy + 1]);
                }
            }
            weights[std::size_t(y) * width_ + x] = luminance(mean) * sine;
            red += double(mean.r * sine), green += double(mean.g * sine), blue += double(mean.b * sine);
            sines += double(sine);
        }
    }
    mean_ = {static_cast<float>(red / sines), static_cast<float>(green / sines), static_cast<float>(blue / sines)};
    distribution_ = Distribution2D(weights, width_, height_);
}

Color EnvironmentMap::texel(std::int64_t x, std::int64_t y) const {
    const std::int64_t width = width_, height = height_;
    x = (x + width) % width;
    y = std::clamp<std::int64_t>(y, 0, height - 1);
    return texels_[static_cast<std::size_t>(y * width + x)];
}

Color EnvironmentMap::lookup(Vec2f uv) const {
    const float x = uv.x * static_cast<float>(width_) - 0.5f, y = uv.y * static_cast<float>(height_) - 0.5f;
    const float floorX = std::floor(x), floorY = std::floor(y);
    const float fx = x - floorX, fy = y - floorY;
    const auto ix = static_cast<std::int64_t>(floorX), iy = static_cast<std::int64_t>(floorY);
    return (texel(ix, iy) * (1.f - fx) + texel(ix + 1, iy) * fx) * (1.f - fy) +
           (texel(ix, iy + 1) * (1.f - fx) + texel(ix + 1, iy + 1) * fx) * fy;
}

Vec2f EnvironmentMap::uvOf(Vec3f local) const {
    const float phi = std::atan2(local.x, -local.z) * (0.5f * kInvPi);
    return {std::min(phi < 0.f ? phi + 1.f : phi, kOneMinusEpsilon),
            std::atan2(std::hypot(local.x, local.z), local.y) * kInvPi};  // acos is blind near the poles
}

Color EnvironmentMap::environment(Vec3f direction) const { return lookup(uvOf(normalize(toLocal_.vector(direction)))); }

std::optional<EmitterSample> EnvironmentMap::sample(Vec3f from, Vec2f u) const {
    const auto chosen = distribution_.sample(u);
    const float theta = kPi * chosen.point.y, phi = 2.f * kPi * chosen.point.x;
    const float sine = std::sin(theta);
    if (!(sine > 0.f) || !(chosen.pdf > 0.f)) return std::nullopt;
    const Vec3f local{std::sin(phi) * sine, std::cos(theta), -std::cos(phi) * sine};
    const Vec3f direction = normalize(toWorld_.vector(local));
    const float far = 2.f * sceneRadius_;
    return EmitterSample{from + direction * far, direction, far, lookup(chosen.point),
                         chosen.pdf / (2.f * kPi * kPi * sine)};
}

float EnvironmentMap::environmentPdf(Vec3f direction) const {
    const Vec3f local = normalize(toLocal_.vector(direction));
    const float sine = std::hypot(local.x, local.z);
    return sine > 0.f ? distribution_.pdf(uvOf(local)) / (2.f * kPi * kPi * sine) : 0.f;
}

float EnvironmentMap::power() const { return 4.f * square(kPi * sceneRadius_) * luminance(mean_); }

}  // namespace emca::render
