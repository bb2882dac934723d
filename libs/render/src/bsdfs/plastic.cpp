#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// A diffuse base under a smooth dielectric coat, with all scattering between the two: light enters with 1 - F, is
/// reflected within by the boundary's diffuse reflectance any number of times, and leaves with 1 - F. `nonlinear`
/// multiplies the base's colour in at every bounce, which saturates it; otherwise only once.
class Plastic final : public Bsdf {
  public:
    Plastic(float eta, ColorInput diffuse, ColorInput specular, bool nonlinear)
        : eta_(eta),
          invEta2_(1.f / square(eta)),
          internalReflectance_(fresnelDiffuseReflectance(1.f / eta)),
          nonlinear_(nonlinear),
          diffuse_(std::move(diffuse)),
          specular_(std::move(specular)) {
        const float d = luminance(diffuse_.mean()), s = luminance(specular_.mean());
        specularWeight_ = d + s > 0.f ? s / (d + s) : 1.f;
    }

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return evalPdf(at, wo, wi).value; }
    float pdf(const SurfaceInteraction&, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f) return 0.f;
        const float fresnel = fresnelDielectric(wo.z, eta_).reflectance;
        return squareToCosineHemispherePdf(wi.z) * (1.f - specularProbability(fresnel));
    }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return {};
        const float fresnel = fresnelDielectric(wo.z, eta_).reflectance;
        const float density = squareToCosineHemispherePdf(wi.z);
        return {base(at, fresnel, wi.z) * density, density * (1.f - specularProbability(fresnel))};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        if (wo.z <= 0.f) return std::nullopt;
        const float fresnel = fresnelDielectric(wo.z, eta_).reflectance;
        const float probability = specularProbability(fresnel);
        BsdfSample result;
        result.event = Event::reflect;
        if (uLobe < probability) {
            result.wi = reflectLocal(wo);
            result.weight = specular_(at) * (fresnel / probability);
            result.pdf = probability;
            result.lobe = Lobe::specular;
        } else {
            result.wi = squareToCosineHemisphere(u);
            result.pdf = squareToCosineHemispherePdf(result.wi.z) * (1.f - probability);
            result.weight = base(at, fresnel, result.wi.z) / (1.f - probability);
            result.lobe = Lobe::diffuse;
        }
        if (!(result.pdf > 0.f) || isBlack(result.weight)) return std::nullopt;
        return result;
    }

    Color displayColor() const override { return diffuse_.mean(); }

  private:
    /// Albedo of the base as seen through the boundary, without the cosine density of a Lambertian surface.
    Color base(const SurfaceInteraction& at, float fresnelOut, float cosIn) const {
        const Color albedo = diffuse_(at);
        const Color bounces = (nonlinear_ ? albedo : Color(1.f)) * internalReflectance_;
        const float through = (1.f - fresnelOut) * (1.f - fresnelDielectric(cosIn, eta_).reflectance) * invEta2_;
        return albedo * through / (Color(1.f) - bounces);
    }

    float specularProbability(float fresnel) const {
        const float specular = fresnel * specularWeight_;
        const float sum = specular + (1.f - fresnel) * (1.f - specularWeight_);
        return sum > 0.f ? specular / sum : 0.f;
    }

    float eta_, invEta2_;
    float internalReflectance_;
    bool nonlinear_;
    float specularWeight_;
    ColorInput diffuse_, specular_;
};

}  // namespace

std::shared_ptr<Bsdf> makePlastic(PropertyReader& read, FactoryContext& context) {
    const float eta = readRelativeIor(read, "polypropylene", "air");
    ColorInput diffuse = readColor(read, context, "diffuse_reflectance", Color(0.5f));
    ColorInput specular = readColor(read, context, "specular_reflectance", Color(1.f));
    return std::make_shared<Plastic>(eta, std::move(diffuse), std::move(specular), read.flag("nonlinear", false));
}

}  // namespace emca::render
