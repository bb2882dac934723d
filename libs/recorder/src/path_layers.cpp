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

template class BasicPathTally<Color>;
template void BasicPathTally<Color>::unwind(int, std::identity);

}  // namespace emca
