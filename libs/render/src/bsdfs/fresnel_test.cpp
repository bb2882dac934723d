#include "bsdfs/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdfs/media_ior.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {
namespace {

TEST(Fresnel, NormalIncidence) {
    for (const float eta : {1.33f, 1.5046f, 2.419f, 0.75f}) {
        const float expected = square((eta - 1.f) / (eta + 1.f));
        EXPECT_NEAR(fresnelDielectric(1.f, eta).reflectance, expected, 1e-6f);
        EXPECT_NEAR(fresnelDielectric(-1.f, eta).reflectance, expected, 1e-6f);
    }
    EXPECT_NEAR(fresnelDielectric(1.f, 1.5f).reflectance, 0.04f, 1e-6f);
}

/// At tan(theta) = eta nothing of the parallel polarisation is reflected, and of the other ((eta^2-1)/(eta^2+1))^2.
TEST(Fresnel, BrewsterAngle) {
    for (const float eta : {1.33f, 1.5f, 2.f}) {
        const float cosBrewster = 1.f / std::sqrt(1.f + eta * eta);
        EXPECT_NEAR(fresnelDielectric(cosBrewster, eta).reflectance,
                    0.5f * square((eta * eta - 1.f) / (eta * eta + 1.f)), 1e-6f);
    }
}

TEST(Fresnel, TotalInternalReflection) {
    const float eta = 1.5f;
    const float criticalCos = std::sqrt(1.f - 1.f / (eta * eta));
    const DielectricFresnel beyond = fresnelDielectric(-(criticalCos - 1e-3f), eta);
    EXPECT_EQ(beyond.reflectance, 1.f);
    EXPECT_EQ(beyond.cosTransmitted, 0.f);
    EXPECT_LT(fresnelDielectric(-(criticalCos + 1e-3f), eta).reflectance, 0.9f);
    EXPECT_EQ(fresnelDielectric(criticalCos - 1e-3f, 1.f / eta).reflectance, 1.f) << "the rarer medium inside";
    EXPECT_NEAR(fresnelDielectric(1e-6f, eta).reflectance, 1.f, 1e-4f) << "grazing";
}

/// Snell's law, and the same reflectance from the other end of the refracted ray.
TEST(Fresnel, RefractionIsReversible) {
    const float eta = 1.5046f;
    for (float cosine = 0.02f; cosine < 1.f; cosine += 0.07f) {
        const Vec3f v{std::sqrt(1.f - cosine * cosine), 0.f, cosine};
        const DielectricFresnel there = fresnelDielectric(cosine, eta);
        ASSERT_LT(there.cosTransmitted, 0.f);
        const Vec3f through = refractLocal(v, there.cosTransmitted, eta);
        EXPECT_NEAR(length(through), 1.f, 1e-6f);
        EXPECT_NEAR(-through.x * eta, v.x, 1e-6f);
        const DielectricFresnel back = fresnelDielectric(through.z, eta);
        EXPECT_NEAR(back.reflectance, there.reflectance, 1e-5f);
        const Vec3f again = refractLocal(through, back.cosTransmitted, eta);
        EXPECT_NEAR(again.x, v.x, 1e-5f);
        EXPECT_NEAR(again.z, v.z, 2e-5f);
        const Vec3f about = refractAbout(v, {0, 0, 1}, there.cosTransmitted, eta);
        EXPECT_NEAR(about.x, through.x, 1e-6f);
        EXPECT_NEAR(about.z, through.z, 1e-6f);
    }
}

TEST(Fresnel, ConductorWithoutExtinctionIsDielectric) {
    for (float cosine = 0.05f; cosine <= 1.f; cosine += 0.05f) {
        EXPECT_NEAR(fresnelConductor(cosine, Color(1.5f), Color(0.f)).g, fresnelDielectric(cosine, 1.5f).reflectance,
                    2e-6f);
    }
}

TEST(Fresnel, ConductorNormalIncidence) {
    const Color eta(0.2f, 0.924f, 1.1f), k(3.9f, 2.45f, 2.14f);
    const auto expected = [](float n, float x) { return (square(n - 1.f) + x * x) / (square(n + 1.f) + x * x); };
    const Color found = fresnelConductor(1.f, eta, k);
    EXPECT_NEAR(found.r, expected(eta.r, k.r), 1e-6f);
    EXPECT_NEAR(found.g, expected(eta.g, k.g), 1e-6f);
    EXPECT_NEAR(found.b, expected(eta.b, k.b), 1e-6f);
    EXPECT_EQ(fresnelConductor(0.f, eta, k), Color(1.f));
}

/// What handbooks say of polished metals: gold is red-yellow and dark in blue, silver and aluminium are bright.
TEST(Fresnel, MetalsHaveTheirColours) {
    const auto reflectance = [](const char* name) {
        const auto metal = metalIor(name);
        return fresnelConductor(1.f, metal->eta, metal->k);
    };
    const Color gold = reflectance("Au"), copper = reflectance("Cu"), silver = reflectance("Ag"),
                aluminium = reflectance("Al");
    EXPECT_NEAR(gold.r, 0.97f, 0.03f);
    EXPECT_NEAR(gold.g, 0.79f, 0.05f);
    EXPECT_NEAR(gold.b, 0.33f, 0.05f);
    EXPECT_NEAR(copper.r, 0.95f, 0.03f);
    EXPECT_NEAR(copper.g, 0.63f, 0.05f);
    EXPECT_NEAR(copper.b, 0.52f, 0.05f);
    for (const float channel : {silver.r, silver.g, silver.b}) EXPECT_NEAR(channel, 0.95f, 0.05f);
    for (const float channel : {aluminium.r, aluminium.g, aluminium.b}) EXPECT_NEAR(channel, 0.92f, 0.02f);
}

TEST(Fresnel, DiffuseReflectance) {
    // Egan and Hilgeman, "Optical Properties of Inhomogeneous Materials", 1979: 0.0918 from outside and 0.596 from
    // inside for an index of 1.5.
    EXPECT_NEAR(fresnelDiffuseReflectance(1.5f), 0.0918f, 2e-4f);
    EXPECT_NEAR(fresnelDiffuseReflectance(1.f / 1.5f), 0.5963f, 3e-4f);
    EXPECT_NEAR(fresnelDiffuseReflectance(1.f), 0.f, 1e-6f);
    // n^2 (1 - F) is the same from both sides: what may enter may leave.
    for (const float eta : {1.1f, 1.33f, 1.8f, 2.4f}) {
        EXPECT_NEAR(1.f - fresnelDiffuseReflectance(1.f / eta), (1.f - fresnelDiffuseReflectance(eta)) / (eta * eta),
                    2e-5f)
            << eta;
    }
}

TEST(Ior, NamesOfMedia) {
    EXPECT_EQ(mediumIor("bk7"), 1.5046);
    EXPECT_EQ(mediumIor("Water Ice"), 1.31);
    EXPECT_EQ(mediumIor("vacuum"), 1.0);
    EXPECT_FALSE(mediumIor("wate"));
    EXPECT_FALSE(mediumIor(""));
    EXPECT_FALSE(metalIor("none"));
}

}  // namespace
}  // namespace emca::render
