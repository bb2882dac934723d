#pragma once

#include <string>
#include <vector>

#include "emca/core/surface_field.h"
#include "emca/recorder/path_layers.h"
#include "mitsuba_headers.h"
#include "scene_shapes.h"

namespace emca::mitsuba06 {

/// What surrounds one path. A plain value, valid during the call that it is given to.
struct PathContext {
    const SceneShapes* shapes = nullptr;        ///< null where nobody wants to know surfaces
    mts::Spectrum cameraWeight{mts::Float(1)};  ///< what the sensor multiplies the radiance with: for what is recorded
    PathTally* tally = nullptr;                 ///< null unless surface layers are collected
};

/// An integrator whose paths EMCA can follow. trace() gives the bits of Li(), whoever listens.
class TracedIntegrator {
  public:
    virtual ~TracedIntegrator() = default;

    /// Radiance along a ray, as SamplingIntegrator::Li. If the thread is inside a RecordScope whose path has begun, the
    /// vertices are recorded. For several threads at once.
    virtual mts::Spectrum trace(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query,
                                const PathContext& context) const = 0;

    /// The surface layers that trace() can add to.
    virtual std::vector<LayerDescription> layers() const = 0;
    /// Name for people, for example "path, observed".
    virtual std::string label() const = 0;
    /// Same settings and samples give the same bits, from any thread.
    virtual bool isDeterministic() const = 0;
    /// The integrator that computes the light.
    virtual mts::SamplingIntegrator& computing() const = 0;
};

}  // namespace emca::mitsuba06
