#include "surface_tally.h"

namespace emca::lajolla {

const std::vector<LayerDescription>& surfaceLayers() {
    static const std::vector<LayerDescription> layers{
        {"intersection density", LayerKind::density, "1/unit²", "Intersections of all paths with surfaces."},
        {"next-event density", LayerKind::density, "1/unit²", "Points on lights that light sampling chose, whether or not they are visible."},
        {"shadowed light samples", LayerKind::mean, "", "Part of the shadow tests from here that found something in between."},
        {"invalid directions", LayerKind::density, "1/unit²", "Paths whose sampled direction is invalid."},
        {"path depth", LayerKind::mean, "vertices", "Number of vertices of the paths that come by."},
        {"throughput", LayerKind::meanColor, "", "Throughput with which camera paths arrive. Only from emcapath."},
        {"MIS weight", LayerKind::mean, "", "Weight of light sampling at the lit point. Only from emcapath."},
        {"reflected radiance", LayerKind::meanColor, "W/(sr·unit²)",
         "Radiance reflected or transmitted back along the path: approximates global illumination. Only from emcapath."},
        {"image contribution", LayerKind::meanColor, "W/(sr·unit²)",
         "Reflected radiance times the throughput of the camera path: what the image still gains from here on. Only from emcapath."},
        {"Russian roulette", LayerKind::density, "1/unit²", "Paths that Russian roulette ends. Only from emcapath."},
    };
    return layers;
}

SurfaceTally::SurfaceTally(const LoadedScene& scene, SurfaceRecorder& recorder) : scene_(scene), cursor_(recorder.cursor()) {
    SurfaceLayer* const handles[] = {&intersections_, &nextEvents_, &shadowed_,  &invalidDirections_, &pathDepth_,
                                     &throughput_,    &misWeight_,  &reflected_, &contribution_,      &roulette_};
    for (std::size_t i = 0; i < surfaceLayers().size(); ++i) *handles[i] = recorder.find(surfaceLayers()[i].name);
    keep_ = reflected_ || contribution_ || pathDepth_;
}

void SurfaceTally::intersection(const PathVertex& vertex) {
    const Shape& shape = scene_.scene().shapes[static_cast<std::size_t>(vertex.shape_id)];
    const auto mesh = static_cast<std::uint32_t>(vertex.shape_id), face = static_cast<std::uint32_t>(scene_.faceOf(vertex));
    // st of a triangle are the weights of its second and third vertex.
    here_ = std::holds_alternative<TriangleMesh>(shape)
                ? cursor_.locate(mesh, face, Vec2f{static_cast<float>(vertex.st.x), static_cast<float>(vertex.st.y)})
                : cursor_.locate(mesh, face, toVec3f(vertex.position));
    intersections_.add(here_);
    if (keep_) vertices_.push_back({here_});
}

void SurfaceTally::elsewhere() {
    here_ = {};
    if (keep_) vertices_.push_back({});
}

void SurfaceTally::nextEvent(const Light& light, const PointAndNormal& point, Real shapeChoice) {
    if (!nextEvents_) return;
    if (const auto place = scene_.placeOf(light, point, shapeChoice)) {
        nextEvents_.add(cursor_.locate(static_cast<std::uint32_t>(place->mesh), static_cast<std::uint32_t>(place->face), toVec3f(point.position)));
    }
}

void SurfaceTally::throughput(const Spectrum& throughput) {
    saysThroughput_ = true;
    throughput_.add(here_, toColor(throughput));
    if (keep_) vertices_.back().throughput = toColor(throughput);
}

void SurfaceTally::end() {
    Color arriving(0.f);  // at the vertex, from where the path went
    for (std::size_t i = vertices_.size(); i-- > 0;) {
        const Vertex& vertex = vertices_[i];
        pathDepth_.add(vertex.point, static_cast<float>(vertices_.size()));
        if (!saysThroughput_) continue;
        const Color reflected = vertex.direct + vertex.factor * arriving;
        reflected_.add(vertex.point, reflected);
        contribution_.add(vertex.point, vertex.throughput * reflected);
        arriving = vertex.hit + reflected;
    }
    vertices_.clear();
    here_ = {};
    saysThroughput_ = false;
}

}  // namespace emca::lajolla
