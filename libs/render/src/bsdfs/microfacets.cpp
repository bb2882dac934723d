#include "bsdfs/microfacets.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

constexpr float kMinAlpha = 1e-4f;
constexpr float kInvSqrtPi = 0.56418958354775628695f;

/// Inverse error function in (-1, 1), relative error below 1e-6.
/// Source: Giles, "Approximating the erfinv Function", GPU Computing Gems Jade Edition, 2011, table 5.
float inverseErf(float x) {
    x = std::clamp(x, -kOneMinusEpsilon, kOneMinusEpsilon);
    float w = -std::log((1.f - x) * (1.f + x));
    float p;
    if (w < 5.f) {
        w -= 2.5f;
        p = 2.81022636e-08f;
        for (const float c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f, -0.00125372503f,
                              -0.00417768164f, 0.246640727f, 1.50140941f}) {
            p = c + p * w;
        }
    } else {
        w = std::sqrt(w) - 3.f;
        p = -0.000200214257f;
        for (const float c : {0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f, -0.0076224613f,
                              0.00943887047f, 1.00167406f, 2.83297682f}) {
            p = c + p * w;
        }
    }
    return p * x;
}

}  // namespace

Microfacets::Microfacets(Type type, float alphaU, float alphaV)
    : type_(type), alphaU_(std::max(alphaU, kMinAlpha)), alphaV_(std::max(alphaV, kMinAlpha)) {}

float Microfacets::density(Vec3f m) const {
    if (m.z <= 0.f) return 0.f;
    const float stretched = square(m.x / alphaU_) + square(m.y / alphaV_);
    const float z2 = m.z * m.z;
    if (type_ == Type::beckmann) {
        return z2 * z2 > 0.f ? std::exp(-stretched / z2) / (kPi * alphaU_ * alphaV_ * z2 * z2) : 0.f;
    }
    return 1.f / (kPi * alphaU_ * alphaV_ * square(stretched + z2));
}

float Microfacets::maskingG1(Vec3f v, Vec3f m) const {
    if (dot(v, m) * v.z <= 0.f) return 0.f;
    const float across = square(alphaU_ * v.x) + square(alphaV_ * v.y);
    if (across == 0.f) return 1.f;
    const float z2 = v.z * v.z;
    if (type_ == Type::ggx) {
        // 2 / (1 + sqrt(1 + alpha^2 tan^2)) without the division by cos^2, which may be 0 in float.
        const float z = std::abs(v.z);
        return 2.f * z / (z + std::sqrt(z2 + across));
    }
    const float a = std::abs(v.z) / std::sqrt(across);
    if (a > 4.f) return 1.f;  // Lambda < 1e-9
    const float a2 = a * a;
    if (a2 == 0.f) return 0.f;
    // Heitz 2014, equation 72, without cancellation at small a: G1 = a / (a + a Lambda).
    return 2.f * a / (2.f * a - a * std::erfc(a) + kInvSqrtPi * std::exp(-a2));
}

float Microfacets::visiblePdf(Vec3f v, Vec3f m) const {
    const float cosine = std::abs(v.z);
    return cosine > 0.f ? density(m) * maskingG1(v, m) * std::abs(dot(v, m)) / cosine : 0.f;
}

/// Slope along the direction of view (x) and across (y) of a visible facet of unit roughness. The density of the slope
/// x seen under theta is proportional to (cos theta - x sin theta) exp(-x^2), x < cot theta (Heitz and d'Eon,
/// "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals", EGSR 2014, section 5). Its
/// integral, written over y = erf(x), is increasing and concave; Halley's steps find u.x in it, within a bracket.
Vec2f Microfacets::sampleBeckmannSlope(float cosTheta, Vec2f u) const {
    const float sinTheta = safeSqrt(1.f - cosTheta * cosTheta);
    const float slopeY = inverseErf(2.f * u.y - 1.f);
    if (sinTheta < 1e-6f) return {inverseErf(2.f * u.x - 1.f), slopeY};

    const float cotangent = cosTheta / sinTheta;
    const float last = std::erf(cotangent);
    const float target = u.x * (cosTheta * (1.f + last) + sinTheta * kInvSqrtPi * std::exp(-cotangent * cotangent));
    float low = -1.f, high = last;
    float y = low + u.x * (high - low);  // on the chord: never below the root
    float x = inverseErf(y);
    for (int i = 0; i < 12; ++i) {
        const float gauss = std::exp(-x * x);
        const float excess = cosTheta * (1.f + y) + sinTheta * kInvSqrtPi * gauss - target;
        if (std::abs(excess) < 1e-6f * (cosTheta + sinTheta)) break;
        (excess > 0.f ? high : low) = y;
        const float slope = cosTheta - x * sinTheta;
        const float curvature = -sinTheta / (2.f * kInvSqrtPi * gauss);  // -sin theta dx/dy
        y -= excess / (slope - 0.5f * excess * curvature / slope);
        if (!(y > low && y < high)) y = 0.5f * (low + high);
        x = inverseErf(y);
    }
    return {std::min(x, cotangent), slopeY};
}

Vec3f Microfacets::sampleVisible(Vec3f v, Vec2f u) const {
    const Vec3f stretched = normalize(Vec3f{alphaU_ * v.x, alphaV_ * v.y, v.z});
    const float across = std::sqrt(square(stretched.x) + square(stretched.y));

    if (type_ == Type::beckmann) {
        const Vec2f slope = sampleBeckmannSlope(std::min(stretched.z, 1.f), u);
        const float c = across > 0.f ? stretched.x / across : 1.f;
        const float s = across > 0.f ? stretched.y / across : 0.f;
        return normalize(Vec3f{-alphaU_ * (c * slope.x - s * slope.y), -alphaV_ * (s * slope.x + c * slope.y), 1.f});
    }

    // Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018: the visible half ellipsoid, made a
    // half sphere, projects to a half disk and a squeezed half disk.
    const Vec3f t1 = across > 0.f ? Vec3f{-stretched.y / across, stretched.x / across, 0.f} : Vec3f{1.f, 0.f, 0.f};
    const Vec3f t2 = cross(stretched, t1);
    const float radius = std::sqrt(u.x);
    const float phi = 2.f * kPi * u.y;
    const float p1 = radius * std::cos(phi);
    const float blend = 0.5f * (1.f + stretched.z);
    const float p2 = (1.f - blend) * safeSqrt(1.f - p1 * p1) + blend * radius * std::sin(phi);
    const Vec3f n = t1 * p1 + t2 * p2 + stretched * safeSqrt(1.f - p1 * p1 - p2 * p2);
    return normalize(Vec3f{alphaU_ * n.x, alphaV_ * n.y, std::max(n.z, 1e-7f)});
}

std::optional<Microfacets::Type> microfacetType(std::string_view name) {
    if (name == "beckmann") return Microfacets::Type::beckmann;
    if (name == "ggx") return Microfacets::Type::ggx;
    return std::nullopt;
}

}  // namespace emca::render
