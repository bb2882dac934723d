#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/surface_field.h"
#include "emca/recorder/surface_recorder.h"
#include "scene_shapes.h"

namespace emca::mitsuba06 {

/// The layers that emcapath collects while it renders (Ruppert et al., "EMCA", VMV 2021, section 4.1).
const std::vector<LayerDescription>& pathLayers();
/// Those of them that are seen from outside a stock integrator.
const std::vector<LayerDescription>& observedLayers();

/// What one thread's paths add to the layers. Belongs to one thread and one render; changes nothing about the path.
///
/// Radiance reflected at a vertex is gathered backwards from the path's end: direct light there, plus the factor of the
/// scattering times what the next vertex gave (Kajiya, "The Rendering Equation", 1986).
class SurfaceTally {
  public:
    explicit SurfaceTally(SurfaceRecorder& recorder);

    /// A path met a surface, or is somewhere without one; until the next call, everything is about this vertex.
    /// \param throughput  of the camera path up to here
    void vertex(SurfacePlace place, Vec3f position, Color throughput);
    /// Light that the path met here, as it arrives at the vertex before: emission times MIS weight.
    void hit(Color radiance) { if (!vertices_.empty()) vertices_.back().hit += radiance; }
    /// A point on a light was chosen, visible or not.
    void nextEvent(SurfacePlace place, Vec3f position);
    /// MIS weight of light sampling here, whether or not the light is visible.
    void misWeight(float weight) { add(misWeight_, weight); }
    /// Light that light sampling found, as it is reflected here towards the path.
    void direct(Color radiance) { if (!vertices_.empty()) vertices_.back().direct += radiance; }
    /// The path goes on. \param factor  BSDF times cosine over density
    void scattered(Color factor) { if (!vertices_.empty()) vertices_.back().factor = factor; }
    /// It went on although roulette might have ended it.
    void survived(float probability) { if (!vertices_.empty()) vertices_.back().factor /= probability; }
    void invalidDirection() { add(invalidDirections_, 1.f); }
    void rouletteEnd() { add(roulette_, 1.f); }
    /// The path ended. \param depth  its number of vertices
    void end(int depth);

  private:
    /// What has to wait for the path's end.
    struct Vertex {
        SurfacePoint point;
        Color throughput, hit{0.f}, direct{0.f}, factor{0.f};
    };
    SurfacePoint locate(SurfacePlace place, Vec3f position);
    /// At the place of the current vertex.
    void add(const SurfaceLayer& layer, float value) { if (layer && !vertices_.empty()) layer.add(vertices_.back().point, value); }

    SurfaceCursor& cursor_;
    SurfaceLayer intersections_, nextEvents_, misWeight_, throughput_, reflected_, contribution_, invalidDirections_, roulette_, pathDepth_;
    std::vector<Vertex> vertices_;
};

}  // namespace emca::mitsuba06
