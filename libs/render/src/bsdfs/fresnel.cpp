#include "bsdfs/fresnel.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

DielectricFresnel fresnelDielectric(float cosIncident, float eta) {
    // No boundary: everything goes on straight.
    if (eta == 1.f) return {0.f, -cosIncident};
    const float relative = cosIncident > 0.f ? 1.f / eta : eta;  // n(incident side) / n(transmitted side)
    const float cosSquared = 1.f - square(relative) * (1.f - square(cosIncident));
    if (cosSquared <= 0.f) return {1.f, 0.f};

    const float cosI = std::abs(cosIncident);
    const float cosT = std::sqrt(cosSquared);
    const float perpendicular = (relative * cosI - cosT) / (relative * cosI + cosT);
    const float parallel = (relative * cosT - cosI) / (relative * cosT + cosI);
    const float reflectance = 0.5f * (square(perpendicular) + square(parallel));
    return {std::min(reflectance, 1.f), cosIncident > 0.f ? -cosT : cosT};
}

Color fresnelConductor(float cosIncident, Color eta, Color k) {
    // At cosine 0 both fractions below are 1 in the limit, but 0/0 for an index of 1.
    if (cosIncident <= 0.f) return Color(1.f);
    const float cos2 = square(cosIncident);
    const float sin2 = 1.f - cos2;
    // Four lanes, so that the compiler takes the roots and quotients of all channels at once.
    const float etas[4] = {eta.r, eta.g, eta.b, eta.b}, ks[4] = {k.r, k.g, k.b, k.b};
    float reflectance[4];
    for (int i = 0; i < 4; ++i) {
        const float eta2 = square(etas[i]), k2 = square(ks[i]);
        const float t = eta2 - k2 - sin2;
        const float a2PlusB2 = safeSqrt(square(t) + 4.f * eta2 * k2);
        const float a = safeSqrt(0.5f * (a2PlusB2 + t));
        const float sum = a2PlusB2 + cos2;
        const float cross = 2.f * a * cosIncident;
        const float perpendicular = (sum - cross) / (sum + cross);
        const float sum2 = a2PlusB2 * cos2 + square(sin2);
        const float cross2 = cross * sin2;
        const float parallel = perpendicular * (sum2 - cross2) / (sum2 + cross2);
        reflectance[i] = std::clamp(0.5f * (perpendicular + parallel), 0.f, 1.f);
    }
    return {reflectance[0], reflectance[1], reflectance[2]};
}

float fresnelDiffuseReflectance(float eta) {
    const double criticalCos = eta < 1.f ? std::sqrt(1.0 - static_cast<double>(square(eta))) : 0.0;
    // Below the critical cosine everything is reflected: int_0^c 2 cos dcos = c^2.
    double sum = 0;
    constexpr int kSteps = 2048;
    for (int i = 0; i < kSteps; ++i) {
        // The reflectance has a square root's slope at the critical cosine c; cos = c + (1 - c) s^2 takes it away.
        const double s = (i + 0.5) / kSteps;
        const double cosine = criticalCos + (1.0 - criticalCos) * s * s;
        const double jacobian = (1.0 - criticalCos) * 2.0 * s / kSteps;
        sum += static_cast<double>(fresnelDielectric(static_cast<float>(cosine), eta).reflectance) * 2.0 * cosine *
               jacobian;
    }
    return static_cast<float>(sum + criticalCos * criticalCos);
}

}  // namespace emca::render
