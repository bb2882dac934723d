#include "emitters/area_emitter.h"

#include "emca/render/sampling_functions.h"

namespace emca::render {

AreaEmitter::AreaEmitter(const Shape& shape, std::shared_ptr<const Texture> radiance)
    : shape_(shape), radiance_(std::move(radiance)), mean_(radiance_->mean()), constant_(radiance_->isConstant()) {}

std::optional<EmitterSample> AreaEmitter::sample(Vec3f from, Vec2f u) const {
    std::optional<EmitterSample> light;  // returned everywhere, so that it is made in place
    const auto point = shape_.sample(from, u);
    if (!point || dot(point->normal, point->direction) >= 0.f) return light;  // seen from behind
    EmitterSample& sample = light.emplace();
    // A shadow ray ends a little above the light, as it starts a little above the lit surface.
    sample.position = point->position + point->normal * point->positionError;
    sample.direction = point->direction;
    sample.distance = point->distance;
    sample.radiance = constant_ ? mean_ : radiance_->eval(point->uv);
    sample.pdf = point->pdf;
    sample.shape = &shape_;
    sample.face = point->face;
    sample.barycentrics = point->barycentrics;
    return light;
}

float AreaEmitter::power() const { return kPi * shape_.area() * luminance(mean_); }

Color AreaEmitter::emitted(const SurfaceInteraction& at, Vec3f direction) const {
    if (dot(at.geometricNormal, direction) <= 0.f) return Color(0.f);
    return constant_ ? mean_ : radiance_->eval(at.uv);
}

float AreaEmitter::pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const {
    return shape_.pdf(from, direction, distance, at);
}

}  // namespace emca::render
