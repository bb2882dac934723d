#include <cmath>

#include "bsdfs/bsdf_types.h"
#include "bsdfs/inputs.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

/// Lambert's law on the side of the normal; the other side is black, or the same if the material has two sides.
class Diffuse final : public Bsdf {
  public:
    explicit Diffuse(ColorInput reflectance, bool twoSided = false)
        : reflectance_(std::move(reflectance)), twoSided_(twoSided) {}

    const ColorInput& reflectance() const { return reflectance_; }

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return evalPdf(at, wo, wi).value;
    }

    float pdf(const SurfaceInteraction&, Vec3f wo, Vec3f wi) const override {
        const float front = side(wo);
        return wo.z * front > 0.f ? squareToCosineHemispherePdf(wi.z * front) : 0.f;
    }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        const float front = side(wo);
        if (wo.z * front <= 0.f || wi.z * front <= 0.f) return {};
        const float density = squareToCosineHemispherePdf(wi.z * front);
        return {reflectance_(at) * density, density};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float, Vec2f u) const override {
        std::optional<BsdfSample> result;  // returned everywhere, so that it is made in place
        const float front = side(wo);
        if (wo.z * front <= 0.f) return result;
        BsdfSample& sample = result.emplace();
        sample.wi = squareToCosineHemisphere(u);
        sample.pdf = squareToCosineHemispherePdf(sample.wi.z);
        sample.weight = reflectance_(at);
        sample.event = Event::reflect;
        sample.lobe = Lobe::diffuse;
        sample.wi.z *= front;
        if (!(sample.pdf > 0.f) || isBlack(sample.weight)) result.reset();
        return result;
    }

    Color displayColor() const override { return reflectance_.mean(); }

  private:
    /// Sign of z on the side that is lit.
    float side(Vec3f wo) const { return twoSided_ ? std::copysign(1.f, wo.z) : 1.f; }

    ColorInput reflectance_;
    bool twoSided_;
};

}  // namespace

std::shared_ptr<Bsdf> makeDiffuse(PropertyReader& read, FactoryContext& context) {
    return std::make_shared<Diffuse>(readColor(read, context, "reflectance", Color(0.5f)));
}

std::shared_ptr<Bsdf> makeTwoSidedDiffuse(const Bsdf& front) {
    const auto* diffuse = dynamic_cast<const Diffuse*>(&front);
    return diffuse ? std::make_shared<Diffuse>(diffuse->reflectance(), true) : nullptr;
}

std::shared_ptr<Bsdf> makeDiffuse(Color reflectance) { return std::make_shared<Diffuse>(ColorInput(reflectance)); }

}  // namespace emca::render
