#pragma once

#include <vector>

#include "emca/core/surface_field.h"
#include "emca/recorder/surface_recorder.h"
#include "loaded_scene.h"

namespace emca::lajolla {

/// The 3D data that can be collected while an image renders (Ruppert et al., "EMCA", VMV 2021, section 4.1 and Figures 2,
/// 9, 10 and 11). The last five need an integrator that says them: `emcapath`.
const std::vector<LayerDescription>& surfaceLayers();

/// What one thread's paths add to the layers that were asked for. Belongs to one thread and one render; changes nothing
/// about the path.
class SurfaceTally {
  public:
    /// Both must outlive it. Called in the thread that renders.
    SurfaceTally(const LoadedScene& scene, SurfaceRecorder& recorder);

    // Known of every integrator.

    /// A path met a surface; until the next call, everything is about this vertex.
    void intersection(const PathVertex& vertex);
    /// The path scattered in a medium or left the scene: a vertex without surface.
    void elsewhere();
    /// A point on a light was chosen.
    void nextEvent(const Light& light, const PointAndNormal& point, Real shapeChoice);
    /// One shadow test from this vertex.
    void shadowTest(bool visible) { shadowed_.add(here_, visible ? 0.f : 1.f); }
    /// The sampled direction is invalid.
    void invalidDirection() { invalidDirections_.add(here_); }
    /// The path ended.
    void end();

    // Known where the integrator says it.

    void throughput(const Spectrum& throughput);
    /// MIS weight of light sampling here.
    void misWeight(Real weight) { misWeight_.add(here_, static_cast<float>(weight)); }
    /// Light that the path met here, as it arrives at the vertex before: emission times MIS weight.
    void hit(const Spectrum& radiance) { if (keep_) vertices_.back().hit += toColor(radiance); }
    /// Light that light sampling found, as it is reflected here towards the path.
    void direct(const Spectrum& radiance) { if (keep_) vertices_.back().direct += toColor(radiance); }
    /// The path goes on. \param factor  BSDF times cosine over density, over the probability to survive
    void scattered(const Spectrum& factor) { if (keep_) vertices_.back().factor = toColor(factor); }
    void rouletteEnd() { roulette_.add(here_); }

  private:
    /// What has to wait for the path's end.
    struct Vertex {
        SurfacePoint point;
        Color throughput{1.f}, hit{0.f}, direct{0.f}, factor{0.f};
    };
    const LoadedScene& scene_;
    SurfaceCursor& cursor_;
    SurfaceLayer intersections_, nextEvents_, shadowed_, invalidDirections_, pathDepth_, throughput_, misWeight_, reflected_,
        contribution_, roulette_;
    bool keep_ = false;     ///< some layer is known only when the path has ended
    SurfacePoint here_;
    std::vector<Vertex> vertices_;
    bool saysThroughput_ = false;  ///< in this path
};

}  // namespace emca::lajolla
