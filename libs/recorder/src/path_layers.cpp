#include "emca/recorder/path_layers.h"

namespace emca {

const std::vector<LayerDescription>& pathLayers() {
    static const std::vector<LayerDescription> layers{
        {"intersection density", LayerKind::density, "1/unit²", "Intersections of all paths with surfaces."},
        {"next-event density", LayerKind::density, "1/unit²",
         "Points on lights that next-event estimation chose, whether or not they are visible."},
        {"MIS weight", LayerKind::mean, "",
         "Weight of light sampling at the lit point, whether or not the light is visible."},
        {"throughput", LayerKind::meanColor, "", "Throughput with which camera paths arrive."},
        {"reflected radiance", LayerKind::meanColor, "W/(sr·unit²)",
         "Radiance reflected or transmitted back along the path: approximates global illumination."},
        {"image contribution", LayerKind::meanColor, "W/(sr·unit²)",
         "Reflected radiance times the throughput of the camera path: what the image still gains from here on."},
        {"invalid directions", LayerKind::density, "1/unit²",
         "Paths that end because the BSDF's sample is invalid or black, such as directions below the surface."},
        {"Russian roulette", LayerKind::density, "1/unit²", "Paths that Russian roulette ends."},
        {"path depth", LayerKind::mean, "vertices", "Number of vertices of the paths that come by."},
    };
    return layers;
}

std::vector<LayerDescription> pathLayers(std::initializer_list<PathLayer> some) {
    std::vector<LayerDescription> layers;
    for (const PathLayer layer : some) layers.push_back(pathLayers()[static_cast<std::size_t>(layer)]);
    return layers;
}

PathLayers::PathLayers(SurfaceRecorder& surface) : recorder(&surface) {
    const auto find = [&](PathLayer layer) { return surface.find(pathLayers()[static_cast<std::size_t>(layer)].name); };
    intersections = find(PathLayer::intersections);
    nextEvents = find(PathLayer::nextEvents);
    misWeight = find(PathLayer::misWeight);
    throughput = find(PathLayer::throughput);
    reflected = find(PathLayer::reflected);
    contribution = find(PathLayer::contribution);
    invalidDirections = find(PathLayer::invalidDirections);
    roulette = find(PathLayer::roulette);
    pathDepth = find(PathLayer::pathDepth);
    perPath = reflected || contribution || pathDepth;
}

SurfacePoint PathTally::locate(const SurfaceLocation& at) {
    if (at.mesh < 0 || at.face < 0) return {};
    const auto mesh = static_cast<std::uint32_t>(at.mesh), face = static_cast<std::uint32_t>(at.face);
    return at.barycentrics.x == at.barycentrics.x ? cursor_.locate(mesh, face, at.barycentrics) : cursor_.locate(mesh, face, at.position);
}

void PathTally::background() {
    here_ = {};
    located_ = true;
    if (layers_.perPath) vertices_.push_back({});
}

void PathTally::nextEvent(const SurfaceLocation& light) {
    if (layers_.nextEvents) layers_.nextEvents.add(locate(light));
}

void PathTally::end(int depth) {
    Color arriving(0.f);  // at the vertex, from where the path went
    for (std::size_t i = vertices_.size(); i-- > 0;) {
        const Vertex& vertex = vertices_[i];
        layers_.pathDepth.add(vertex.point, static_cast<float>(depth));
        if (!saysThroughput_) continue;
        const Color reflected = vertex.direct + vertex.factor * arriving;
        layers_.reflected.add(vertex.point, reflected);
        layers_.contribution.add(vertex.point, vertex.throughput * reflected);
        arriving = vertex.hit + reflected;
    }
    vertices_.clear();
    here_ = {};
    located_ = true;
    saysThroughput_ = false;
}

}  // namespace emca
