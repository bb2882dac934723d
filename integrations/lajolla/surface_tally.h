#pragma once

#include <vector>

#include "emca/recorder/path_layers.h"
#include "loaded_scene.h"

namespace emca::lajolla {

/// The 3D data that can be collected while an image renders: the path layers, and which light samples are in shadow.
/// Throughput and what follows from it need an integrator that says it: `emcapath`.
const std::vector<LayerDescription>& surfaceLayers();

/// What one thread's paths add to the layers that were asked for, in lajolla's types. Belongs to one thread and one render;
/// changes nothing about the path.
class SurfaceTally {
  public:
    /// Both must outlive it. Called in the thread that renders.
    SurfaceTally(const LoadedScene& scene, SurfaceRecorder& recorder);
    SurfaceTally(const SurfaceTally&) = delete;
    SurfaceTally& operator=(const SurfaceTally&) = delete;

    // Known of every integrator.

    /// A path met a surface; until the next call, everything is about this vertex.
    void intersection(const PathVertex& vertex);
    /// The path scattered in a medium or left the scene: a vertex without surface.
    void elsewhere();
    /// A point on a light was chosen.
    void nextEvent(const Light& light, const PointAndNormal& point, Real shapeChoice);
    /// One shadow test from this vertex.
    void shadowTest(bool visible) { if (shadowed_) shadowed_.add(paths_.here(), visible ? 0.f : 1.f); }
    /// The sampled direction is invalid.
    void invalidDirection() { paths_.invalidDirection(); }
    /// The path ended.
    void end();

    // Known where the integrator says it: as in PathTally.

    void throughput(const Spectrum& throughput) { paths_.throughput(toColor(throughput)); }
    void misWeight(Real weight) { paths_.misWeight(static_cast<float>(weight)); }
    void hit(const Spectrum& radiance) { paths_.hit(toColor(radiance)); }
    void direct(const Spectrum& radiance) { paths_.direct(toColor(radiance)); }
    /// \param factor  over the probability to survive
    void scattered(const Spectrum& factor) { paths_.scattered(toColor(factor)); }
    void rouletteEnd() { paths_.rouletteEnd(); }

  private:
    const LoadedScene& scene_;
    PathLayers layers_;
    PathTally paths_;
    SurfaceLayer shadowed_;
    int vertices_ = 0;  ///< of this path
};

}  // namespace emca::lajolla
