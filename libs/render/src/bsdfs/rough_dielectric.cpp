#include <cmath>

#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Rough boundary between two dielectrics (Walter et al. 2007, equations 20 and 21), without scattering between facets.
/// The normal points to the outer side.
class RoughDielectric final : public Bsdf {
  public:
    RoughDielectric(Roughness roughness, float eta, ColorInput reflectance, ColorInput transmittance)
        : roughness_(std::move(roughness)),
          eta_(eta),
          reflectance_(std::move(reflectance)),
          transmittance_(std::move(transmittance)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return evalPdf(at, wo, wi).value; }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        const Microfacets facets = roughness_(at);
        const Vec3f m = facetBetween(wo, wi);
        return density(facets, wo, wi, m, fresnelDielectric(dot(wo, m), eta_).reflectance);
    }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        const Microfacets facets = roughness_(at);
        const Vec3f m = facetBetween(wo, wi);
        const float pdf = density(facets, wo, wi, m, fresnelDielectric(dot(wo, m), eta_).reflectance);
        if (!(pdf > 0.f)) return {};
        return {weight(at, facets, wo, wi, m) * pdf, pdf};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        if (wo.z == 0.f) return std::nullopt;
        const Microfacets facets = roughness_(at);
        const Vec3f m = facets.sampleVisible(wo.z > 0.f ? wo : -wo, u);
        const DielectricFresnel fresnel = fresnelDielectric(dot(wo, m), eta_);
        BsdfSample result;
        result.lobe = Lobe::glossy;
        if (uLobe < fresnel.reflectance) {
            result.wi = reflectAbout(wo, m);
            result.event = Event::reflect;
            if (!(result.wi.z * wo.z > 0.f)) return std::nullopt;
        } else {
            result.wi = refractAbout(wo, m, fresnel.cosTransmitted, eta_);
            result.event = Event::transmit;
            result.eta = relativeIor(wo);
            if (!(result.wi.z * wo.z < 0.f)) return std::nullopt;
        }
        result.pdf = density(facets, wo, result.wi, m, fresnel.reflectance);
        result.weight = weight(at, facets, wo, result.wi, m);
        if (!(result.pdf > 0.f) || isBlack(result.weight)) return std::nullopt;
        return result;
    }

    Color displayColor() const override { return transmittance_.mean(); }

  private:
    /// n(other side) / n(side of wo)
    float relativeIor(Vec3f wo) const { return wo.z > 0.f ? eta_ : 1.f / eta_; }

    /// Normal, on the outer side, of the facet that sends wi to wo; zero if there is none.
    Vec3f facetBetween(Vec3f wo, Vec3f wi) const {
        const Vec3f m = normalize(wo.z * wi.z > 0.f ? wo + wi : wo + wi * relativeIor(wo));
        return m.z < 0.f ? -m : m;
    }

    /// Density of wi: of the visible facet, times the Jacobian of reflection or refraction, times the lobe's
    /// probability.
    float density(const Microfacets& facets, Vec3f wo, Vec3f wi, Vec3f m, float reflectance) const {
        if (wo.z * wi.z == 0.f) return 0.f;
        const float visible = facets.density(m) * facets.maskingG1(wo, m) / std::abs(wo.z);
        if (wo.z * wi.z > 0.f) return reflectance * visible * 0.25f;
        const float cosOut = dot(wo, m), cosIn = dot(wi, m);
        if (cosOut * cosIn >= 0.f) return 0.f;
        const float eta = relativeIor(wo);
        const float jacobian = square(eta) * std::abs(cosIn) / square(cosOut + eta * cosIn);
        return (1.f - reflectance) * visible * std::abs(cosOut) * jacobian;
    }

    /// f |cos wi| / density: shadowing, colour, and for radiance that changes medium 1 / eta^2.
    Color weight(const SurfaceInteraction& at, const Microfacets& facets, Vec3f wo, Vec3f wi, Vec3f m) const {
        const float shadowing = facets.maskingG1(wi, m);
        if (wo.z * wi.z > 0.f) return reflectance_(at) * shadowing;
        return transmittance_(at) * (shadowing / square(relativeIor(wo)));
    }

    Roughness roughness_;
    float eta_;  ///< n(inner side) / n(outer side), not 1
    ColorInput reflectance_, transmittance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeRoughDielectric(PropertyReader& read, FactoryContext& context) {
    Roughness roughness = readRoughness(read, context);
    const float eta = readRelativeIor(read, "bk7", "air");
    if (eta == 1.f) {
        read.report(read.description() +
                    " has the same index of refraction on both sides, so that light goes straight on.");
        return makeDielectric(read, context);
    }
    ColorInput reflectance = readColor(read, context, "specular_reflectance", Color(1.f));
    ColorInput transmittance = readColor(read, context, "specular_transmittance", Color(1.f));
    return std::make_shared<RoughDielectric>(std::move(roughness), eta, std::move(reflectance),
                                             std::move(transmittance));
}

}  // namespace emca::render
