#pragma once

#include "path_context.h"

namespace emca::pbrt4 {

/// Records the paths of pbrt's own integrators from outside, as far as their rays tell: each ray to the first hit is a
/// segment of the path; a question whether something is in between is a shadow test of the last vertex; the BSDF that
/// pbrt makes at a hit, together with the next ray's direction, tells what kind of scattering it was, and its density.
/// Belongs to one thread.
class PathObserver final : public RayWatcher {
  public:
    /// \param tally  null: no layers; must outlive this
    PathObserver(const SceneView& view, emca::PathRecorder recorder, emca::PathTally* tally)
        : view_(view), recorder_(recorder), tally_(tally) {}

    /// \param lambda  those of the path, which may change on its way
    void begin(const pbrt::SampledWavelengths& lambda);
    void end();

    void traced(const pbrt::Ray& ray, pbrt::Float tMax, const pbrt::SurfaceInteraction* hit,
                const HitChain& chain) override;
    void tested(const pbrt::Ray& ray, pbrt::Float tMax, bool blocked) override;
    void scattersBy(const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf) override;

  private:
    /// A hit that is not yet known to be where the path scattered: in a medium it may have done so before.
    struct Arrival {
        pbrt::Ray ray;
        pbrt::SurfaceInteraction at;
        HitChain chain;
        bool pending = false;
    };
    void departure(const pbrt::Ray& ray);
    void flush(const pbrt::Ray* next);
    void recordSurface();
    void recordDirection(pbrt::Vector3f wi);

    const SceneView& view_;
    emca::PathRecorder recorder_;
    emca::PathTally* tally_;
    const pbrt::SampledWavelengths* lambda_ = nullptr;
    Arrival arrival_;
    int vertex_ = 0;
    bool hasBsdf_ = false, scattered_ = false, left_ = false;
    pbrt::BSDF bsdf_;
};

}  // namespace emca::pbrt4
