#pragma once

#include "path_context.h"

namespace emca::pbrt4 {

/// A path tracer for pbrt that says what it does: next-event estimation and BSDF sampling combined by multiple
/// importance sampling (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", sections 8.3 and 9.2),
/// Russian roulette by throughput. It takes the decisions of pbrt's "path" with the same numbers of the sampler, and so
/// gives its image; surfaces only, as that one.
class EmcaPathIntegrator final : public pbrt::RayIntegrator {
  public:
    struct Settings {
        int maximumDepth = 5;  ///< scattering events of a path; its parameters are pbrt's
        std::string lightSampler = "bvh";
        bool regularize = false;  ///< pbrt's: make BSDFs rougher behind a rough one
    };
    EmcaPathIntegrator(const Settings& settings, pbrt::Camera camera, pbrt::Sampler sampler, pbrt::Primitive scene,
                       std::vector<pbrt::Light> lights, const SceneView& view);

    pbrt::SampledSpectrum Li(pbrt::RayDifferential ray, pbrt::SampledWavelengths& lambda, pbrt::Sampler sampler,
                             pbrt::ScratchBuffer& scratch, pbrt::VisibleSurface* visible) const override;

    /// The radiance that arrives along a ray, while the context is told. The same bits whatever the context.
    /// \param maximumDepth  instead of the setting
    pbrt::SampledSpectrum radiance(const pbrt::RayDifferential& ray, pbrt::SampledWavelengths& lambda,
                                   pbrt::Sampler sampler, pbrt::ScratchBuffer& scratch, PathContext& context,
                                   int maximumDepth) const;

    const Settings& settings() const { return settings_; }
    std::string ToString() const override { return "[ EmcaPathIntegrator ]"; }

  private:
    struct Walk;
    void environmentLight(Walk& walk, PathContext& context) const;
    void emittedLight(Walk& walk, const pbrt::SurfaceInteraction& at, PathContext& context) const;
    void sampledLight(Walk& walk, const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf,
                      PathContext& context) const;
    /// False if the path ends. Else walk.ray is the next one.
    bool scatter(Walk& walk, const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf, int depth,
                 PathContext& context) const;
    void arrive(const Walk& walk, const pbrt::SurfaceInteraction& at, int vertex, PathContext& context) const;

    Settings settings_;
    pbrt::LightSampler lightSampler_;
    const SceneView& view_;
};

}  // namespace emca::pbrt4
