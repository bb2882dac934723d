#include "bsdfs/bsdf_types.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/inputs.h"

namespace emca::render {

namespace {

/// Rough metal: Torrance and Sparrow's reflection of a microfacet surface (Walter et al. 2007, equation 20), without
/// scattering between facets. Its back is black.
class RoughConductor final : public Bsdf {
  public:
    RoughConductor(Roughness roughness, ConductorIor ior, ColorInput reflectance)
        : roughness_(std::move(roughness)), ior_(ior), reflectance_(std::move(reflectance)) {}

    Color eval(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override { return evalPdf(at, wo, wi).value; }
    float pdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return 0.f;
        const Vec3f m = normalize(wo + wi);
        const Microfacets facets = roughness_(at);
        return facets.density(m) * facets.maskingG1(wo, m) / (4.f * wo.z);
    }

    EvalPdf evalPdf(const SurfaceInteraction& at, Vec3f wo, Vec3f wi) const override {
        if (wo.z <= 0.f || wi.z <= 0.f) return {};
        const Vec3f m = normalize(wo + wi);
        const Microfacets facets = roughness_(at);
        // The density of visible normals, over the Jacobian 4 (wo.m) of the reflection.
        const float density = facets.density(m) * facets.maskingG1(wo, m) / (4.f * wo.z);
        if (!(density > 0.f)) return {};
        return {reflectance_(at) * fresnel(dot(wo, m)) * (density * facets.maskingG1(wi, m)), density};
    }

    std::optional<BsdfSample> sample(const SurfaceInteraction& at, Vec3f wo, float, Vec2f u) const override {
        if (wo.z <= 0.f) return std::nullopt;
        const Microfacets facets = roughness_(at);
        const Vec3f m = facets.sampleVisible(wo, u);
        BsdfSample result;
        result.wi = reflectAbout(wo, m);
        if (result.wi.z <= 0.f) return std::nullopt;
        result.pdf = facets.density(m) * facets.maskingG1(wo, m) / (4.f * wo.z);
        result.weight = reflectance_(at) * fresnel(dot(wo, m)) * facets.maskingG1(result.wi, m);
        result.event = Event::reflect;
        result.lobe = Lobe::glossy;
        if (!(result.pdf > 0.f) || isBlack(result.weight)) return std::nullopt;
        return result;
    }

    Color displayColor() const override { return reflectance_.mean() * fresnel(1.f); }

  private:
    Color fresnel(float cosine) const { return ior_.ideal ? Color(1.f) : fresnelConductor(cosine, ior_.eta, ior_.k); }

    Roughness roughness_;
    ConductorIor ior_;
    ColorInput reflectance_;
};

}  // namespace

std::shared_ptr<Bsdf> makeRoughConductor(PropertyReader& read, FactoryContext& context) {
    Roughness roughness = readRoughness(read, context);
    const ConductorIor ior = readConductorIor(read);
    return std::make_shared<RoughConductor>(std::move(roughness), ior,
                                            readColor(read, context, "specular_reflectance", Color(1.f)));
}

}  // namespace emca::render
