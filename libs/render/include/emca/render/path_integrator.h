#pragma once

#include "emca/core/color.h"
#include "emca/recorder/recorder.h"
#include "emca/render/integrator_settings.h"
#include "emca/render/ray.h"
#include "emca/render/sampler.h"
#include "emca/render/scene.h"
#include "emca/render/surface_layers.h"

namespace emca::render {

/// Unidirectional path tracing (Kajiya 1986) with next-event estimation, multiple importance sampling and Russian
/// roulette, and EMCA's calls where Algorithm 1 of the paper has them. The one compiled function renders and replays.
class PathIntegrator {
  public:
    /// \param scene  must outlive the integrator
    PathIntegrator(const Scene& scene, const IntegratorSettings& settings) : scene_(scene), settings_(settings) {}

    /// Radiance that arrives along the ray. The sampler's dimensions from kFirstDimension on are used.
    /// \param emca     by value: it is a handle, and a copy stays in a register
    /// \param surface  collects 3D data of this path; null: nobody asked for any. Never changes the radiance.
    Color radiance(Ray ray, Sampler& sampler, emca::PathRecorder emca, SurfaceTally* surface = nullptr) const;

    /// The dimensions before this one belong to the camera.
    static constexpr std::uint32_t kFirstDimension = 2;

  private:
    /// How the path came to where it is, for the MIS weight of light that it meets there.
    struct Arrival {
        Vec3f from;        ///< last vertex that scattered; the camera at first
        float pdf = 0;     ///< BSDF density of the direction, per steradian
        bool direct = true;  ///< straight from the camera
        bool delta = true;   ///< light sampling could not have made this direction
    };
    Color emittedLight(const SurfaceInteraction& at, const Ray& ray, const Arrival& arrival, Color throughput,
                       emca::PathRecorder emca, SurfaceTally* surface) const;
    Color environmentLight(const Ray& ray, const Arrival& arrival, Color throughput, emca::PathRecorder emca,
                           SurfaceTally* surface) const;
    Color sampledLight(const SurfaceInteraction& at, Color throughput, Sampler& sampler, emca::PathRecorder emca,
                       SurfaceTally* surface) const;
    /// MIS weight of light met by BSDF sampling where light sampling has this density.
    float hitWeight(const Arrival& arrival, float lightPdf) const;
    bool violatesStrictNormals(const SurfaceInteraction& at, Vec3f world, Vec3f local) const;

    const Scene& scene_;
    IntegratorSettings settings_;
};

}  // namespace emca::render
