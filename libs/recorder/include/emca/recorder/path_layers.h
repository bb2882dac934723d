#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/surface_field.h"
#include "emca/core/vector.h"
#include "emca/recorder/surface_recorder.h"

namespace emca {

/// The layers that any path tracer can collect while it renders: where paths go, with what weight, and where they die
/// (Ruppert et al., "EMCA", VMV 2021, section 4.1 and Figures 2, 9, 10 and 11).
enum class PathLayer : std::uint8_t {
    intersections, nextEvents, misWeight, throughput, reflected, contribution, invalidDirections, roulette, pathDepth
};

/// All of them, in the order of PathLayer: for Renderer::surfaceLayers().
const std::vector<LayerDescription>& pathLayers();
/// Some of them: what an observer sees of an integrator is less.
std::vector<LayerDescription> pathLayers(std::initializer_list<PathLayer> some);

/// Handles of those path layers that a recorder was asked for; the others ignore what is added. Shared by all threads of
/// a render.
struct PathLayers {
    explicit PathLayers(SurfaceRecorder& recorder);

    SurfaceRecorder* recorder;
    SurfaceLayer intersections, nextEvents, misWeight, throughput, reflected, contribution, invalidDirections, roulette, pathDepth;
    bool perPath;  ///< some layer is known only when the path has ended
};

/// A point of a surface as a renderer names it. A plain value.
struct SurfaceLocation {
    static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

    std::int32_t mesh = -1, face = -1;        ///< as for setIntersectionSurface; negative: on no surface
    Vec3f position;                           ///< world space; read where there are no barycentrics
    Vec2f barycentrics{kUnknown, kUnknown};   ///< weights of the triangle's second and third vertex, if known

    bool hasBarycentrics() const { return barycentrics.x == barycentrics.x; }
};

/// What one thread's paths add to the path layers. Belongs to one thread and one render; changes nothing about the path.
/// An integrator calls what it knows: of observed ones often no more than intersection() and end().
///
/// Radiance reflected at a vertex is gathered backwards from the path's end: direct light there, plus the factor of the
/// scattering times what the next vertex gave (Kajiya, "The Rendering Equation", 1986). So a channel whose throughput is
/// zero at the camera still shows its light.
///
/// \tparam Radiance  what the renderer computes with: a colour, or a spectrum at the path's wavelengths. With few of them a
///                   sample's colour is noise, and the product of two noisy colours is on average not the colour of the
///                   product; so it becomes a colour at the end. Has +, +=, * and, for survived(), /= of a number.
template <typename Radiance>
class BasicPathTally {
  public:
    /// In the thread that adds. `layers` must outlive it.
    explicit BasicPathTally(const PathLayers& layers) : layers_(layers), cursor_(layers.recorder->cursor()) {}

    /// A path met a surface; until the next call, everything is about this vertex.
    void intersection(const SurfaceLocation& at) {
        SurfacePoint& point = layers_.perPath ? vertices_.emplace_back().point : here_;
        located_ = layers_.perPath || layers_.intersections;
        if (!located_) return keep(at);
        locate(at, point);
        layers_.intersections.add(point);
    }
    /// A vertex without surface: the path left the scene, or scattered in a medium.
    void background();
    /// Of the camera path up to here, with that of Russian roulette.
    /// \param toColor  of throughput; called where a layer shows it
    template <typename ToColor = std::identity>
    void throughput(const Radiance& throughput, ToColor toColor = {}) {
        saysThroughput_ = true;
        if (layers_.throughput) layers_.throughput.add(here(), toColor(throughput));
        if (!vertices_.empty()) vertices_.back().throughput = throughput;
    }
    /// Light that the path met here, as it arrives at the vertex before: emission times MIS weight.
    void hit(const Radiance& radiance) { if (!vertices_.empty()) vertices_.back().hit += radiance; }
    /// Whether nextEvent() has any effect: a place on a light may cost something to find.
    bool wantsNextEvents() const { return bool(layers_.nextEvents); }
    /// A point on a light was chosen, visible or not.
    void nextEvent(const SurfaceLocation& light);
    /// MIS weight of light sampling here, whether or not the light is visible.
    void misWeight(float weight) { if (layers_.misWeight) layers_.misWeight.add(here(), weight); }
    /// Light that light sampling found, as it is reflected here towards the path.
    void direct(const Radiance& radiance) { if (!vertices_.empty()) vertices_.back().direct += radiance; }
    /// The path goes on. \param factor  BSDF times cosine over density
    void scattered(const Radiance& factor) { if (!vertices_.empty()) vertices_.back().factor = factor; }
    /// Russian roulette let it go on. \param probability  of that; is part of throughput() at the next vertex
    void survived(float probability) { if (!vertices_.empty()) vertices_.back().factor /= probability; }
    void invalidDirection() { if (layers_.invalidDirections) layers_.invalidDirections.add(here()); }
    void rouletteEnd() { if (layers_.roulette) layers_.roulette.add(here()); }
    /// The path ended.
    /// \param depth    its number of vertices
    /// \param toColor  of radiance; called where a layer shows it
    template <typename ToColor = std::identity>
    void end(int depth, ToColor toColor = {}) {
        if (!vertices_.empty()) unwind(depth, toColor);
        here_ = {};
        located_ = true;
        saysThroughput_ = false;
    }
    /// The place of this vertex, for layers of the renderer's own.
    const SurfacePoint& here() {
        if (!located_) locateHere();
        return vertices_.empty() ? here_ : vertices_.back().point;
    }

