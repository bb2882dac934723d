#include "emca/render/interaction.h"

#include "emca/render/shape.h"

namespace emca::render {

Vec2f SurfaceInteraction::uv() const { return shape ? shape->uv(face, barycentrics, position) : barycentrics; }

}  // namespace emca::render
