#include "bsdfs/rough_transmittance.h"

#include <algorithm>
#include <cmath>

#include "bsdfs/fresnel.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Mean over the visible facets, at the midpoints of a grid, of what each lets through and the others do not shadow.
float transmitted(const Microfacets& facets, float eta, float cosTheta) {
    constexpr int kAlong = 32, kAcross = 16;
    const Vec3f light{safeSqrt(1.f - cosTheta * cosTheta), 0.f, cosTheta};
    double sum = 0;
    for (int i = 0; i < kAlong; ++i) {
        for (int j = 0; j < kAcross; ++j) {
            const Vec2f u{(static_cast<float>(i) + 0.5f) / kAlong, (static_cast<float>(j) + 0.5f) / kAcross};
            const Vec3f m = facets.sampleVisible(light, u);
            const DielectricFresnel fresnel = fresnelDielectric(dot(light, m), eta);
            if (fresnel.cosTransmitted >= 0.f) continue;
            const Vec3f through = refractAbout(light, m, fresnel.cosTransmitted, eta);
            if (through.z < 0.f) sum += static_cast<double>((1.f - fresnel.reflectance) * facets.maskingG1(through, m));
        }
    }
    return static_cast<float>(sum / (kAlong * kAcross));
}

}  // namespace

RoughTransmittance::RoughTransmittance(const Microfacets& facets, float eta) {
    for (std::size_t i = 0; i <= kSteps; ++i) {
        const float root = static_cast<float>(i) / kSteps;
        table_[i] = transmitted(facets, eta, std::max(root * root, 1e-4f));
    }
    // With cos = s^2: int T 4 s^3 ds, by the midpoint rule.
    double sum = 0;
    constexpr int kMidpoints = 4 * kSteps;
    for (int i = 0; i < kMidpoints; ++i) {
        const double s = (i + 0.5) / kMidpoints;
        sum += static_cast<double>((*this)(static_cast<float>(s * s))) * 4.0 * s * s * s / kMidpoints;
    }
    diffuse_ = static_cast<float>(sum);
}

float RoughTransmittance::operator()(float cosTheta) const {
    const float position = std::sqrt(std::clamp(cosTheta, 0.f, 1.f)) * kSteps;
    const std::size_t i = std::min(static_cast<std::size_t>(position), kSteps - 1);
    const float t = position - static_cast<float>(i);
    return (1.f - t) * table_[i] + t * table_[i + 1];
}

}  // namespace emca::render
