#pragma once

#include <vector>

#include "emca/recorder/path_layers.h"
#include "spectrum_colors.h"

namespace emca::pbrt4 {

/// What one thread's paths add to the path layers: as emca::PathTally, but radiance is gathered from the path's end in
/// spectra. With four wavelengths a sample's colour is noise, and the product of two noisy colours is on average not
/// the colour of the product. Belongs to one thread and one render; changes nothing about the path.
class SpectrumTally {
  public:
    using Spectrum = pbrt::SampledSpectrum;

    explicit SpectrumTally(const PathLayers& layers) : layers_(layers), cursor_(layers.recorder->cursor()) {}

    /// A path met a surface; until the next call, everything is about this vertex.
    void intersection(const SurfaceLocation& at, const Spectrum& throughput) {
        here_ = locate(at);
        layers_.intersections.add(here_);
        begin(throughput);
    }
    /// It left the scene.
    void background(const Spectrum& throughput) {
        here_ = {};
        begin(throughput);
    }
    bool wantsThroughput() const { return bool(layers_.throughput); }
    void throughput(Color throughput) { layers_.throughput.add(here_, throughput); }
    /// Light that the path met here, as it arrives at the vertex before: emission times MIS weight.
    void hit(const Spectrum& radiance) {
        if (!vertices_.empty()) vertices_.back().hit += radiance;
    }
    bool wantsNextEvents() const { return bool(layers_.nextEvents); }
    /// A point on a light was chosen, visible or not.
    void nextEvent(const SurfaceLocation& light) { layers_.nextEvents.add(locate(light)); }
    /// MIS weight of light sampling here, whether or not the light is visible.
    void misWeight(float weight) { layers_.misWeight.add(here_, weight); }
    /// Light that light sampling found, as it is reflected here towards the path.
    void direct(const Spectrum& radiance) {
        if (!vertices_.empty()) vertices_.back().direct += radiance;
    }
    /// The path goes on. \param factor  BSDF times cosine over density, over the probability to survive
    void scattered(const Spectrum& factor) {
        if (!vertices_.empty()) vertices_.back().factor = factor;
    }
    void invalidDirection() { layers_.invalidDirections.add(here_); }
    void rouletteEnd() { layers_.roulette.add(here_); }

    /// The path ended. \param lambda  its wavelengths
    void end(const SpectrumColors& colors, const pbrt::SampledWavelengths& lambda) {
        const auto depth = static_cast<float>(vertices_.size());
        Spectrum arriving(0);  // at the vertex, from where the path went
        for (std::size_t i = vertices_.size(); i-- > 0;) {
            const Vertex& vertex = vertices_[i];
            const Spectrum reflected = vertex.direct + vertex.factor * arriving;
            if (layers_.reflected) layers_.reflected.add(vertex.place, colors.radiance(reflected, lambda));
            if (layers_.contribution)
                layers_.contribution.add(vertex.place, colors.radiance(vertex.throughput * reflected, lambda));
            layers_.pathDepth.add(vertex.place, depth);
            arriving = vertex.hit + reflected;
        }
        vertices_.clear();
    }

  private:
    struct Vertex {
        SurfacePoint place;
        Spectrum throughput, hit{0}, direct{0}, factor{0};
    };
    void begin(const Spectrum& throughput) {
        if (layers_.perPath) vertices_.push_back({here_, throughput});
    }
    SurfacePoint locate(const SurfaceLocation& at) {
        if (at.mesh < 0 || at.face < 0) return {};
        return cursor_.locate(std::uint32_t(at.mesh), std::uint32_t(at.face), at.position);
    }

    const PathLayers& layers_;
    SurfaceCursor& cursor_;
    SurfacePoint here_;
    std::vector<Vertex> vertices_;  ///< empty where no layer asks for the end
};

}  // namespace emca::pbrt4
