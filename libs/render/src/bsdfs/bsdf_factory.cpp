#include "emca/render/bsdf_factory.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bsdfs/bsdf_types.h"

namespace emca::render {

namespace {

using Maker = std::shared_ptr<Bsdf> (*)(PropertyReader&, FactoryContext&);

constexpr std::array<std::pair<std::string_view, Maker>, 10> kMakers = {{
    {"diffuse", makeDiffuse},
    {"dielectric", makeDielectric},
    {"thindielectric", makeThinDielectric},
    {"roughdielectric", makeRoughDielectric},
    {"conductor", makeConductor},
    {"roughconductor", makeRoughConductor},
    {"plastic", makePlastic},
    {"roughplastic", makeRoughPlastic},
    {"twosided", makeTwoSided},
    {"mask", makeMask},
}};

/// What stands in for a material that is not known: the first nested one (bumpmap, normalmap, blendbsdf, coating), else
/// a diffuse one with the colour that the node gives.
std::shared_ptr<const Bsdf> replacement(PropertyReader& read, FactoryContext& context) {
    const auto nested = read.childrenOfKind("bsdf");
    if (!nested.empty()) {
        read.report(read.description() + " is not supported; the material inside it, " + nested[0]->type +
                    ", is used without it.");
        return makeBsdf(*nested[0], context);
    }
    Color reflectance(0.5f);
    for (const char* name : {"reflectance", "diffuse_reflectance", "base_color", "color"}) {
        if (const auto texture = read.child(name)) {
            reflectance = makeTexture(*texture, context)->mean();
            break;
        }
        if (read.hasProperty(name)) {
            reflectance = read.color(name, reflectance);
            break;
        }
    }
    read.report(read.description() + " is not supported; a diffuse material takes its place.");
    std::shared_ptr<Bsdf> diffuse = makeDiffuse(reflectance);
    diffuse->setName(read.node().id.empty() ? read.type() : read.node().id);
    return diffuse;
}

}  // namespace

std::shared_ptr<const Bsdf> makeBsdf(const SceneNode& node, FactoryContext& context) {
    if (const auto known = context.bsdfs.find(&node); known != context.bsdfs.end()) return known->second;

    PropertyReader read(node, context.diagnostics, context.searchFolders);
    const auto maker =
        std::find_if(kMakers.begin(), kMakers.end(), [&](const auto& m) { return m.first == node.type; });
    std::shared_ptr<const Bsdf> result;
    if (maker == kMakers.end()) {
        result = replacement(read, context);
    } else {
        std::shared_ptr<Bsdf> made = maker->second(read, context);
        if (made->name().empty()) made->setName(node.id.empty() ? node.type : node.id);
        read.reportUnused();
        result = std::move(made);
    }
    context.bsdfs.emplace(&node, result);
    return result;
}

std::shared_ptr<const Bsdf> defaultBsdf() {
    std::shared_ptr<Bsdf> result = makeDiffuse(Color(0.5f));
    result->setName("diffuse");
    return result;
}

}  // namespace emca::render
