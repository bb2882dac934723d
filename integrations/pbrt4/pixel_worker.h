#pragma once

#include <memory>
#include <optional>

#include "emca/adapter/light_probe_tool.h"
#include "emca/adapter/pixel_loop.h"
#include "loaded_scene.h"
#include "observer.h"

namespace emca::pbrt4 {

/// A film of pbrt's own kind for some pixels of the scene's film: the scene's is one for all, and requests come side by
/// side. Different pixels may be used by different threads at once.
class OwnFilm {
  public:
    /// \param bounds  pixels as pbrt counts them
    OwnFilm(pbrt::Film scenes, pbrt::Bounds2i bounds);
    pbrt::RGBFilm& film() { return film_; }

  private:
    pbrt::RGBFilm film_;
};

/// What one request renders with.
struct PixelRequest {
    const LoadedScene& scene;
    const pbrt::RayIntegrator& integrator;
    std::shared_ptr<const SamplerPrototype> sampler;
    std::uint32_t samplesPerPixel = 1;
    const PathLayers* layers = nullptr;  ///< null: none
};

/// pbrt's pixel samples, in one thread, as its RayIntegrator takes them.
class PbrtPixelWorker final : public adapter::PixelWorker {
  public:
    /// \param film  of all pixels that the request renders; shared by its threads
    PbrtPixelWorker(const PixelRequest& request, std::shared_ptr<OwnFilm> film, SurfaceRecorder* surface);

    void beginPixel(Pixel pixel) override;
    Color sample(Pixel pixel, std::uint32_t index) override;
    Color value(Pixel pixel, const PixelSums& sums) override;

  private:
    pbrt::Point2i filmPixel(Pixel pixel) const;
    /// Radiance along the camera's ray, 0 where there is no ray or it is not finite.
    pbrt::SampledSpectrum radiance(const pbrt::CameraSample& camera, pbrt::SampledWavelengths& lambda);
    pbrt::SampledSpectrum traced(const pbrt::CameraRayDifferential& ray, pbrt::SampledWavelengths& lambda);
    Color contributed(const pbrt::SampledSpectrum& radiance, const pbrt::SampledWavelengths& lambda);

    PixelRequest request_;
    const EmcaPathIntegrator* own_;  ///< null: one of pbrt's
    std::shared_ptr<OwnFilm> film_;
    OwnFilm single_;  ///< for the colour of one sample
    pstd::pmr::monotonic_buffer_resource memory_;
    pbrt::Sampler sampler_;
    pbrt::ScratchBuffer scratch_;
    std::optional<SpectrumTally> tally_;            ///< of our integrator
    std::optional<emca::PathTally> observedTally_;  ///< of pbrt's
    double weightScale_ = 1;                        ///< number of samples over the sum of their filter weights
};

/// Radiance at any place, for the light probe.
class PbrtProbeWorker final : public adapter::ProbeWorker {
  public:
    /// \param maximumDepth  scattering events; less than 0: the integrator's
    PbrtProbeWorker(const LoadedScene& scene, const pbrt::RayIntegrator& integrator, int maximumDepth,
                    std::uint64_t seed);
    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override;

  private:
    const LoadedScene& scene_;
    const pbrt::RayIntegrator* integrator_;
    std::unique_ptr<pbrt::RayIntegrator> deeper_;  ///< with another depth
    const EmcaPathIntegrator* own_;
    int maximumDepth_;
    pbrt::IndependentSampler sampler_;
    pbrt::ScratchBuffer scratch_;
};

}  // namespace emca::pbrt4
