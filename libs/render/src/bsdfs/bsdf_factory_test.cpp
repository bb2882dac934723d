#include "emca/render/bsdf_factory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "testing/bsdf_cases.h"
#include "testing/chi_square.h"

namespace emca::render {
namespace {

using testing::bsdfNode;
using ::testing::HasSubstr;
using testing::made;
using testing::node;

struct Made {
    std::shared_ptr<const Bsdf> bsdf;
    std::vector<Diagnostic> diagnostics;
};

Made makeWithDiagnostics(const std::shared_ptr<SceneNode>& from) {
    Made result;
    FactoryContext context{result.diagnostics, {}};
    result.bsdf = makeBsdf(*from, context);
    return result;
}

Color reflected(const Bsdf& bsdf) {
    const Vec3f up{0, 0, 1};
    return bsdf.eval({}, up, up);
}

constexpr float kInvPiHere = 0.318309886f;

TEST(BsdfFactory, DefaultsAreThoseOfSceneFiles) {
    EXPECT_NEAR(reflected(*made(bsdfNode("diffuse"))).g, 0.5f * kInvPiHere, 1e-6f);
    const auto glass = made(bsdfNode("dielectric"))->sample({}, {0, 0, 1}, 0.5f, {});
    ASSERT_TRUE(glass);
    EXPECT_NEAR(glass->eta, 1.5046f / 1.000277f, 1e-6f);
    EXPECT_EQ(glass->event, Event::transmit);
    EXPECT_EQ(glass->lobe, Lobe::specular);
    EXPECT_NEAR(glass->weight.g, 1.f / (glass->eta * glass->eta), 1e-6f)
        << "radiance shrinks by eta^2 towards the eye outside";
    const auto metal = made(bsdfNode("conductor"))->sample({}, {0, 0, 1}, 0.5f, {});
    ASSERT_TRUE(metal);
    EXPECT_GT(metal->weight.r, metal->weight.b + 0.2f) << "copper";
}

TEST(BsdfFactory, NamesComeFromTheSceneFile) {
    auto named = bsdfNode("diffuse");
    named->id = "Floor";
    EXPECT_EQ(made(named)->name(), "Floor");
    EXPECT_EQ(made(bsdfNode("diffuse"))->name(), "diffuse");
    EXPECT_EQ(made(bsdfNode("twosided", {}, {{"", named}}))->name(), "Floor");
}

TEST(BsdfFactory, SharedNodesAreSharedMaterials) {
    const auto shared = bsdfNode("diffuse");
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    EXPECT_EQ(makeBsdf(*shared, context), makeBsdf(*shared, context));
    EXPECT_NE(makeBsdf(*bsdfNode("diffuse"), context), makeBsdf(*shared, context));
}

TEST(BsdfFactory, UnknownTypesAreNamedAndReplaced) {
    const Made phong =
        makeWithDiagnostics(bsdfNode("phong", {{"diffuse_reflectance", Color(0.1f, 0.2f, 0.3f)}, {"exponent", 30.0}}));
    ASSERT_EQ(phong.diagnostics.size(), 1u);
    EXPECT_THAT(phong.diagnostics[0].message, HasSubstr("phong"));
    EXPECT_EQ(phong.diagnostics[0].where.text(), "scene.xml:7");
    EXPECT_NEAR(reflected(*phong.bsdf).b, 0.3f * kInvPiHere, 1e-6f);

    const auto inner = bsdfNode("diffuse", {{"reflectance", 0.25}});
    const Made bump = makeWithDiagnostics(bsdfNode("bumpmap", {}, {{"", node("texture", "bitmap")}, {"", inner}}));
    ASSERT_EQ(bump.diagnostics.size(), 1u);
    EXPECT_THAT(bump.diagnostics[0].message, HasSubstr("bumpmap"));
    EXPECT_NEAR(reflected(*bump.bsdf).g, 0.25f * kInvPiHere, 1e-6f);

    const Made odd = makeWithDiagnostics(bsdfNode("wood"));
    ASSERT_EQ(odd.diagnostics.size(), 1u);
    EXPECT_GT(reflected(*odd.bsdf).g, 0.f);
}

TEST(BsdfFactory, UnknownPropertiesAndValuesAreReported) {
    const auto messageOf = [](const std::shared_ptr<SceneNode>& from) {
        const Made found = makeWithDiagnostics(from);
        EXPECT_EQ(found.diagnostics.size(), 1u) << from->type;
        EXPECT_TRUE(found.bsdf);
        return found.diagnostics.empty() ? std::string() : found.diagnostics[0].message;
    };
    EXPECT_THAT(messageOf(bsdfNode("diffuse", {{"colour", 0.3}})), HasSubstr("colour"));
    EXPECT_THAT(messageOf(bsdfNode("diffuse", {{"reflectance", 1.5}})), HasSubstr("reflectance"));
    EXPECT_THAT(messageOf(bsdfNode("dielectric", {{"int_ior", std::string("jelly")}})), HasSubstr("jelly"));
    EXPECT_THAT(messageOf(bsdfNode("dielectric", {{"int_ior", -1.0}})), HasSubstr("int_ior"));
    EXPECT_THAT(messageOf(bsdfNode("conductor", {{"material", std::string("Unobtainium")}})), HasSubstr("Unobtainium"));
    EXPECT_THAT(messageOf(bsdfNode("roughconductor", {{"distribution", std::string("phong")}})), HasSubstr("phong"));
    EXPECT_THAT(messageOf(bsdfNode("roughconductor", {{"alpha", 0.0}})), HasSubstr("alpha"));
    EXPECT_THAT(messageOf(bsdfNode("twosided")), HasSubstr("twosided"));
    EXPECT_THAT(messageOf(bsdfNode("mask", {{"opacity", 0.5}})), HasSubstr("mask"));
    EXPECT_THAT(messageOf(bsdfNode("twosided", {}, {{"", bsdfNode("dielectric")}})), HasSubstr("dielectric"));
    EXPECT_THAT(messageOf(bsdfNode("roughdielectric", {{"int_ior", 1.3}, {"ext_ior", 1.3}})), HasSubstr("straight"));
}

TEST(BsdfFactory, ConductorsTakeTheirIndexInAnyForm) {
    const auto byName = made(bsdfNode("conductor", {{"material", std::string("Au")}}));
    const auto byNumbers = made(
        bsdfNode("conductor", {{"eta", Color(0.1431f, 0.3750f, 1.4425f)}, {"k", Color(3.9832f, 2.3857f, 1.6032f)}}));
    const auto grey = made(bsdfNode("conductor", {{"eta", 1.5}, {"k", 0.0}, {"ext_eta", 1.0}}));
    const Vec3f up{0, 0, 1};
    EXPECT_EQ(byName->sample({}, up, 0.f, {})->weight, byNumbers->sample({}, up, 0.f, {})->weight);
    EXPECT_NEAR(grey->sample({}, up, 0.f, {})->weight.g, 0.04f, 1e-6f);
}

TEST(BsdfFactory, TwoSidedMaterialsHaveTwoSides) {
    const auto one = made(bsdfNode("diffuse"));
    const auto both = made(bsdfNode("twosided", {}, {{"", bsdfNode("diffuse")}}));
    const auto two =
        made(bsdfNode("twosided", {}, {{"", bsdfNode("diffuse")}, {"", bsdfNode("diffuse", {{"reflectance", 0.1}})}}));
    const Vec3f down{0, 0, -1};
    EXPECT_TRUE(isBlack(one->eval({}, down, down)));
    EXPECT_EQ(both->eval({}, down, down), reflected(*one));
    EXPECT_NEAR(two->eval({}, down, down).g, 0.1f * kInvPiHere, 1e-6f);
    EXPECT_NEAR(reflected(*two).g, 0.5f * kInvPiHere, 1e-6f);
    EXPECT_TRUE(isBlack(both->eval({}, down, {0, 0, 1}))) << "nothing goes through";
}

TEST(BsdfFactory, LobesAreLabelled) {
    const Vec3f up{0, 0, 1};
    const auto label = [&](const std::shared_ptr<SceneNode>& from, float uLobe) {
        const auto sample = made(from)->sample({}, up, uLobe, {0.4f, 0.4f});
        return sample ? std::pair(sample->event, sample->lobe) : std::pair(Event::none, Lobe::none);
    };
    EXPECT_EQ(label(bsdfNode("diffuse"), 0.5f), std::pair(Event::reflect, Lobe::diffuse));
    EXPECT_EQ(label(bsdfNode("plastic"), 0.f), std::pair(Event::reflect, Lobe::specular));
    EXPECT_EQ(label(bsdfNode("plastic"), 0.99f), std::pair(Event::reflect, Lobe::diffuse));
    EXPECT_EQ(label(bsdfNode("roughplastic"), 0.f), std::pair(Event::reflect, Lobe::glossy));
    EXPECT_EQ(label(bsdfNode("roughplastic"), 0.99f), std::pair(Event::reflect, Lobe::diffuse));
    EXPECT_EQ(label(bsdfNode("roughdielectric"), 0.99f), std::pair(Event::transmit, Lobe::glossy));
    EXPECT_EQ(label(bsdfNode("thindielectric"), 0.99f), std::pair(Event::transmit, Lobe::straight));
}

/// The mask's share is in opacity() alone: what is there scatters as if there were no mask.
TEST(BsdfFactory, MaskHasAnOpacity) {
    const auto mask = made(bsdfNode("mask", {{"opacity", 0.3}}, {{"", bsdfNode("diffuse")}}));
    EXPECT_FLOAT_EQ(mask->opacity({}), 0.3f);
    EXPECT_EQ(reflected(*mask), reflected(*made(bsdfNode("diffuse"))));
    EXPECT_EQ(made(bsdfNode("diffuse"))->opacity({}), 1.f);
    EXPECT_EQ(made(bsdfNode("mask", {{"opacity", 1.0}}, {{"", bsdfNode("diffuse")}}))->opacity({}), 1.f);
    EXPECT_FLOAT_EQ(made(bsdfNode("twosided", {}, {{"", bsdfNode("diffuse")}}))->opacity({}), 1.f);

    const auto board = node("texture", "checkerboard", {{"color0", Color(1.f)}, {"color1", Color(0.f)}});
    const auto holes = made(bsdfNode("mask", {}, {{"opacity", board}, {"", bsdfNode("diffuse")}}));
    SurfaceInteraction at;
    at.barycentrics = {0.25f, 0.25f};
    EXPECT_EQ(holes->opacity(at), 1.f);
    at.barycentrics = {0.75f, 0.25f};
    EXPECT_EQ(holes->opacity(at), 0.f);

    const Made coloured =
        makeWithDiagnostics(bsdfNode("mask", {{"opacity", Color(1.f, 0.f, 0.f)}}, {{"", bsdfNode("diffuse")}}));
    ASSERT_EQ(coloured.diagnostics.size(), 1u);
    EXPECT_NEAR(coloured.bsdf->opacity({}), 0.2126f, 1e-6f);
}

}  // namespace
}  // namespace emca::render
