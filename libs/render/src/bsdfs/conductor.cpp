#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"

namespace emca::render {

namespace {

/// Smooth metal; its back is black.
class Conductor final : public Bsdf {
  public:
    Conductor(ConductorIor ior, ColorInput reflectance) : ior_(ior), reflectance_(std::move(reflectance)) {}

    Color eval(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }
    float pdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return 0.f; }
    EvalPdf evalPdf(const SurfaceInteraction&, Vec3f, Vec3f) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float, Vec2f) const override {
        if (wo.z <= 0.f) return std::nullopt;
        BsdfSample result;
        result.wi = reflectLocal(wo);
        result.weight = reflectance_(at) * fresnel(wo.z);
        result.pdf = 1.f;
        result.event = Event::reflect;
        result.lobe = Lobe::specular;
        if (isBlack(result.weight)) return std::nullopt;
        return result;
    }

    bool isDelta() const override { return true; }
    Color displayColor() const override { return reflectance_.mean() * fresnel(1.f); }

  private:
    Color fresnel(float cosine) const { return ior_.ideal ? Color(1.f) : fresnelConductor(cosine, ior_.eta, ior_.k); }

    ConductorIor ior_;
    ColorInput reflectance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeConductor(PropertyReader& read, FactoryContext& context) {
    const ConductorIor ior = readConductorIor(read);
    return std::make_shared<Conductor>(ior, readColor(read, context, "specular_reflectance", Color(1.f)));
}

}  // namespace emca::render
