#include "testing/bsdf_cases.h"

#include <gtest/gtest.h>

namespace emca::render::testing {

std::shared_ptr<const Bsdf> made(const std::shared_ptr<SceneNode>& node) {
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    auto result = makeBsdf(*node, context);
    for (const Diagnostic& diagnostic : diagnostics) ADD_FAILURE() << diagnostic.message;
    return result;
}

const std::vector<BsdfCase>& scatteringBsdfs() {
    static const std::vector<BsdfCase> cases = [] {
        std::vector<BsdfCase> list;
        const auto add = [&list](std::string name, const std::shared_ptr<SceneNode>& what, bool transmits = false) {
            list.push_back({std::move(name), made(what), transmits});
        };
        add("diffuse", bsdfNode("diffuse", {{"reflectance", Color(0.2f, 0.5f, 0.9f)}}));
        for (const char* distribution : {"beckmann", "ggx"}) {
            const std::string d = distribution;
            for (const double alpha : {0.05, 0.3, 0.8}) {
                const std::string suffix = " " + d + " " + std::to_string(alpha).substr(0, 4);
                add("roughconductor" + suffix, bsdfNode("roughconductor", {{"alpha", alpha}, {"distribution", d}}));
                add("roughdielectric" + suffix, bsdfNode("roughdielectric", {{"alpha", alpha}, {"distribution", d}}),
                    true);
            }
            add("roughconductor anisotropic " + d,
                bsdfNode("roughconductor",
                         {{"alpha_u", 0.1}, {"alpha_v", 0.5}, {"distribution", d}, {"material", std::string("Au")}}));
            add("roughdielectric anisotropic " + d,
                bsdfNode("roughdielectric",
                         {{"alpha_u", 0.4}, {"alpha_v", 0.15}, {"distribution", d}, {"int_ior", std::string("water")}}),
                true);
            add("roughplastic " + d,
                bsdfNode("roughplastic",
                         {{"alpha", 0.2}, {"distribution", d}, {"diffuse_reflectance", Color(0.1f, 0.3f, 0.7f)}}));
        }
        add("roughplastic nonlinear", bsdfNode("roughplastic", {{"alpha", 0.5}, {"nonlinear", true}}));
        add("plastic", bsdfNode("plastic", {{"diffuse_reflectance", Color(0.7f, 0.2f, 0.1f)}}));
        add("plastic nonlinear", bsdfNode("plastic", {{"nonlinear", true}, {"int_ior", 1.9}}));
        add("twosided", bsdfNode("twosided", {}, {{"", bsdfNode("roughconductor", {{"alpha", 0.4}})}}));
        add("twosided with two",
            bsdfNode("twosided", {}, {{"", bsdfNode("diffuse")}, {"", bsdfNode("roughplastic", {{"alpha", 0.3}})}}));
        add("mask", bsdfNode("mask", {{"opacity", 0.6}},
                             {{"", bsdfNode("roughconductor", {{"alpha", 0.4}, {"material", std::string("Al")}})}}));
        return list;
    }();
    return cases;
}

const std::vector<BsdfCase>& allBsdfs() {
    static const std::vector<BsdfCase> cases = [] {
        std::vector<BsdfCase> list = scatteringBsdfs();
        const auto add = [&list](std::string name, const std::shared_ptr<SceneNode>& what, bool transmits) {
            list.push_back({std::move(name), made(what), transmits});
        };
        add("dielectric", bsdfNode("dielectric"), true);
        add("dielectric, rarer inside",
            bsdfNode("dielectric", {{"int_ior", std::string("air")}, {"ext_ior", std::string("water")}}), true);
        add("dielectric without boundary", bsdfNode("dielectric", {{"int_ior", 1.2}, {"ext_ior", 1.2}}), true);
        add("thindielectric", bsdfNode("thindielectric"), true);
        add("conductor", bsdfNode("conductor", {{"material", std::string("Ag")}}), false);
        add("conductor none", bsdfNode("conductor", {{"material", std::string("none")}}), false);
        add("mask of glass", bsdfNode("mask", {{"opacity", 0.2}}, {{"", bsdfNode("dielectric")}}), true);
        add("roughconductor, nearly smooth",
            bsdfNode("roughconductor", {{"alpha", 1e-4}, {"distribution", std::string("ggx")}}), false);
        add("roughdielectric, nearly smooth", bsdfNode("roughdielectric", {{"alpha", 1e-4}}), true);
        return list;
    }();
    return cases;
}

}  // namespace emca::render::testing
