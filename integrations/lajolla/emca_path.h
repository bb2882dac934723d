#pragma once

#include "emca/recorder/recorder.h"
#include "loaded_scene.h"
#include "random.h"
#include "surface_tally.h"

namespace emca::lajolla {

/// Unidirectional path tracing (Kajiya 1986) with next-event estimation, multiple importance sampling (Veach 1997,
/// section 9.2) and Russian roulette, on lajolla's public functions, with EMCA's calls where Algorithm 1 of the EMCA
/// paper has them. Densities per steradian. Surfaces alone: media are passed through as if they were empty.
///
/// What a researcher copies: an integrator that says everything it knows.
class EmcaPath {
  public:
    /// \param scene         must outlive it
    /// \param maximumDepth  longest path in segments; -1: as Russian roulette ends them
    EmcaPath(const LoadedScene& scene, int maximumDepth) : loaded_(scene), scene_(scene.scene()), maximumDepth_(maximumDepth) {}

    /// Radiance that arrives along the ray. Uses random numbers as lajolla's own path tracer does, so that both follow the
    /// same paths up to the roulette.
    /// \param cone   the ray's width, for texture lookups at its hit
    /// \param emca   by value: it is a handle
    /// \param tally  null unless layers are collected
    Spectrum radiance(Ray ray, RayDifferential cone, Random& random, PathRecorder emca, SurfaceTally* tally) const;

  private:
    /// How the path came to where it is, for the MIS weight of light that it meets there.
    struct Arrival {
        Vector3 from;        ///< last vertex that scattered
        Real pdf = 0;        ///< density of the direction
        bool direct = true;  ///< straight from the camera
    };
    /// A light-sampling decision.
    struct LightSample {
        Vector3 direction, position;
        Real distance = 0, pdf = 0;  ///< pdf: 0 where the light cannot be seen from there
        Spectrum radiance;
    };
    Spectrum emittedLight(const PathVertex& at, const Ray& ray, const Arrival& arrival, const Spectrum& throughput, PathRecorder emca,
                          SurfaceTally* tally) const;
    Spectrum environmentLight(const Ray& ray, Real spread, const Arrival& arrival, const Spectrum& throughput, PathRecorder emca,
                              SurfaceTally* tally) const;
    Spectrum sampledLight(const PathVertex& at, const Vector3& wo, const Spectrum& throughput, Random& random, PathRecorder emca,
                          SurfaceTally* tally) const;
    LightSample sampleLight(const PathVertex& at, Random& random, PathRecorder emca, SurfaceTally* tally) const;
    Spectrum addHit(const Spectrum& emission, Real lightPdf, const Arrival& arrival, const Spectrum& throughput, PathRecorder emca,
                    SurfaceTally* tally) const;

    const LoadedScene& loaded_;
    const ::Scene& scene_;
    int maximumDepth_;
};

}  // namespace emca::lajolla
