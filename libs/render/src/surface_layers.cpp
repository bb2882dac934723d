#include "emca/render/surface_layers.h"

#include "emca/render/shape.h"

namespace emca::render {

void SurfaceTally::place(std::int32_t mesh, std::int32_t face, float u, float v, const Vec3f& position) {
    PathTally::intersection({mesh, face, position, {u, v}});
}

void SurfaceTally::nextEvent(const EmitterSample& light) {
    if (!wantsNextEvents() || !light.shape) return;
    const bool known = light.face >= 0;
    PathTally::nextEvent({light.shape->index, known ? light.face : light.shape->faceAt(light.position), light.position,
                          known ? light.barycentrics : light.shape->barycentricsAt(light.position)});
}

}  // namespace emca::render
