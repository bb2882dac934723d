#include "emca/render/surface_layers.h"

#include "emca/render/shape.h"

namespace emca::render {

void SurfaceTally::nextEvent(const EmitterSample& light) {
    if (!wantsNextEvents() || !light.shape) return;
    const bool known = light.face >= 0;
    PathTally::nextEvent({light.shape->index, known ? light.face : light.shape->faceAt(light.position), light.position,
                          known ? light.barycentrics : light.shape->barycentricsAt(light.position)});
}

}  // namespace emca::render
