#include "bsdfs/bsdf_types.h"
#include "bsdfs/inputs.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Lambert's law on the side of the normal; the other side is black.
class Diffuse final : public Bsdf {
  public:
    explicit Diffuse(ColorInput reflectance) : reflectance_(std::move(reflectance)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return {};
        return reflectance_(at) * (kInvPi * wi.z);
    }

    float pdf(const SurfaceInteraction&, Vec3f wo, Vec3f wi) const override {
        return wo.z > 0.f ? squareToCosineHemispherePdf(wi.z) : 0.f;
    }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return {};
        const float density = squareToCosineHemispherePdf(wi.z);
        return {reflectance_(at) * density, density};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float, Vec2f u) const override {
        std::optional<BsdfSample> result;  // returned everywhere, so that it is made in place
        if (wo.z <= 0.f) return result;
        BsdfSample& sample = result.emplace();
        sample.wi = squareToCosineHemisphere(u);
        sample.pdf = squareToCosineHemispherePdf(sample.wi.z);
        sample.weight = reflectance_(at);
        sample.event = Event::reflect;
        sample.lobe = Lobe::diffuse;
        if (!(sample.pdf > 0.f) || isBlack(sample.weight)) result.reset();
        return result;
    }

    Color displayColor() const override { return reflectance_.mean(); }

  private:
    ColorInput reflectance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeDiffuse(PropertyReader& read, FactoryContext& context) {
    return std::make_shared<Diffuse>(readColor(read, context, "reflectance", Color(0.5f)));
}

std::shared_ptr<Bsdf> makeDiffuse(Color reflectance) { return std::make_shared<Diffuse>(ColorInput(reflectance)); }

}  // namespace emca::render
