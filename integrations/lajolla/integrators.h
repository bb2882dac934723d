#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/result.h"
#include "emca/core/seed_map.h"
#include "emca/recorder/surface_recorder.h"
#include "emca_path.h"
#include "loaded_scene.h"
#include "observer.h"
#include "random.h"

namespace emca::lajolla {

/// The form of all integrators in lajolla.
using CourseIntegrator = Spectrum (*)(const ::Scene& scene, int x, int y, pcg32_state& random);

/// What a name stands for: `emcapath`, or one of the person's integrators.
struct Integrator {
    std::string name;
    CourseIntegrator course = nullptr;  ///< null: emcapath
    bool volumetric = false;
};

/// All that the person's lajolla has, by name: emcapath, path, volpath (the version that the scene asks for), volpath1 to
/// volpath6.
std::vector<std::string> integratorNames();
/// \param name  empty: what the scene asks for
/// Errors: invalidArgument (no such integrator; the message has their names).
Result<Integrator> findIntegrator(const std::string& name, const ::Scene& scene);

/// One thread's way of tracing paths: random numbers, observer and tally. Everything about a sample follows from the pixel,
/// its index and the seed.
class PathTracer {
  public:
    /// \param surface  null unless layers are collected
    PathTracer(const LoadedScene& scene, const Integrator& integrator, std::uint64_t seed, SurfaceRecorder* surface);

    /// One camera path.
    Spectrum sample(Pixel pixel, std::uint32_t index);
    /// Radiance along any ray. \param maximumDepth  0: the integrator's own; the course's integrators know no other
    Spectrum radiance(const Ray& ray, Pixel pixel, std::uint32_t index, int maximumDepth);

  private:
    Spectrum emcaSample(Pixel pixel, PathRecorder emca);
    Spectrum courseSample(Pixel pixel, PathRecorder emca);

    const LoadedScene& scene_;
    Integrator integrator_;
    SeedMap seeds_;
    Random random_;
    Observer observer_;
    std::optional<SurfaceTally> tally_;
};

}  // namespace emca::lajolla
