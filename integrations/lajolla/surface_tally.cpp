#include "surface_tally.h"

namespace emca::lajolla {

namespace {

const LayerDescription kShadowed{"shadowed light samples", LayerKind::mean, "",
                                 "Part of the shadow tests from here that found something in between."};

}  // namespace

const std::vector<LayerDescription>& surfaceLayers() {
    static const std::vector<LayerDescription> layers = [] {
        std::vector<LayerDescription> all = pathLayers();
        for (const PathLayer said : {PathLayer::throughput, PathLayer::misWeight, PathLayer::reflected, PathLayer::contribution, PathLayer::roulette})
            all[static_cast<std::size_t>(said)].description += " Only from emcapath.";
        all.push_back(kShadowed);
        return all;
    }();
    return layers;
}

SurfaceTally::SurfaceTally(const LoadedScene& scene, SurfaceRecorder& recorder)
    : scene_(scene), layers_(recorder), paths_(layers_), shadowed_(recorder.find(kShadowed.name)) {}

void SurfaceTally::intersection(const PathVertex& vertex) {
    ++vertices_;
    const Shape& shape = scene_.scene().shapes[static_cast<std::size_t>(vertex.shape_id)];
    SurfaceLocation at{vertex.shape_id, scene_.faceOf(vertex), toVec3f(vertex.position)};
    // st of a triangle are the weights of its second and third vertex.
    if (std::holds_alternative<TriangleMesh>(shape)) at.barycentrics = {static_cast<float>(vertex.st.x), static_cast<float>(vertex.st.y)};
    paths_.intersection(at);
}

void SurfaceTally::elsewhere() {
    ++vertices_;
    paths_.background();
}

void SurfaceTally::nextEvent(const Light& light, const PointAndNormal& point, Real shapeChoice) {
    if (!paths_.wantsNextEvents()) return;
    if (const auto place = scene_.placeOf(light, point, shapeChoice)) paths_.nextEvent({place->mesh, place->face, toVec3f(point.position)});
}

void SurfaceTally::end() {
    paths_.end(vertices_);
    vertices_ = 0;
}

}  // namespace emca::lajolla
