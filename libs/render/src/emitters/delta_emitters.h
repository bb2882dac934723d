#pragma once

#include "emca/render/emitter.h"
#include "emca/render/transform.h"

namespace emca::render {

/// A point that shines in all directions.
class PointEmitter final : public Emitter {
  public:
    PointEmitter(Vec3f position, Color intensity) : position_(position), intensity_(intensity) {}  ///< W/sr
    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return true; }
    float power() const override;

  private:
    Vec3f position_;
    Color intensity_;
};

/// A point that shines into a cone: full intensity up to the beam's width, falling linearly with the angle to zero at
/// the cutoff, as Mitsuba's.
class SpotEmitter final : public Emitter {
  public:
    /// \param toWorld  the spot is at the origin and shines along +z
    /// Angles: half angles in degrees; beamWidth <= cutoffAngle.
    SpotEmitter(const Transform& toWorld, Color intensity, float cutoffAngle, float beamWidth);
    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return true; }
    float power() const override;

  private:
    float falloff(float cosine) const;

    Vec3f position_, axis_;
    Color intensity_;
    float cutoff_, beam_;          ///< radians
    float cosCutoff_, cosBeam_;
};

/// Parallel light from infinitely far away.
class DirectionalEmitter final : public Emitter {
  public:
    /// \param direction   in which the light travels, unit
    /// \param irradiance  on a plane facing it, W/m^2
    DirectionalEmitter(Vec3f direction, Color irradiance) : direction_(direction), irradiance_(irradiance) {}
    std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const override;
    bool isDelta() const override { return true; }
    float power() const override;
    void setSceneBounds(Vec3f, float radius) override { sceneRadius_ = radius; }

  private:
    Vec3f direction_;
    Color irradiance_;
    float sceneRadius_ = 1;
};

}  // namespace emca::render
