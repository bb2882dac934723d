#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"

namespace emca::render {

namespace {

/// A pane too thin to bend light: both boundaries, with all reflections between them, at one surface.
class ThinDielectric final : public Bsdf {
  public:
    ThinDielectric(float eta, ColorInput reflectance, ColorInput transmittance)
        : eta_(eta), reflectance_(std::move(reflectance)), transmittance_(std::move(transmittance)) {}

    Color eval(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }
    float pdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return 0.f; }
    EvalPdf evalPdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f) const override {
        // Light from either side enters from outside: R + T R T + T R^3 T + … = 2R / (1 + R) with T = 1 - R.
        const float once = fresnelDielectric(std::abs(wo.z), eta_).reflectance;
        const float reflected = once < 1.f ? 2.f * once / (1.f + once) : 1.f;
        BsdfSample result;
        if (uLobe < reflected) {
            result.wi = reflectLocal(wo);
            result.weight = reflectance_(at);
            result.pdf = reflected;
            result.event = Event::reflect;
            result.lobe = Lobe::specular;
        } else {
            result.wi = -wo;
            result.weight = transmittance_(at);
            result.pdf = 1.f - reflected;
            result.event = Event::transmit;
            result.lobe = Lobe::straight;
        }
        if (!(result.pdf > 0.f) || isBlack(result.weight)) return std::nullopt;
        return result;
    }

    bool isDelta() const override { return true; }
    Color displayColor() const override { return transmittance_.mean(); }

  private:
    float eta_;  ///< n(pane) / n(outside)
    ColorInput reflectance_, transmittance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeThinDielectric(PropertyReader& read, FactoryContext& context) {
    const float eta = readRelativeIor(read, "bk7", "air");
    return std::make_shared<ThinDielectric>(eta, readColor(read, context, "specular_reflectance", Color(1.f)),
                                            readColor(read, context, "specular_transmittance", Color(1.f)));
}

}  // namespace emca::render
