#include <algorithm>

#include "bsdfs/bsdf_types.h"
#include "bsdfs/inputs.h"

namespace emca::render {

namespace {

/// A surface that is there only in part. Whether it is, the integrator decides by opacity(), before anything else;
/// scattering is that of the nested material.
class Mask final : public Bsdf {
  public:
    Mask(std::shared_ptr<const Bsdf> nested, NumberInput opacity)
        : nested_(std::move(nested)), opacity_(std::move(opacity)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return nested_->eval(at, wo, wi); }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return nested_->pdf(at, wo, wi); }
    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return nested_->evalPdf(at, wo, wi);
    }
    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        return nested_->sample(at, wo, uLobe, u);
    }

    bool isDelta() const override { return nested_->isDelta(); }
    float opacity(const SurfaceInteraction& at) const override {
        return std::clamp(opacity_(at), 0.f, 1.f) * nested_->opacity(at);
    }
    Color displayColor() const override { return nested_->displayColor(); }

  private:
    std::shared_ptr<const Bsdf> nested_;
    NumberInput opacity_;
};

NumberInput readOpacity(PropertyReader& read, FactoryContext& context) {
    if (read.hasChild("opacity")) return readNumber(read, context, "opacity", 0.5f);
    const Color color = read.color("opacity", Color(0.5f));
    if (color == Color(color.r)) return NumberInput(color.r);
    read.reportProperty("opacity", "is a colour; a surface is there or not for all colours alike, by the luminance.");
    return NumberInput(luminance(color));
}

}  // namespace

std::shared_ptr<Bsdf> makeMask(PropertyReader& read, FactoryContext& context) {
    NumberInput opacity = readOpacity(read, context);
    const auto node = read.firstOfKind("bsdf");
    if (!node) read.report(read.description() + " contains no material; a diffuse one takes its place.");
    std::shared_ptr<const Bsdf> nested = node ? makeBsdf(*node, context) : defaultBsdf();
    auto result = std::make_shared<Mask>(nested, std::move(opacity));
    if (node && read.node().id.empty() && !node->id.empty()) result->setName(nested->name());
    return result;
}

}  // namespace emca::render
