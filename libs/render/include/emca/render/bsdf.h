#pragma once

#include <memory>
#include <optional>
#include <string>

#include "emca/core/color.h"
#include "emca/core/event.h"
#include "emca/core/vector.h"
#include "emca/render/interaction.h"

namespace emca::render {

/// Direction that a BSDF chose.
struct BsdfSample {
    Vec3f wi;               ///< local, unit, away from the surface
    Color weight;           ///< f(wo, wi) |cos wi| / pdf; for delta lobes the factor of the lobe over its probability
    float pdf = 0;          ///< per steradian; for delta lobes the discrete probability of having chosen the lobe
    float eta = 1;          ///< relative index of refraction along the new ray: n(side of wo) -> n(side of wi); 1 for reflection
    Event event = Event::none;
    Lobe lobe = Lobe::none;
    bool isDelta() const { return lobe == Lobe::specular || lobe == Lobe::straight; }
};

/// Bidirectional scattering distribution function. Directions are local (z = shading normal), unit, and point away
/// from the surface; `wo` is where the path comes from (the camera side), `wi` where light comes from. Radiance is
/// transported: transmission carries the factor 1/eta^2 where the index of refraction changes (Veach, section 5.2).
/// Immutable after construction; safe from all threads.
class Bsdf {
  public:
    virtual ~Bsdf() = default;

    /// f(wo, wi) |cos wi| without delta lobes.
    virtual Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const = 0;
    /// Density with which sample() chooses wi, per steradian, without delta lobes.
    virtual float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const = 0;
    /// eval and pdf at once, where that is cheaper.
    struct EvalPdf { Color value; float pdf = 0; };
    virtual EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const {
        return {eval(at, wo, wi), pdf(at, wo, wi)};
    }
    /// Chooses wi. \param uLobe in [0, 1): which lobe. \param u in [0, 1)^2: direction within it.
    /// Nothing if the choice ended below the surface or the lobe is black: the path ends there.
    virtual std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const = 0;

    /// True if every lobe is delta, so that light sampling is in vain.
    virtual bool isDelta() const { return false; }
    /// Probability that the surface is there at all (mask); 1 almost always. The caller decides by it first: where the
    /// surface is not, light goes straight on (Event::pass). All other functions describe the surface where it is.
    virtual float opacity(const SurfaceInteraction&) const { return 1.f; }
    /// Rough colour for display, in [0, 1].
    virtual Color displayColor() const { return Color(0.5f); }

    const std::string& name() const { return name_; }  ///< id in the scene file, else the plugin's type
    void setName(std::string name) { name_ = std::move(name); }

  private:
    std::string name_;
};

}  // namespace emca::render
