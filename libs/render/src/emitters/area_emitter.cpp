#include "emitters/area_emitter.h"

#include "emca/render/sampling_functions.h"

namespace emca::render {

AreaEmitter::AreaEmitter(const Shape& shape, std::shared_ptr<const Texture> radiance)
    : shape_(shape), radiance_(std::move(radiance)), mean_(radiance_->mean()), constant_(radiance_->isConstant()) {}

std::optional<EmitterSample> AreaEmitter::sample(Vec3f from, Vec2f u) const {
    std::optional<EmitterSample> light(std::in_place);  // returned everywhere, so that it is made in place
    EmitterSample& sample = *light;
    if (!shape_.sample(from, u, sample) || dot(sample.normal, sample.direction) >= 0.f) {  // seen from behind
        light.reset();
        return light;
    }
    sample.radiance = constant_ ? mean_ : radiance_->eval(shape_.uv(sample.face, sample.barycentrics, sample.position));
    // A shadow ray ends a little above the light, as it starts a little above the lit surface.
    sample.position = sample.position + sample.normal * sample.positionError;
    sample.shape = &shape_;
    return light;
}

float AreaEmitter::power() const { return kPi * shape_.area() * luminance(mean_); }

Color AreaEmitter::emitted(const SurfaceInteraction& at, Vec3f direction) const {
    if (dot(at.geometricNormal, direction) <= 0.f) return Color(0.f);
    return constant_ ? mean_ : radiance_->eval(at.uv());
}

float AreaEmitter::pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const {
    return shape_.pdf(from, direction, distance, at);
}

}  // namespace emca::render
