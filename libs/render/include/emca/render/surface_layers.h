#pragma once

#include <vector>

#include "emca/core/surface_field.h"
#include "emca/recorder/surface_recorder.h"
#include "emca/render/emitter.h"
#include "emca/render/interaction.h"

namespace emca::render {

/// The layers that the path integrator can collect while it renders: where paths go, with what weight, and where they
/// die (Ruppert et al., "EMCA", VMV 2021, section 4.1 and Figures 2, 9, 10 and 11).
const std::vector<LayerDescription>& surfaceLayers();

/// Handles of those layers that a recorder was asked for; the others ignore what is added. Shared by all threads.
struct SurfaceLayers {
    explicit SurfaceLayers(SurfaceRecorder& recorder);

    SurfaceRecorder* recorder;
    SurfaceLayer intersections, nextEvents, misWeight, throughput, reflected, contribution, invalidDirections, roulette,
        pathDepth;
    bool perPath;  ///< some layer is known only when the path has ended
};

/// What one thread's paths add to the layers. Belongs to one thread and one render; changes nothing about the path.
///
/// Radiance reflected at a vertex is gathered backwards from the path's end: direct light there, plus the factor of the
/// scattering times what the next vertex gave (Kajiya, "The Rendering Equation", 1986). So a channel whose throughput is
/// zero at the camera still shows its light.
class SurfaceTally {
  public:
    explicit SurfaceTally(const SurfaceLayers& layers) : layers_(layers), cursor_(layers.recorder->cursor()) {}

    /// A path met a surface; until the next call, everything is about this vertex. `at` must stay as long.
    /// \param throughput  of the camera path up to here
    void intersection(const SurfaceInteraction& at, Color throughput);
    /// The path left the scene: a last place without surface.
    void background();
    /// Light that the path met here, as it arrives at the vertex before: emission times MIS weight.
    void hit(Color radiance) { if (!vertices_.empty()) vertices_.back().hit += radiance; }
    /// A point on a light was chosen.
    void nextEvent(const EmitterSample& light);
    /// MIS weight of light sampling here, whether or not the light is visible.
    void misWeight(float weight) { if (layers_.misWeight) layers_.misWeight.add(here(), weight); }
    /// Light that light sampling found, as it is reflected here towards the path.
    void direct(Color radiance) { if (!vertices_.empty()) vertices_.back().direct += radiance; }
    /// The path goes on. \param factor  BSDF times cosine over density, over the probability to survive
    void scattered(Color factor) { if (!vertices_.empty()) vertices_.back().factor = factor; }
    void invalidDirection() { if (layers_.invalidDirections) layers_.invalidDirections.add(here()); }
    void rouletteEnd() { if (layers_.roulette) layers_.roulette.add(here()); }
    /// The path ended. \param depth  its number of vertices
    void end(int depth);

  private:
    /// What has to wait for the path's end.
    struct Vertex {
        SurfacePoint point;
        Color throughput, hit{0.f}, direct{0.f}, factor{0.f};
    };
    const SurfaceLayers& layers_;
    SurfaceCursor& cursor_;
    /// The place of this vertex: a place is a point of the subdivision, so only where there is something to add.
    const SurfacePoint& here();

    const SurfaceInteraction* at_ = nullptr;  ///< of this vertex, as long as nothing was added; null: nowhere
    SurfacePoint here_;
    std::vector<Vertex> vertices_;  ///< empty where no layer asks for the end
};

}  // namespace emca::render
