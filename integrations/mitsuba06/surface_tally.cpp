#include "surface_tally.h"

namespace emca::mitsuba06 {

namespace {

const LayerDescription kIntersections{"intersection density", LayerKind::density, "1/unit²", "Intersections of all paths with surfaces."};
const LayerDescription kNextEvents{"next-event density", LayerKind::density, "1/unit²",
                                   "Points on lights that next-event estimation chose, whether or not they are visible."};
const LayerDescription kMisWeight{"MIS weight", LayerKind::mean, "",
                                  "Weight of light sampling at the lit point, whether or not the light is visible."};
const LayerDescription kThroughput{"throughput", LayerKind::meanColor, "", "Throughput with which camera paths arrive."};
const LayerDescription kObservedThroughput{"throughput without roulette", LayerKind::meanColor, "",
                                           "Product of the BSDF weights with which camera paths arrive; roulette is not seen from outside."};
const LayerDescription kReflected{"reflected radiance", LayerKind::meanColor, "W/(sr·unit²)",
                                  "Radiance reflected or transmitted back along the path: approximates global illumination."};
const LayerDescription kContribution{"image contribution", LayerKind::meanColor, "W/(sr·unit²)",
                                     "Reflected radiance times the throughput of the camera path: what the image still gains from here on."};
const LayerDescription kInvalidDirections{"invalid directions", LayerKind::density, "1/unit²",
                                          "Paths that end because the BSDF's sample is invalid or black, such as directions below the surface."};
const LayerDescription kRoulette{"Russian roulette", LayerKind::density, "1/unit²", "Paths that Russian roulette ends."};
const LayerDescription kPathDepth{"path depth", LayerKind::mean, "vertices", "Number of vertices of the paths that come by."};

}  // namespace

const std::vector<LayerDescription>& pathLayers() {
    static const std::vector<LayerDescription> layers{kIntersections, kNextEvents,   kMisWeight,         kThroughput, kReflected,
                                                      kContribution,  kInvalidDirections, kRoulette, kPathDepth};
    return layers;
}

const std::vector<LayerDescription>& observedLayers() {
    static const std::vector<LayerDescription> layers{kIntersections, kNextEvents, kObservedThroughput, kInvalidDirections, kPathDepth};
    return layers;
}

SurfaceTally::SurfaceTally(SurfaceRecorder& recorder)
    : cursor_(recorder.cursor()), intersections_(recorder.find(kIntersections.name)), nextEvents_(recorder.find(kNextEvents.name)),
      misWeight_(recorder.find(kMisWeight.name)), throughput_(recorder.find(kThroughput.name)), reflected_(recorder.find(kReflected.name)),
      contribution_(recorder.find(kContribution.name)), invalidDirections_(recorder.find(kInvalidDirections.name)),
      roulette_(recorder.find(kRoulette.name)), pathDepth_(recorder.find(kPathDepth.name)) {
    if (!throughput_) throughput_ = recorder.find(kObservedThroughput.name);
}

SurfacePoint SurfaceTally::locate(SurfacePlace place, Vec3f position) {
    if (!place) return {};
    return cursor_.locate(static_cast<std::uint32_t>(place.mesh), static_cast<std::uint32_t>(place.face), position);
}

void SurfaceTally::vertex(SurfacePlace place, Vec3f position, Color throughput) {
    vertices_.push_back({locate(place, position), throughput});
    const SurfacePoint& here = vertices_.back().point;
    intersections_.add(here);
    throughput_.add(here, throughput);
}

void SurfaceTally::nextEvent(SurfacePlace place, Vec3f position) {
    if (nextEvents_) nextEvents_.add(locate(place, position));
}

void SurfaceTally::end(int depth) {
    Color arriving(0.f);  // at the vertex, from where the path went
    for (std::size_t i = vertices_.size(); i-- > 0;) {
        const Vertex& vertex = vertices_[i];
        const Color reflected = vertex.direct + vertex.factor * arriving;
        reflected_.add(vertex.point, reflected);
        contribution_.add(vertex.point, vertex.throughput * reflected);
        pathDepth_.add(vertex.point, static_cast<float>(depth));
        arriving = vertex.hit + reflected;
    }
    vertices_.clear();
}

}  // namespace emca::mitsuba06
