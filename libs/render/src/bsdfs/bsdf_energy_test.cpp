#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "emca/render/sampling_functions.h"
#include "testing/bsdf_cases.h"
#include "testing/chi_square.h"

namespace emca::render {
namespace {

using testing::BsdfCase;
using testing::bsdfNode;
using testing::made;
using testing::TestRandom;

constexpr int kSamples = 20'000;

/// Share of the light from wo's side that leaves again, as energy: radiance that changes medium is scaled by eta^2,
/// which is undone here. \param onlyScattered  leave out delta lobes
Color albedo(const Bsdf& bsdf, Vec3f wo, bool onlyScattered = false) {
    const SurfaceInteraction at;
    TestRandom random(5);
    Color sum;
    for (int i = 0; i < kSamples; ++i) {
        const float uLobe = (static_cast<float>(i) + 0.5f) / kSamples;  // strata over the lobes: little noise
        const auto sample = bsdf.sample(at, wo, uLobe, random.next2());
        if (!sample || (onlyScattered && sample->isDelta())) continue;
        sum += sample->weight * square(sample->eta);
    }
    return sum / static_cast<float>(kSamples);
}

std::shared_ptr<const Bsdf> withTexture(const char* type, const char* name, double value, double alpha = 0.3) {
    return made(bsdfNode(type, {{name, value}, {"alpha", alpha}}));
}

TEST(BsdfEnergy, NothingReflectsMoreThanItReceives) {
    for (const BsdfCase& c : testing::allBsdfs()) {
        for (const double theta : {0.0, 0.5, 1.0, 1.4, 1.55, 2.0, 3.0}) {
            const Color found = albedo(*c.bsdf, testing::directionOf(theta, 1.0));
            EXPECT_LE(maxComponent(found), 1.003f) << c.name << " at " << theta;
        }
    }
}

/// In a white furnace a lossless surface disappears.
TEST(BsdfEnergy, LosslessSurfacesAreLossless) {
    const std::string none = "none";
    const std::vector<BsdfCase> cases = {
        {"dielectric", made(bsdfNode("dielectric")), true},
        {"dielectric, rarer inside", made(bsdfNode("dielectric", {{"int_ior", 1.0}, {"ext_ior", 1.7}})), true},
        {"thindielectric", made(bsdfNode("thindielectric")), true},
        {"conductor", made(bsdfNode("conductor", {{"material", none}})), false},
        {"diffuse", made(bsdfNode("diffuse", {{"reflectance", 1.0}})), false},
        {"plastic", made(bsdfNode("plastic", {{"diffuse_reflectance", 1.0}})), false},
        {"plastic nonlinear", made(bsdfNode("plastic", {{"diffuse_reflectance", 1.0}, {"nonlinear", true}})), false},
        {"roughconductor, nearly smooth", made(bsdfNode("roughconductor", {{"material", none}, {"alpha", 0.001}})),
         false},
    };
    for (const BsdfCase& c : cases) {
        for (const double theta : {0.0, 0.7, 1.3, 1.5}) {
            const Color found = albedo(*c.bsdf, testing::directionOf(theta, 0.3));
            EXPECT_NEAR(found.g, 1.f, c.name.find("plastic") == 0 ? 4e-3f : 1e-3f) << c.name << " at " << theta;
        }
    }
    EXPECT_NEAR(albedo(*cases[0].bsdf, testing::directionOf(2.6, 0.3)).g, 1.f, 1e-3f) << "glass from inside";
    EXPECT_NEAR(albedo(*cases[0].bsdf, testing::directionOf(1.8, 0.3)).g, 1.f, 1e-3f)
        << "glass from inside, beyond the critical angle";
}

/// Light that facets throw at one another is lost; how much is bounded, and grows with roughness.
TEST(BsdfEnergy, RoughGlassLosesLittle) {
    for (const char* distribution : {"beckmann", "ggx"}) {
        float before = 1.f;
        for (const double alpha : {0.01, 0.1, 0.3, 0.6}) {
            const auto glass =
                made(bsdfNode("roughdielectric", {{"alpha", alpha}, {"distribution", std::string(distribution)}}));
            const float found = albedo(*glass, testing::directionOf(0.8, 0.0)).g;
            EXPECT_LE(found, before + 1e-3f) << distribution << " " << alpha;
            EXPECT_GE(found, alpha <= 0.1 ? 0.985f : 0.85f) << distribution << " " << alpha;
            before = found;
        }
    }
}

/// Rough glass that is hardly rough lets through and reflects what smooth glass does.
TEST(BsdfEnergy, NearlySmoothGlassIsSmoothGlass) {
    const auto rough = made(bsdfNode("roughdielectric", {{"alpha", 0.001}}));
    const auto smooth = made(bsdfNode("dielectric"));
    const SurfaceInteraction at;
    for (const double theta : {0.1, 0.9, 1.4, 2.5, 3.0}) {
        const Vec3f wo = testing::directionOf(theta, 0.3);
        for (const float uLobe : {0.f, 0.9999f}) {
            const auto a = rough->sample(at, wo, uLobe, {0.3f, 0.6f}), b = smooth->sample(at, wo, uLobe, {0.3f, 0.6f});
            ASSERT_TRUE(a && b);
            EXPECT_EQ(a->event, b->event);
            EXPECT_EQ(a->eta, b->eta);
            EXPECT_NEAR(a->weight.g, b->weight.g, 2e-2f * b->weight.g);
            EXPECT_LT(length(a->wi - b->wi), 0.02f) << theta;
        }
    }
}

/// A white base under a rough coat gives back exactly what rough glass reflects and lets through.
TEST(BsdfEnergy, RoughPlasticAgreesWithRoughGlass) {
    for (const double alpha : {0.1, 0.4}) {
        const auto plastic = withTexture("roughplastic", "diffuse_reflectance", 1.0, alpha);
        const auto glass = made(bsdfNode("roughdielectric", {{"alpha", alpha}, {"int_ior", 1.49}}));
        for (const double theta : {0.0, 0.8, 1.3}) {
            const Vec3f wo = testing::directionOf(theta, 0.0);
            EXPECT_NEAR(albedo(*plastic, wo).g, albedo(*glass, wo).g, 8e-3f) << alpha << " at " << theta;
        }
    }
}

/// What sampling estimates is the integral of eval(): the two are written separately.
TEST(BsdfEnergy, SamplesEstimateTheIntegral) {
    const SurfaceInteraction at;
    for (const BsdfCase& c : testing::scatteringBsdfs()) {
        for (const double theta : {0.5, 1.3}) {
            const Vec3f wo = testing::directionOf(theta, 0.4);
            const double integral = testing::integrateDirections(
                0, std::numbers::pi / 2, [&](Vec3f wi) { return static_cast<double>(c.bsdf->eval(at, wo, wi).g); });
            TestRandom random(9);
            double sum = 0;
            for (int i = 0; i < kSamples; ++i) {
                const auto sample = c.bsdf->sample(at, wo, (static_cast<float>(i) + 0.5f) / kSamples, random.next2());
                if (sample && !sample->isDelta() && sample->wi.z > 0.f) sum += static_cast<double>(sample->weight.g);
            }
            EXPECT_NEAR(sum / kSamples, integral, 0.01 * integral + 5e-4) << c.name << " at " << theta;
        }
    }
}

/// Helmholtz: f(wo, wi) = f(wi, wo), where radiance over n^2 is what is transported.
TEST(BsdfEnergy, ScatteringIsReciprocal) {
    const SurfaceInteraction at;
    TestRandom random(21);
    const auto ior = [](const BsdfCase& c, Vec3f w) {
        if (c.name.find("roughdielectric") != 0 || w.z > 0.f) return 1.f;
        return c.name.find("anisotropic") == std::string::npos ? 1.5046f / 1.000277f : 1.333f / 1.000277f;
    };
    for (const BsdfCase& c : testing::scatteringBsdfs()) {
        int compared = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3f wo = squareToUniformSphere(random.next2());
            const float uLobe = random.next();
            const auto sample = c.bsdf->sample(at, wo, uLobe, random.next2());
            if (!sample || sample->isDelta() || std::abs(sample->wi.z) < 1e-2f || std::abs(wo.z) < 1e-2f) continue;
            const Vec3f wi = sample->wi;
            const float there = c.bsdf->eval(at, wo, wi).g / std::abs(wi.z) / square(ior(c, wo));
            const float back = c.bsdf->eval(at, wi, wo).g / std::abs(wo.z) / square(ior(c, wi));
            ASSERT_NEAR(back, there, 1e-2f * there + 1e-6f) << c.name << ", wo.z = " << wo.z << ", wi.z = " << wi.z;
            ++compared;
        }
        EXPECT_GT(compared, 300) << c.name;
    }
}

}  // namespace
}  // namespace emca::render
