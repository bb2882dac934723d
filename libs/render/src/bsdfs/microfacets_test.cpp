#include "bsdfs/microfacets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "testing/chi_square.h"

namespace emca::render {
namespace {

struct Case {
    const char* name;
    Microfacets facets;
};

std::vector<Case> cases() {
    using Type = Microfacets::Type;
    return {{"beckmann 0.1", {Type::beckmann, 0.1f, 0.1f}},
            {"beckmann 0.6", {Type::beckmann, 0.6f, 0.6f}},
            {"beckmann 0.2 x 0.7", {Type::beckmann, 0.2f, 0.7f}},
            {"ggx 0.1", {Type::ggx, 0.1f, 0.1f}},
            {"ggx 0.6", {Type::ggx, 0.6f, 0.6f}},
            {"ggx 0.2 x 0.7", {Type::ggx, 0.2f, 0.7f}}};
}

constexpr double kHalfPi = std::numbers::pi / 2;

/// Seen from above, the facets cover the surface exactly once.
TEST(Microfacets, ProjectedAreaIsOne) {
    for (const Case& c : cases()) {
        const double area = testing::integrateDirections(
            0, kHalfPi, [&](Vec3f m) { return static_cast<double>(c.facets.density(m) * m.z); });
        EXPECT_NEAR(area, 1.0, 1e-3) << c.name;
    }
}

/// Seen from v, the visible facets cover the surface exactly once too: this ties G1 to D (Heitz 2014, equation 13).
TEST(Microfacets, VisibleProjectedAreaIsOne) {
    for (const Case& c : cases()) {
        for (const double theta : {0.0, 0.6, 1.2, 1.5}) {
            const Vec3f v = testing::directionOf(theta, 0.8);
            const double area = testing::integrateDirections(
                0, kHalfPi, [&](Vec3f m) { return static_cast<double>(c.facets.visiblePdf(v, m)); });
            EXPECT_NEAR(area, 1.0, 1e-3) << c.name << " at " << theta;
        }
    }
}

TEST(Microfacets, VisibleNormalsFallWhereTheDensitySays) {
    testing::ChiSquareOptions options;
    options.samples = 200'000;
    options.xBins = 40;
    constexpr std::array<double, 4> kAngles = {0.0, 0.6, 1.2, 1.5};
    options.tests = static_cast<int>(cases().size() * kAngles.size());
    for (const Case& c : cases()) {
        for (const double theta : kAngles) {
            const Vec3f v = testing::directionOf(theta, 0.8);
            ++options.seed;
            const auto result = testing::testDirections(
                [&](testing::TestRandom& random) { return std::optional(c.facets.sampleVisible(v, random.next2())); },
                [&](Vec3f m) { return static_cast<double>(c.facets.visiblePdf(v, m)); }, options);
            EXPECT_TRUE(result.accepted) << c.name << " at " << theta << ": " << result.text;
        }
    }
}

TEST(Microfacets, NothingIsVisibleFromBehindAFacet) {
    const Microfacets facets(Microfacets::Type::ggx, 0.3f, 0.3f);
    const Vec3f v = testing::directionOf(1.4, 0.0), turnedAway = testing::directionOf(1.0, std::numbers::pi);
    EXPECT_LT(dot(v, turnedAway), 0.f);
    EXPECT_EQ(facets.maskingG1(v, turnedAway), 0.f);
    EXPECT_EQ(facets.density({0.6f, 0.f, -0.8f}), 0.f);
    EXPECT_EQ(facets.maskingG1({0, 0, 1}, {0, 0, 1}), 1.f);
}

}  // namespace
}  // namespace emca::render
