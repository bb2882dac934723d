#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "emca/adapter/pixel_renderer.h"
#include "mitsuba_headers.h"
#include "scene_shapes.h"
#include "thread_registration.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// A scene that Mitsuba has loaded, as EMCA's renderer. A pixel is the mean of its own samples, as Mitsuba's film
/// computes it with a box filter. May be called from several threads at once.
class MitsubaRenderer final : public adapter::PixelRenderer {
  public:
    /// Called in one of Mitsuba's threads. Scene and integrator must outlive it.
    MitsubaRenderer(mts::Scene& scene, const TracedIntegrator& integrator);

    RendererInfo info() const override;
    Camera camera() const override;
    std::vector<Mesh> meshes() const override { return shapes_.meshes(); }
    std::vector<LayerDescription> surfaceLayers() const override { return integrator_.layers(); }

    const mts::Scene& scene() const { return scene_; }
    const TracedIntegrator& integrator() const { return integrator_; }
    const ThreadRegistration& threads() const { return threads_; }

    /// A copy of the integrator that computes the light.
    /// \param maximumDepth  longest path in segments, -1: no limit; 0: as the integrator's
    /// Errors: notSupported (it cannot be made from its properties alone).
    Result<mts::ref<mts::SamplingIntegrator>> integratorFor(int maximumDepth) const;
    /// A sampler that is addressed by pixel and sample: that of the scene or, where this is none, "emcasampler".
    /// Errors: invalidArgument (no such sampler, or one that has no seed).
    Result<mts::ref<mts::Sampler>> samplerFor(const RenderSettings& settings) const;
    /// Clones are made one after the other: some samplers change themselves meanwhile.
    mts::ref<mts::Sampler> clone(mts::Sampler& sampler) const;

    /// To Mitsuba's log, from any thread.
    void say(mts::ELogLevel level, const std::string& text) const;

  private:
    Result<adapter::PixelLoop> loopFor(const RenderSettings& settings) const override;
    mts::ref<mts::Sampler> createSampler(const std::string& name, const RenderSettings& settings) const;

    mts::Scene& scene_;
    const TracedIntegrator& integrator_;
    ThreadRegistration threads_;
    SceneShapes shapes_;
    mutable mts::ref<mts::ReconstructionFilter> filter_;  ///< box
    bool filtersAlike_;                                   ///< the film's filter is a box as well
    std::string sampler_;                                 ///< plugin's name of the scene's sampler, or emcasampler
    std::string sceneSampler_;                            ///< plugin's name of the scene's sampler
    mutable std::mutex mutex_;                            ///< making objects of Mitsuba's
};

}  // namespace emca::mitsuba06
