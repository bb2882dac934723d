#include "emca/render/surface_layers.h"

#include "emca/render/shape.h"

namespace emca::render {

void SurfaceTally::nextEvent(const EmitterSample& light) {
    if (!wantsNextEvents() || !light.shape) return;
    const std::int32_t face = light.face >= 0 ? light.face : light.shape->faceAt(light.position);
    PathTally::nextEvent({light.shape->index, face, light.position, light.barycentrics});
}

}  // namespace emca::render