  private:
    /// What has to wait for the path's end.
    struct Vertex {
        SurfacePoint point;
        Radiance throughput{0.f}, hit{0.f}, direct{0.f}, factor{0.f};
    };
    /// For later, only what locate() will read: a position that was just found is still on its way to the cache.
    void keep(const SurfaceLocation& at) {
        at_.mesh = at.mesh;
        at_.face = at.face;
        at_.barycentrics = at.barycentrics;
        if (!at.hasBarycentrics()) at_.position = at.position;
    }
    void locate(const SurfaceLocation& at, SurfacePoint& point) {
        if (at.mesh < 0 || at.face < 0) {
            point = {};
            return;
        }
        const auto mesh = static_cast<std::uint32_t>(at.mesh), face = static_cast<std::uint32_t>(at.face);
        if (at.hasBarycentrics()) {
            cursor_.locate(mesh, face, at.barycentrics, point);
        } else {
            point = cursor_.locate(mesh, face, at.position);
        }
    }
    template <typename ToColor>
    void unwind(int depth, ToColor toColor);
    void locateHere() {
        locate(at_, here_);
        located_ = true;
    }

    const PathLayers& layers_;
    SurfaceCursor& cursor_;
    SurfaceLocation at_;
    SurfacePoint here_;     ///< if located_: a place is a point of the subdivision, so only where there is something to add.
                            ///< Where layers ask for the end, the last vertex has it instead
    bool located_ = true, saysThroughput_ = false;
    std::vector<Vertex> vertices_;  ///< empty where no layer asks for the end
};

template <typename Radiance>
void BasicPathTally<Radiance>::background() {
    here_ = {};
    located_ = true;
    if (layers_.perPath) vertices_.push_back({});
}

template <typename Radiance>
void BasicPathTally<Radiance>::nextEvent(const SurfaceLocation& light) {
    if (!layers_.nextEvents) return;
    SurfacePoint point;
    locate(light, point);
    layers_.nextEvents.add(point);
}

template <typename Radiance>
template <typename ToColor>
void BasicPathTally<Radiance>::unwind(int depth, ToColor toColor) {
    Radiance arriving{0.f};  // at the vertex, from where the path went
    for (std::size_t i = vertices_.size(); i-- > 0;) {
        const Vertex& vertex = vertices_[i];
        layers_.pathDepth.add(vertex.point, static_cast<float>(depth));
        if (!saysThroughput_) continue;
        const Radiance reflected = vertex.direct + vertex.factor * arriving;
        if (layers_.reflected) layers_.reflected.add(vertex.point, toColor(reflected));
        if (layers_.contribution) layers_.contribution.add(vertex.point, toColor(vertex.throughput * reflected));
        arriving = vertex.hit + reflected;
    }
    vertices_.clear();
}

/// The tally of renderers whose radiance is a colour.
using PathTally = BasicPathTally<Color>;
// Compiled once, in the library.
extern template class BasicPathTally<Color>;
extern template void BasicPathTally<Color>::unwind(int, std::identity);

}  // namespace emca
