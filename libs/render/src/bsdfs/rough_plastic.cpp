#include <cmath>

#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"
#include "bsdfs/rough_transmittance.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Plastic (see plastic.cpp) with a rough coat: what passes the coat in either direction is the transmittance of a
/// rough boundary instead of 1 - F.
class RoughPlastic final : public Bsdf {
  public:
    RoughPlastic(Microfacets facets, float eta, ColorInput diffuse, ColorInput specular, bool nonlinear)
        : facets_(facets),
          eta_(eta),
          invEta2_(1.f / square(eta)),
          transmittance_(facets, eta),
          // Reciprocity of the boundary: n_in^2 T_in = n_out^2 T_out for diffuse light.
          internalReflectance_(1.f - transmittance_.diffuse() * invEta2_),
          nonlinear_(nonlinear),
          diffuse_(std::move(diffuse)),
          specular_(std::move(specular)) {
        const float d = luminance(diffuse_.mean()), s = luminance(specular_.mean());
        specularWeight_ = d + s > 0.f ? s / (d + s) : 1.f;
    }

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return evalPdf(at, wo, wi).value; }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return evalPdf(at, wo, wi).pdf; }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return {};
        const float throughOut = transmittance_(wo.z);
        const float probability = specularProbability(throughOut);

        const Vec3f m = normalize(wo + wi);
        const float facet = facets_.density(m) * facets_.maskingG1(wo, m) / (4.f * wo.z);
        const float fresnel = fresnelDielectric(dot(wo, m), eta_).reflectance;
        const Color glossy = specular_(at) * (facet * fresnel * facets_.maskingG1(wi, m));

        const float cosine = squareToCosineHemispherePdf(wi.z);
        const Color albedo = diffuse_(at);
        const Color bounces = (nonlinear_ ? albedo : Color(1.f)) * internalReflectance_;
        const Color base = albedo * (cosine * throughOut * transmittance_(wi.z) * invEta2_) / (Color(1.f) - bounces);

        return {glossy + base, facet * probability + cosine * (1.f - probability)};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        if (wo.z <= 0.f) return std::nullopt;
        BsdfSample result;
        result.event = Event::reflect;
        if (uLobe < specularProbability(transmittance_(wo.z))) {
            result.wi = reflectAbout(wo, facets_.sampleVisible(wo, u));
            result.lobe = Lobe::glossy;
        } else {
            result.wi = squareToCosineHemisphere(u);
            result.lobe = Lobe::diffuse;
        }
        const EvalPdf both = evalPdf(at, wo, result.wi);
        if (!(both.pdf > 0.f) || isBlack(both.value)) return std::nullopt;
        result.pdf = both.pdf;
        result.weight = both.value / both.pdf;
        return result;
    }

    Color displayColor() const override { return diffuse_.mean(); }

  private:
    float specularProbability(float transmittance) const {
        const float specular = (1.f - transmittance) * specularWeight_;
        const float sum = specular + transmittance * (1.f - specularWeight_);
        return sum > 0.f ? specular / sum : 0.f;
    }

    Microfacets facets_;
    float eta_, invEta2_;
    RoughTransmittance transmittance_;
    float internalReflectance_;
    bool nonlinear_;
    float specularWeight_;
    ColorInput diffuse_, specular_;
};

}  // namespace

std::shared_ptr<Bsdf> makeRoughPlastic(PropertyReader& read, FactoryContext& context) {
    const Roughness roughness = readRoughness(read, context);
    float alpha = roughness.alphaU.mean();
    if (!roughness.alphaU.isConstant() || !roughness.alphaV.isConstant()) {
        read.reportProperty("alpha", "is a texture; this material has one roughness, and the texture's mean is used.");
    }
    if (roughness.alphaU.mean() != roughness.alphaV.mean()) {
        alpha = std::sqrt(roughness.alphaU.mean() * roughness.alphaV.mean());
        read.report(read.description() +
                    " has two roughnesses, but this material is isotropic; their geometric mean is used.");
    }
    const float eta = readRelativeIor(read, "polypropylene", "air");
    ColorInput diffuse = readColor(read, context, "diffuse_reflectance", Color(0.5f));
    ColorInput specular = readColor(read, context, "specular_reflectance", Color(1.f));
    return std::make_shared<RoughPlastic>(Microfacets(roughness.type, alpha, alpha), eta, std::move(diffuse),
                                          std::move(specular), read.flag("nonlinear", false));
}

}  // namespace emca::render
