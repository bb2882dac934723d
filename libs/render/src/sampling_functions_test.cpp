#include "emca/render/sampling_functions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/chi_square.h"

namespace emca::render {
namespace {

using testing::TestRandom;

TEST(SamplingFunctions, DirectionsFallWhereTheDensitySays) {
    testing::ChiSquareOptions options;
    options.tests = 4;
    const auto check = [&options](const char* name, auto sample, auto pdf) {
        ++options.seed;
        const auto result =
            testing::testDirections([&](TestRandom& random) { return std::optional(sample(random.next2())); },
                                    [&](Vec3f w) { return static_cast<double>(pdf(w)); }, options);
        EXPECT_TRUE(result.accepted) << name << ": " << result.text;
        EXPECT_NEAR(result.integral, 1.0, 2e-3) << name;
    };
    check("cosine hemisphere", squareToCosineHemisphere, [](Vec3f w) { return squareToCosineHemispherePdf(w.z); });
    check("uniform hemisphere", squareToUniformHemisphere, [](Vec3f w) { return squareToUniformHemispherePdf(w.z); });
    check("uniform sphere", squareToUniformSphere, [](Vec3f) { return squareToUniformSpherePdf(); });
    check(
        "cone", [](Vec2f u) { return squareToUniformCone(u, 0.f); },
        [](Vec3f w) { return w.z >= 0.f ? squareToUniformConePdf(0.f) : 0.f; });
}

TEST(SamplingFunctions, DiskIsUniform) {
    const auto result = testing::testPoints(
        {-1, 1, -1, 1},
        [](TestRandom& random) -> std::optional<Vec2d> {
            const Vec2f p = squareToConcentricDisk(random.next2());
            return Vec2d{static_cast<double>(p.x), static_cast<double>(p.y)};
        },
        [](Vec2d p) { return p.x * p.x + p.y * p.y <= 1 ? static_cast<double>(squareToConcentricDiskPdf()) : 0.0; });
    EXPECT_TRUE(result.accepted) << result.text;
}

TEST(SamplingFunctions, TriangleIsUniform) {
    const auto result = testing::testPoints(
        {0, 1, 0, 1},
        [](TestRandom& random) -> std::optional<Vec2d> {
            const Vec2f b = squareToUniformTriangle(random.next2());
            return Vec2d{static_cast<double>(b.x), static_cast<double>(b.y)};
        },
        [](Vec2d b) { return b.x + b.y <= 1 ? 2.0 : 0.0; });
    EXPECT_TRUE(result.accepted) << result.text;
}

TEST(SamplingFunctions, CornersOfTheSquareAreUnitDirections) {
    for (const float x : {0.f, 0.5f, kOneMinusEpsilon}) {
        for (const float y : {0.f, 0.5f, kOneMinusEpsilon}) {
            EXPECT_NEAR(length(squareToCosineHemisphere({x, y})), 1.f, 1e-6f);
            EXPECT_NEAR(length(squareToUniformSphere({x, y})), 1.f, 1e-6f);
            const Vec2f b = squareToUniformTriangle({x, y});
            EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1.f + 1e-6f);
        }
    }
}

}  // namespace
}  // namespace emca::render
