#pragma once

#include <vector>

#include "emca/core/image.h"
#include "emca/render/distribution.h"
#include "emca/render/emitter.h"
#include "emca/render/transform.h"

namespace emca::render {

/// The same radiance from everywhere.
class ConstantEmitter final : public Emitter {
  public:
    explicit ConstantEmitter(Color radiance) : radiance_(radiance) {}

    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return false; }
    float power() const override;
    bool isEnvironment() const override { return true; }
    Color environment(Vec3f) const override { return radiance_; }
    float environmentPdf(Vec3f direction) const override;
    void setSceneBounds(Vec3f, float radius) override { sceneRadius_ = radius; }
    Color displayRadiance() const override { return radiance_; }

  private:
    Color radiance_;
    float sceneRadius_ = 1;
};

/// Radiance from an image in latitude-longitude mapping, interpolated bilinearly. The centre of the image lies in
/// direction +z of the emitter's space, its top is +y, as in Mitsuba.
/// Chosen in proportion to the luminance times the sine of the polar angle
/// (Pharr and Humphreys, "Physically Based Rendering", section 14.2.4).
class EnvironmentMap final : public Emitter {
  public:
    /// \param image    linear Rec. 709, at least one pixel; values that are not finite or negative count as 0
    /// \param toWorld  its rotation turns the map
    EnvironmentMap(const Image& image, const Transform& toWorld, float scale);

    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return false; }
    float power() const override;
    bool isEnvironment() const override { return true; }
    Color environment(Vec3f direction) const override;
    float environmentPdf(Vec3f direction) const override;
    void setSceneBounds(Vec3f, float radius) override { sceneRadius_ = radius; }
    Color displayRadiance() const override { return mean_; }

  private:
    Color texel(std::int64_t x, std::int64_t y) const;
    Color lookup(Vec2f uv) const;
    Vec2f uvOf(Vec3f local) const;

    std::uint32_t width_, height_;
    std::vector<Color> texels_;
    Transform toWorld_, toLocal_;
    Distribution2D distribution_;
    Color mean_;
    float sceneRadius_ = 1;
};

}  // namespace emca::render
