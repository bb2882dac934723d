#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "bsdfs/microfacets.h"
#include "emca/render/bsdf_factory.h"
#include "emca/render/property_reader.h"

namespace emca::render {

/// A colour parameter of a BSDF: a constant, read without a virtual call, or a texture.
class ColorInput {
  public:
    explicit ColorInput(Color constant) : constant_(constant) {}
    explicit ColorInput(std::shared_ptr<const Texture> texture) {
        if (texture->isConstant()) constant_ = texture->mean();
        else texture_ = std::move(texture);
    }
    Color operator()(const SurfaceInteraction& at) const { return texture_ ? texture_->eval(at.uv()) : constant_; }
    Color mean() const { return texture_ ? texture_->mean() : constant_; }
    bool isConstant() const { return !texture_; }

  private:
    std::shared_ptr<const Texture> texture_;
    Color constant_;
};

/// A number parameter likewise; a texture counts by its luminance.
class NumberInput {
  public:
    explicit NumberInput(float constant) : constant_(constant) {}
    explicit NumberInput(std::shared_ptr<const Texture> texture) {
        if (texture->isConstant()) constant_ = luminance(texture->mean());
        else texture_ = std::move(texture);
    }
    float operator()(const SurfaceInteraction& at) const { return texture_ ? texture_->evalScalar(at.uv()) : constant_; }
    float mean() const { return texture_ ? luminance(texture_->mean()) : constant_; }
    bool isConstant() const { return !texture_; }

  private:
    std::shared_ptr<const Texture> texture_;
    float constant_ = 0;
};

/// The roughness parameters that all rough materials share: distribution, and alpha or alpha_u and alpha_v.
struct Roughness {
    Microfacets::Type type = Microfacets::Type::beckmann;
    NumberInput alphaU{0.1f}, alphaV{0.1f};
    Microfacets operator()(const SurfaceInteraction& at) const { return {type, alphaU(at), alphaV(at)}; }
};

/// Parameter `name`, a colour or a texture. Reflectances above 1, which would make light, get a diagnostic.
ColorInput readColor(PropertyReader& read, FactoryContext& context, std::string_view name, Color fallback);
NumberInput readNumber(PropertyReader& read, FactoryContext& context, std::string_view name, float fallback);
Roughness readRoughness(PropertyReader& read, FactoryContext& context);

/// int_ior / ext_ior, numbers or names of media, as relative index n(inside) / n(outside).
/// \param inside, outside  names of the media that are meant if the scene file says nothing
float readRelativeIor(PropertyReader& read, std::string_view inside, std::string_view outside);

/// A conductor's index relative to the medium outside, per channel.
struct ConductorIor {
    Color eta, k;
    bool ideal = false;  ///< material "none": reflects everything
};
/// material, or eta and k, and ext_eta.
ConductorIor readConductorIor(PropertyReader& read);

}  // namespace emca::render
