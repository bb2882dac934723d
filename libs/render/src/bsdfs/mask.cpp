#include <algorithm>

#include "bsdfs/bsdf_types.h"
#include "bsdfs/inputs.h"

namespace emca::render {

namespace {

Color clamped(Color c) {
    return {std::clamp(c.r, 0.f, 1.f), std::clamp(c.g, 0.f, 1.f), std::clamp(c.b, 0.f, 1.f)};
}

/// A surface that is there only in part: light meets the nested material with the opacity's share, and else goes
/// straight through. The choice is by the opacity's luminance, the weights are per channel.
class Mask final : public Bsdf {
  public:
    Mask(std::shared_ptr<const Bsdf> nested, ColorInput opacity) : nested_(std::move(nested)), opacity_(std::move(opacity)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return nested_->eval(at, wo, wi) * clamped(opacity_(at));
    }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return nested_->pdf(at, wo, wi) * opacity(at);
    }
    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        const Color opacity = clamped(opacity_(at));
        const EvalPdf inside = nested_->evalPdf(at, wo, wi);
        return {inside.value * opacity, inside.pdf * probability(opacity)};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        const Color opacity = clamped(opacity_(at));
        const float there = probability(opacity);
        if (uLobe < there) {
            // What is left of uLobe below the opacity is again uniform.
            std::optional<BsdfSample> result = nested_->sample(at, wo, std::min(uLobe / there, 0x1.fffffep-1f), u);
            if (result) {
                result->pdf *= there;
                result->weight *= opacity / there;
            }
            return result;
        }
        BsdfSample result;
        result.wi = -wo;
        result.pdf = 1.f - there;
        result.weight = (Color(1.f) - opacity) / result.pdf;
        result.event = Event::pass;
        result.lobe = Lobe::straight;
        return result;
    }

    bool isDelta() const override { return nested_->isDelta(); }
    float opacity(const SurfaceInteraction& at) const override { return probability(clamped(opacity_(at))) * nested_->opacity(at); }
    Color displayColor() const override { return nested_->displayColor(); }

  private:
    /// Luminance, so that white is 1 to the last bit.
    static float probability(Color opacity) {
        return opacity == Color(1.f) ? 1.f : std::clamp(luminance(opacity), 0.f, 1.f);
    }

    std::shared_ptr<const Bsdf> nested_;
    ColorInput opacity_;
};

}  // namespace

std::shared_ptr<Bsdf> makeMask(PropertyReader& read, FactoryContext& context) {
    ColorInput opacity = readColor(read, context, "opacity", Color(0.5f));
    const auto node = read.firstOfKind("bsdf");
    if (!node) read.report(read.description() + " contains no material; a diffuse one takes its place.");
    std::shared_ptr<const Bsdf> nested = node ? makeBsdf(*node, context) : defaultBsdf();
    auto result = std::make_shared<Mask>(nested, std::move(opacity));
    if (node && read.node().id.empty() && !node->id.empty()) result->setName(nested->name());
    return result;
}

}  // namespace emca::render
