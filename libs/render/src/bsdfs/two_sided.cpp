#include "bsdfs/bsdf_types.h"

namespace emca::render {

namespace {

Vec3f mirrored(Vec3f v) { return {v.x, v.y, -v.z}; }

/// Gives the back of a reflecting surface a material: the front's, or another.
class TwoSided final : public Bsdf {
  public:
    /// \param back  null: `front` is seen from both sides as it is (for what transmits)
    TwoSided(std::shared_ptr<const Bsdf> front, std::shared_ptr<const Bsdf> back)
        : front_(std::move(front)), back_(std::move(back)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return isFront(wo) ? front_->eval(at, wo, wi) : back_->eval(at, mirrored(wo), mirrored(wi));
    }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return isFront(wo) ? front_->pdf(at, wo, wi) : back_->pdf(at, mirrored(wo), mirrored(wi));
    }
    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        return isFront(wo) ? front_->evalPdf(at, wo, wi) : back_->evalPdf(at, mirrored(wo), mirrored(wi));
    }
    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float uLobe, Vec2f u) const override {
        const bool front = isFront(wo);
        std::optional<BsdfSample> result =
            front ? front_->sample(at, wo, uLobe, u) : back_->sample(at, mirrored(wo), uLobe, u);
        if (result && !front) result->wi.z = -result->wi.z;
        return result;
    }

    bool isDelta() const override { return front_->isDelta() && (!back_ || back_->isDelta()); }
    float opacity(const SurfaceInteraction& at) const override { return front_->opacity(at); }
    Color displayColor() const override { return front_->displayColor(); }

  private:
    bool isFront(Vec3f wo) const { return wo.z > 0.f || !back_; }

    std::shared_ptr<const Bsdf> front_, back_;
};

bool transmits(const SceneNode& node) {
    if (node.type == "dielectric" || node.type == "thindielectric" || node.type == "roughdielectric" ||
        node.type == "mask" || node.type == "null" || node.type == "difftrans" || node.type == "hk") {
        return true;
    }
    for (const SceneNode::Child& child : node.children) {
        if (child.node->kind == "bsdf" && transmits(*child.node)) return true;
    }
    return false;
}

}  // namespace

std::shared_ptr<Bsdf> makeTwoSided(PropertyReader& read, FactoryContext& context) {
    const auto nested = read.childrenOfKind("bsdf");
    if (nested.empty()) {
        read.report(read.description() + " contains no material; a diffuse one takes its place.");
        return std::make_shared<TwoSided>(defaultBsdf(), defaultBsdf());
    }
    if (nested.size() > 2) {
        read.report(read.description() + " contains " + std::to_string(nested.size()) +
                    " materials; the first is the front, the second the back, the others are left out.");
    }
    std::shared_ptr<const Bsdf> front = makeBsdf(*nested[0], context);
    std::shared_ptr<const Bsdf> back = front;
    if (transmits(*nested[0])) {
        read.report(read.description() + " contains a " + nested[0]->type +
                    ", which lets light through and has two sides already; it is used as it is.");
        back = nullptr;
    } else if (nested.size() > 1) {
        back = makeBsdf(*nested[1], context);
    }
    std::shared_ptr<Bsdf> result = back == front ? makeTwoSidedDiffuse(*front) : nullptr;
    if (!result) result = std::make_shared<TwoSided>(front, back);
    if (read.node().id.empty() && !nested[0]->id.empty()) result->setName(front->name());
    return result;
}

}  // namespace emca::render
