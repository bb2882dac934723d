#include "emca/render/surface_layers.h"

#include "emca/render/shape.h"

namespace emca::render {

namespace {

enum Layer : std::size_t {
    kIntersections, kNextEvents, kMisWeight, kThroughput, kReflected, kContribution, kInvalidDirections, kRoulette,
    kPathDepth
};

/// A point of the surface: by barycentric coordinates where they are known, by its position on analytic shapes.
SurfacePoint locate(SurfaceCursor& cursor, std::int32_t mesh, std::int32_t face, Vec2f barycentrics, Vec3f position) {
    const auto m = static_cast<std::uint32_t>(mesh), f = static_cast<std::uint32_t>(face);
    return barycentrics.x == barycentrics.x ? cursor.locate(m, f, barycentrics) : cursor.locate(m, f, position);
}

}  // namespace

const std::vector<LayerDescription>& surfaceLayers() {
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

SurfaceLayers::SurfaceLayers(SurfaceRecorder& surface) : recorder(&surface) {
    const auto find = [&](Layer layer) { return surface.find(surfaceLayers()[layer].name); };
    intersections = find(kIntersections);
    nextEvents = find(kNextEvents);
    misWeight = find(kMisWeight);
    throughput = find(kThroughput);
    reflected = find(kReflected);
    contribution = find(kContribution);
    invalidDirections = find(kInvalidDirections);
    roulette = find(kRoulette);
    pathDepth = find(kPathDepth);
    perPath = reflected || contribution || pathDepth;
}

void SurfaceTally::intersection(const SurfaceInteraction& at, Color throughput) {
    at_ = &at;
    here_ = {};
    if (layers_.intersections) layers_.intersections.add(here());
    if (layers_.throughput) layers_.throughput.add(here(), throughput);
    if (layers_.perPath) vertices_.push_back({here(), throughput});
}

const SurfacePoint& SurfaceTally::here() {
    if (at_ != nullptr) here_ = locate(cursor_, at_->mesh, at_->face, at_->barycentrics, at_->position);
    at_ = nullptr;
    return here_;
}

void SurfaceTally::background() {
    at_ = nullptr;
    here_ = {};
    if (layers_.perPath) vertices_.push_back({here_, Color(0.f)});
}

void SurfaceTally::nextEvent(const EmitterSample& light) {
    if (!layers_.nextEvents || !light.shape) return;
    const std::int32_t face = light.face >= 0 ? light.face : light.shape->faceAt(light.position);
    layers_.nextEvents.add(locate(cursor_, light.shape->index, face, light.barycentrics, light.position));
}

void SurfaceTally::end(int depth) {
    Color arriving(0.f);  // at the vertex, from where the path went
    for (std::size_t i = vertices_.size(); i-- > 0;) {
        const Vertex& vertex = vertices_[i];
        const Color reflected = vertex.direct + vertex.factor * arriving;
        layers_.reflected.add(vertex.point, reflected);
        layers_.contribution.add(vertex.point, vertex.throughput * reflected);
        layers_.pathDepth.add(vertex.point, static_cast<float>(depth));
        arriving = vertex.hit + reflected;
    }
    vertices_.clear();
}

}  // namespace emca::render
