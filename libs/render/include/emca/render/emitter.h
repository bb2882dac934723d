#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emca/core/color.h"
#include "emca/render/interaction.h"
#include "emca/render/shape.h"

namespace emca::render {

/// Light that may arrive at a point: a place on an emitter, chosen at random. Of area lights `position` is just above the
/// surface, of distant light outside the scene; `pdf` is without the choice among lights, 1 for delta lights. What only
/// surfaces have (normal, uv, face, barycentrics) is left alone by other lights.
struct EmitterSample : ShapeSample {
    Color radiance;                        ///< towards the lit point, before occlusion; of delta lights irradiance on a
                                           ///< plane facing them
    const Shape* shape = nullptr;          ///< of area lights: what shines

    EmitterSample() = default;
    EmitterSample(Vec3f at, Vec3f towards, float far, Color arriving, float density) : radiance(arriving) {
        position = at;
        direction = towards;
        distance = far;
        pdf = density;
    }
};

/// Source of light. Immutable once it is part of a scene; safe from all threads.
class Emitter {
  public:
    virtual ~Emitter() = default;

    /// Chooses where light for the point `from` comes from. Nothing if none can reach it.
    virtual std::optional<EmitterSample> sample(Vec3f from, Vec2f u) const = 0;
    /// True if paths cannot meet the light by chance, only sample() finds it.
    virtual bool isDelta() const = 0;
    /// Estimate of the emitted flux, to choose among lights. Scene units squared times radiance.
    virtual float power() const = 0;

    // Area lights.
    /// Radiance leaving the surface point towards `direction` (unit, world).
    virtual Color emitted(const SurfaceInteraction&, Vec3f /*direction*/) const { return Color(0.f); }
    /// Density with which sample() chooses the point met by the ray from `from` along `direction`, per steradian.
    virtual float pdf(Vec3f /*from*/, Vec3f /*direction*/, float /*distance*/, const SurfaceInteraction&) const {
        return 0.f;
    }

    // Environments.
    virtual bool isEnvironment() const { return false; }
    /// Radiance arriving from `direction` (unit, world, away from the scene).
    virtual Color environment(Vec3f /*direction*/) const { return Color(0.f); }
    virtual float environmentPdf(Vec3f /*direction*/) const { return 0.f; }

    /// Told once, before rendering, what surrounds all shapes.
    virtual void setSceneBounds(Vec3f /*center*/, float /*radius*/) {}
    /// Rough radiance for display.
    virtual Color displayRadiance() const { return Color(0.f); }

    std::string name;          ///< id in the scene file, of the lit shape, or else the plugin's type
    float samplingWeight = 1;  ///< how much more often to choose this light
    std::uint32_t index = 0;   ///< place in Scene::emitters()
};

}  // namespace emca::render
