#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "emca/render/sampling_functions.h"
#include "testing/bsdf_cases.h"
#include "testing/chi_square.h"

namespace emca::render {
namespace {

using testing::BsdfCase;
using testing::TestRandom;

/// Directions of view: along the normal, oblique, grazing, and from behind.
std::vector<Vec3f> outgoingDirections() {
    return {testing::directionOf(0.0, 0.0), testing::directionOf(0.8, 0.5), testing::directionOf(1.5, 2.0),
            testing::directionOf(2.2, 4.0)};
}

testing::ChiSquareResult chiSquare(const Bsdf& bsdf, Vec3f wo, double pdfFactor,
                                   const testing::ChiSquareOptions& options) {
    const SurfaceInteraction at;
    return testing::testDirections(
        [&](TestRandom& random) -> std::optional<Vec3f> {
            const float uLobe = random.next();
            const auto sample = bsdf.sample(at, wo, uLobe, random.next2());
            if (!sample || sample->isDelta()) return std::nullopt;
            return sample->wi;
        },
        [&](Vec3f wi) { return pdfFactor * static_cast<double>(bsdf.pdf(at, wo, wi)); }, options);
}

TEST(BsdfSampling, DirectionsFallWhereTheDensitySays) {
    const auto& cases = testing::scatteringBsdfs();
    const std::vector<Vec3f> directions = outgoingDirections();
    testing::ChiSquareOptions options;
    options.tests = static_cast<int>(cases.size() * directions.size());
    for (const BsdfCase& c : cases) {
        for (const Vec3f wo : directions) {
            ++options.seed;
            const auto result = chiSquare(*c.bsdf, wo, 1.0, options);
            EXPECT_TRUE(result.accepted) << c.name << ", wo.z = " << wo.z << ": " << result.text;
        }
    }
}

TEST(BsdfSampling, WrongDensityIsRejected) {
    const auto diffuse = testing::made(testing::bsdfNode("diffuse"));
    const auto rough = testing::made(testing::bsdfNode("roughconductor", {{"alpha", 0.3}}));
    const auto rougher = testing::made(testing::bsdfNode("roughconductor", {{"alpha", 0.32}}));
    const Vec3f wo = testing::directionOf(0.8, 0.5);
    testing::ChiSquareOptions options;
    options.tests = 1000;
    EXPECT_FALSE(chiSquare(*diffuse, wo, 1.05, options).accepted) << "density 5 % too high";
    EXPECT_FALSE(chiSquare(*diffuse, wo, 0.95, options).accepted) << "density 5 % too low";

    const SurfaceInteraction at;
    const auto mismatched = testing::testDirections(
        [&](TestRandom& random) -> std::optional<Vec3f> {
            const auto sample = rough->sample(at, wo, random.next(), random.next2());
            return sample ? std::optional(sample->wi) : std::nullopt;
        },
        [&](Vec3f wi) { return static_cast<double>(rougher->pdf(at, wo, wi)); }, options);
    EXPECT_FALSE(mismatched.accepted) << "roughness 0.32 instead of 0.3: " << mismatched.text;
}

/// The weight of a sample is f |cos| / pdf, and evalPdf() is eval() and pdf().
TEST(BsdfSampling, WeightIsValueOverDensity) {
    const SurfaceInteraction at;
    TestRandom random(3);
    for (const BsdfCase& c : testing::scatteringBsdfs()) {
        int compared = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3f wo = squareToUniformSphere(random.next2());
            const float uLobe = random.next();
            const auto sample = c.bsdf->sample(at, wo, uLobe, random.next2());
            if (!sample || sample->isDelta()) continue;
            const Bsdf::EvalPdf both = c.bsdf->evalPdf(at, wo, sample->wi);
            EXPECT_EQ(both.value, c.bsdf->eval(at, wo, sample->wi)) << c.name;
            EXPECT_FLOAT_EQ(both.pdf, c.bsdf->pdf(at, wo, sample->wi)) << c.name;
            // The half vector of two directions loses digits where lobes are narrow or the boundary nearly vanishes.
            const float tolerance = 2e-2f;
            ASSERT_NEAR(both.pdf / sample->pdf, 1.f, tolerance)
                << c.name << ", wo.z = " << wo.z << ", wi.z = " << sample->wi.z;
            for (const auto& [weight, value] : {std::pair{sample->weight.r, both.value.r},
                                                {sample->weight.g, both.value.g},
                                                {sample->weight.b, both.value.b}}) {
                ASSERT_NEAR(value / both.pdf, weight, tolerance * weight + 1e-4f)
                    << c.name << ", wo.z = " << wo.z << ", wi.z = " << sample->wi.z;
            }
            ++compared;
        }
        EXPECT_GT(compared, 300) << c.name;
    }
}

/// 100,000 random and degenerate calls: all is finite, unit, non-negative and labelled.
TEST(BsdfSampling, SurvivesDegenerateInput) {
    constexpr std::array<float, 6> kCorners = {0.f, 1e-30f, 0x1p-24f, 0.5f, 1.f - 0x1p-12f, kOneMinusEpsilon};
    const std::array<Vec3f, 9> edges = {Vec3f{0, 0, 1},       {0, 0, -1},     {1, 0, 0},
                                        {0, -1, 0},           {1, 0, 1e-20f}, {1, 0, 1e-6f},
                                        {0.6f, 0.8f, -1e-6f}, {1e-8f, 0, 1},  {0, 1e-8f, -1}};
    const SurfaceInteraction at;
    TestRandom random(11);
    const auto pick = [&](float) { return kCorners[static_cast<std::size_t>(random.next() * 6.f)]; };
    const int perCase = 100'000 / static_cast<int>(testing::allBsdfs().size()) + 1;
    for (const BsdfCase& c : testing::allBsdfs()) {
        for (int i = 0; i < perCase; ++i) {
            const Vec3f wo = i % 3 == 0 ? edges[static_cast<std::size_t>(random.next() * 9.f)]
                                        : squareToUniformSphere(random.next2());
            const float uLobe = i % 2 == 0 ? random.next() : pick(0);
            const Vec2f u = i % 4 < 2 ? random.next2() : Vec2f{pick(0), pick(0)};
            const auto sample = c.bsdf->sample(at, wo, uLobe, u);
            const Vec3f wi = sample ? sample->wi : edges[static_cast<std::size_t>(random.next() * 9.f)];
            const Bsdf::EvalPdf both = c.bsdf->evalPdf(at, wo, wi);
            ASSERT_TRUE(isFinite(both.value) && std::isfinite(both.pdf))
                << c.name << ", wo.z = " << wo.z << ", wi.z = " << wi.z;
            ASSERT_TRUE(both.value.r >= 0 && both.value.g >= 0 && both.value.b >= 0 && both.pdf >= 0) << c.name;
            if (!sample) continue;
            ASSERT_TRUE(isFinite(sample->weight) && isFinite(sample->wi) && std::isfinite(sample->pdf))
                << c.name << ", wo.z = " << wo.z;
            ASSERT_TRUE(sample->weight.r >= 0 && sample->weight.g >= 0 && sample->weight.b >= 0) << c.name;
            ASSERT_GT(sample->pdf, 0.f) << c.name;
            ASSERT_NEAR(length(sample->wi), 1.f, 1e-5f) << c.name << ", wo = " << wo.x << " " << wo.y << " " << wo.z;
            ASSERT_TRUE(sample->event == Event::reflect || sample->event == Event::transmit) << c.name;
            ASSERT_NE(sample->lobe, Lobe::none) << c.name;
            const bool crossed = sample->wi.z * wo.z < 0.f;
            ASSERT_FALSE(crossed && sample->event == Event::reflect) << c.name;
            ASSERT_FALSE(crossed && !c.transmits) << c.name;
        }
    }
}

}  // namespace
}  // namespace emca::render
