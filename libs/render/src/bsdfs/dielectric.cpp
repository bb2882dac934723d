#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Smooth boundary between two dielectrics. The normal points to the outer side.
class Dielectric final : public Bsdf {
  public:
    Dielectric(float eta, ColorInput reflectance, ColorInput transmittance)
        : eta_(eta), reflectance_(std::move(reflectance)), transmittance_(std::move(transmittance)) {}

    Color eval(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }
    float pdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return 0.f; }
    EvalPdf evalPdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f) const override {
        const DielectricFresnel fresnel = fresnelDielectric(wo.z, eta_);
        BsdfSample result;
        result.lobe = Lobe::specular;
        if (uLobe < fresnel.reflectance) {
            result.wi = reflectLocal(wo);
            result.weight = reflectance_(at);
            result.pdf = fresnel.reflectance;
            result.event = Event::reflect;
        } else {
            result.wi = refractLocal(wo, fresnel.cosTransmitted, eta_);
            result.pdf = 1.f - fresnel.reflectance;
            result.eta = fresnel.cosTransmitted < 0.f ? eta_ : 1.f / eta_;
            result.weight = transmittance_(at) * (1.f / square(result.eta));
            result.event = Event::transmit;
        }
        if (!(result.pdf > 0.f) || isBlack(result.weight)) return std::nullopt;
        return result;
    }

    bool isDelta() const override { return true; }
    Color displayColor() const override { return transmittance_.mean(); }

  private:
    float eta_;  ///< n(inner side) / n(outer side)
    ColorInput reflectance_, transmittance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeDielectric(PropertyReader& read, FactoryContext& context) {
    const float eta = readRelativeIor(read, "bk7", "air");
    return std::make_shared<Dielectric>(eta, readColor(read, context, "specular_reflectance", Color(1.f)),
                                        readColor(read, context, "specular_transmittance", Color(1.f)));
}

}  // namespace emca::render
