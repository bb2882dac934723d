#include "emitters/delta_emitters.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// The sample of a light that is a single point of the given intensity.
std::optional<EmitterSample> samplePoint(Vec3f position, Vec3f from, Color intensity) {
    const Vec3f toLight = position - from;
    const float squared = dot(toLight, toLight);
    if (!(squared > 0.f) || isBlack(intensity)) return std::nullopt;
    const float distance = std::sqrt(squared);
    return EmitterSample{position, toLight / distance, distance, intensity / squared, 1.f};
}

}  // namespace

std::optional<EmitterSample> PointEmitter::sample(Vec3f from, Vec2f) const {
    return samplePoint(position_, from, intensity_);
}

float PointEmitter::power() const { return 4.f * kPi * luminance(intensity_); }

SpotEmitter::SpotEmitter(const Transform& toWorld, Color intensity, float cutoffAngle, float beamWidth)
    : position_(toWorld.point({})),
      axis_(normalize(toWorld.vector({0, 0, 1}))),
      intensity_(intensity),
      cutoff_(cutoffAngle * kPi / 180.f),
      beam_(std::min(beamWidth, cutoffAngle) * kPi / 180.f),
      cosCutoff_(std::cos(cutoff_)),
      cosBeam_(std::cos(beam_)) {}

float SpotEmitter::falloff(float cosine) const {
    if (cosine <= cosCutoff_) return 0.f;
    if (cosine >= cosBeam_) return 1.f;
    return (cutoff_ - std::acos(cosine)) / (cutoff_ - beam_);
}

std::optional<EmitterSample> SpotEmitter::sample(Vec3f from, Vec2f) const {
    return samplePoint(position_, from, intensity_ * falloff(dot(normalize(from - position_), axis_)));
}

float SpotEmitter::power() const {
    return 2.f * kPi * (1.f - 0.5f * (cosCutoff_ + cosBeam_)) * luminance(intensity_);
}

std::optional<EmitterSample> DirectionalEmitter::sample(Vec3f from, Vec2f) const {
    const float far = 2.f * sceneRadius_;
    return EmitterSample{from - direction_ * far, -direction_, far, irradiance_, 1.f};
}

float DirectionalEmitter::power() const { return kPi * square(sceneRadius_) * luminance(irradiance_); }

}  // namespace emca::render
