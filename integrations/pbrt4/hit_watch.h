#pragma once

#include "pbrt_headers.h"

namespace emca::pbrt4 {

/// Which primitive a ray hit, and what placed it: pbrt's interactions do not say.
struct HitChain {
    pbrt::Primitive leaf;          ///< the primitive with the shape; null: nothing was hit
    pbrt::Primitive instances[2];  ///< those that place it, the outer one first; null: none
};

/// Is told of what an integrator does, in its thread, while it does it.
class RayWatcher {
  public:
    virtual ~RayWatcher() = default;
    /// A ray was traced to its first hit. Render space. \param hit  null if there was none before tMax
    virtual void traced(const pbrt::Ray& ray, pbrt::Float tMax, const pbrt::SurfaceInteraction* hit,
                        const HitChain& chain) = 0;
    /// It was asked whether anything is in between.
    virtual void tested(const pbrt::Ray& ray, pbrt::Float tMax, bool blocked) = 0;
    /// The BSDF at the last hit was made; unset where the surface has no material.
    virtual void scattersBy(const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf) = 0;
};

/// While one lives, its thread's rays are followed. pbrt's object files call each other by symbols, and the linker's
/// --wrap puts functions of ours in between, with pbrt itself unchanged; without a HitWatch in the thread they cost one
/// branch. Does not nest.
class HitWatch {
  public:
    /// \param watcher  null: only what lastHit() says is wanted. Must outlive this.
    HitWatch(pbrt::Primitive scene, RayWatcher* watcher);
    ~HitWatch();
    HitWatch(const HitWatch&) = delete;
    HitWatch& operator=(const HitWatch&) = delete;

    /// Of the last ray of this thread that was traced to its first hit.
    const HitChain& lastHit() const { return hit_; }

    /// Whether the linker's wrapping works with this pbrt: a library whose object files were merged by link-time
    /// optimisation does not call by symbols. \param ray  one that hits the scene
    static bool works(pbrt::Primitive scene, const pbrt::Ray& ray);

  private:
    friend struct WrappedCalls;
    pbrt::Primitive scene_;
    RayWatcher* watcher_;
    HitChain hit_;
};

}  // namespace emca::pbrt4
