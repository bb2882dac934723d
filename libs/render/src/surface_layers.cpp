#include "emca/render/surface_layers.h"

#include "emca/render/shape.h"

namespace emca::render {

void SurfaceTally::place(std::int32_t mesh, std::int32_t face, float u, float v, const Vec3f& position) {
    PathTally::intersection({mesh, face, position, {u, v}});
}

void SurfaceTally::nextEvent(const EmitterSample& light) {
    if (!wantsNextEvents() || !light.shape) return;
    const ShapePlace at = light.face >= 0 ? ShapePlace{light.face, light.barycentrics} : light.shape->placeAt(light.position);
    PathTally::nextEvent({light.shape->index, at.face, light.position, at.barycentrics});
}

}  // namespace emca::render
