#include "bsdfs/inputs.h"

#include <string>

#include "bsdfs/media_ior.h"

namespace emca::render {

ColorInput readColor(PropertyReader& read, FactoryContext& context, std::string_view name, Color fallback) {
    if (const auto node = read.child(name)) return ColorInput(makeTexture(*node, context));
    const Color value = read.color(name, fallback);
    if (maxComponent(value) > 1.f) read.reportProperty(name, "is above 1: this surface makes light out of nothing.");
    return ColorInput(value);
}

NumberInput readNumber(PropertyReader& read, FactoryContext& context, std::string_view name, float fallback) {
    if (const auto node = read.child(name)) return NumberInput(makeTexture(*node, context));
    return NumberInput(static_cast<float>(read.number(name, static_cast<double>(fallback))));
}

Roughness readRoughness(PropertyReader& read, FactoryContext& context) {
    Roughness result;
    const std::string distribution = read.text("distribution", "beckmann");
    if (const auto type = microfacetType(distribution)) {
        result.type = *type;
    } else {
        // "phong" and "as" (Ashikhmin and Shirley) are the other two that scene files may name.
        read.reportProperty("distribution", "is \"" + distribution +
                                                "\", which is neither beckmann nor ggx; beckmann takes its place.");
    }
    const NumberInput alpha = readNumber(read, context, "alpha", 0.1f);
    result.alphaU = readNumber(read, context, "alpha_u", 0.f);
    result.alphaV = readNumber(read, context, "alpha_v", 0.f);
    if (!read.hasProperty("alpha_u") && !read.hasChild("alpha_u")) result.alphaU = alpha;
    if (!read.hasProperty("alpha_v") && !read.hasChild("alpha_v")) result.alphaV = alpha;
    for (const char* name : {"alpha", "alpha_u", "alpha_v"}) {
        const auto value = read.number(name);
        if (value && !(*value > 0.0 && *value <= 10.0)) {
            read.reportProperty(name,
                                "is " + std::to_string(*value) +
                                    ", but a roughness is above 0 and rarely above 1; the nearest possible is used.");
        }
    }
    read.ignore("sample_visible");  // always
    return result;
}

float readRelativeIor(PropertyReader& read, std::string_view inside, std::string_view outside) {
    const auto one = [&read](std::string_view name, std::string_view fallback) {
        double ior = *mediumIor(fallback);
        if (!read.hasProperty(name)) return ior;
        const auto& value = read.node().properties.find(std::string(name))->second.value;
        if (const auto* text = std::get_if<std::string>(&value)) {
            read.ignore(name);
            if (const auto known = mediumIor(*text)) {
                ior = *known;
            } else {
                read.reportProperty(name, "is \"" + *text + "\", a medium that is not known here; " +
                                              std::string(fallback) + " takes its place.");
            }
        } else {
            ior = read.number(name, ior);
        }
        if (!(ior > 0.0 && ior < 100.0)) {
            read.reportProperty(name, "is " + std::to_string(ior) + ", but an index of refraction is positive; " +
                                          std::string(fallback) + " takes its place.");
            ior = *mediumIor(fallback);
        }
        return ior;
    };
    return static_cast<float>(one("int_ior", inside) / one("ext_ior", outside));
}

ConductorIor readConductorIor(PropertyReader& read) {
    ConductorIor result;
    const std::string material = read.text("material", "Cu");
    if (material == "none") {
        result.ideal = true;
        return result;
    }
    auto metal = metalIor(material);
    if (!metal) {
        read.reportProperty("material",
                            "is \"" + material + "\", a conductor that is not known here; Cu takes its place.");
        metal = metalIor("Cu");
    }
    result.eta = read.color("eta", metal->eta);
    result.k = read.color("k", metal->k);

    double outside = *mediumIor("air");
    if (read.hasProperty("ext_eta")) {
        const auto& value = read.node().properties.find("ext_eta")->second.value;
        if (const auto* text = std::get_if<std::string>(&value)) {
            read.ignore("ext_eta");
            if (const auto known = mediumIor(*text)) {
                outside = *known;
            } else {
                read.reportProperty("ext_eta",
                                    "is \"" + *text + "\", a medium that is not known here; air takes its place.");
            }
        } else {
            outside = read.number("ext_eta", outside);
        }
        if (!(outside > 0.0)) {
            read.reportProperty("ext_eta", "is not positive; air takes its place.");
            outside = *mediumIor("air");
        }
    }
    result.eta = result.eta / static_cast<float>(outside);
    result.k = result.k / static_cast<float>(outside);
    return result;
}

}  // namespace emca::render
