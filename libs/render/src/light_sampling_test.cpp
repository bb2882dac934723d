#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <span>

#include "emca/core/image.h"
#include "emca/render/distribution.h"
#include "emca/render/triangle_mesh.h"
#include "emitters/environment_emitters.h"
#include "shapes/tessellation_face.h"
#include "testing/chi_square.h"
#include "testing/test_scenes.h"

namespace emca::render {
namespace {

constexpr int kTests = 9;  // chi-square tests of this file

TEST(Distribution, ChoosesInProportionAndNeverWhatIsImpossible) {
    const std::vector<float> weights = {0, 1, 0, 3, 4, 0, 0, 2, 5, 0, 1, 0};
    for (const std::size_t count : {5u, 12u}) {  // the short and the long search
        const Distribution1D distribution(std::span<const float>(weights).first(count));
        std::map<std::size_t, int> hits;
        constexpr int kSamples = 100000;
        for (int i = 0; i < kSamples; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / kSamples;
            const auto choice = distribution.sample(u);
            ++hits[choice.index];
            ASSERT_GE(choice.remainder, 0.f);
            ASSERT_LT(choice.remainder, 1.f);
            ASSERT_EQ(choice.probability, distribution.probability(choice.index));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const double expected = double(weights[i]) / distribution.total() * kSamples;
            EXPECT_NEAR(hits[i], expected, 1.5) << "entry " << i << " of " << count;
        }
        EXPECT_GT(distribution.probability(distribution.sample(0x1.fffffep-1f).index), 0.f);
        EXPECT_GT(distribution.probability(distribution.sample(0.f).index), 0.f);
    }
}

/// Compares how directions to an area light fall with the density of the surface that a ray in that direction meets.
void testAreaLight(const std::string& shape, Vec3f from, std::uint64_t seed) {
    const auto scene = testing::sceneFromText(shape + testing::spotCamera("0,0,20", "0,0,0"));
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->emitters().size(), 1u);
    const Emitter& light = *scene->emitters().front();
    testing::ChiSquareOptions options;
    options.seed = seed;
    options.tests = kTests;
    options.samples = 50000;
    const auto result = testing::testDirections(
        [&](testing::TestRandom& random) -> std::optional<Vec3f> {
            const auto sample = light.sample(from, random.next2());
            return sample ? std::optional(sample->direction) : std::nullopt;
        },
        [&](Vec3f direction) {
            SurfaceInteraction at;
            if (!scene->intersect({from, direction}, at) || isBlack(light.emitted(at, -direction))) return 0.0;
            return double(light.pdf(from, direction, at.distance, at));
        },
        options);
    EXPECT_TRUE(result.accepted) << result.text;
}

const std::string kArea = R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)";

TEST(LightSampling, Rectangle) {
    testAreaLight(R"(<shape type="rectangle"><transform name="to_world"><scale x="2" y="0.7"/>
        <rotate x="1" y="0.3" angle="30"/></transform>)" + kArea, {0.3f, 0.5f, 1.2f}, 11);
}
TEST(LightSampling, Cube) {
    testAreaLight(R"(<shape type="cube">)" + kArea, {0.2f, 0.3f, 1.4f}, 12);
}
TEST(LightSampling, SphereFromOutside) {
    testAreaLight(R"(<shape type="sphere"><float name="radius" value="0.8"/>)" + kArea, {0.9f, 0.7f, 0.8f}, 13);
}
TEST(LightSampling, SphereFromInside) {
    testAreaLight(R"(<shape type="sphere"><boolean name="flip_normals" value="true"/>)" + kArea, {0.3f, -0.2f, 0.4f}, 14);
}
TEST(LightSampling, Ellipsoid) {
    testAreaLight(R"(<shape type="sphere"><transform name="to_world"><scale x="2" y="1" z="0.5"/></transform>)" + kArea,
                  {0.5f, 1.6f, 1.f}, 15);
}
TEST(LightSampling, Disk) {
    testAreaLight(R"(<shape type="disk"><transform name="to_world"><scale x="1.5" y="0.8"/></transform>)" + kArea,
                  {0.4f, 0.2f, 0.7f}, 16);
}

void testEnvironment(const Emitter& light, std::uint64_t seed) {
    testing::ChiSquareOptions options;
    options.seed = seed;
    options.tests = kTests;
    int samples = 0, differences = 0;
    const auto result = testing::testDirections(
        [&](testing::TestRandom& random) -> std::optional<Vec3f> {
            const auto sample = light.sample({1, 2, 3}, random.next2());
            if (!sample) return std::nullopt;
            ++samples;
            differences += std::abs(sample->pdf - light.environmentPdf(sample->direction)) > 1e-3f * sample->pdf;
            return sample->direction;
        },
        [&](Vec3f direction) { return double(light.environmentPdf(direction)); }, options);
    EXPECT_TRUE(result.accepted) << result.text;
    EXPECT_NEAR(result.integral, 1, 1e-2);
    EXPECT_LT(differences, samples / 1000 + 1) << "only where rounding crosses the edge of a pixel";
}

TEST(LightSampling, ConstantEnvironment) { testEnvironment(ConstantEmitter(Color(1.f)), 17); }

/// A dark sky with a bright patch, small enough that its pixels are as large as the test's bins.
Image patchySky() {
    Image image(32, 16);
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) image.setColor({x, y}, Color(0.1f + 0.02f * static_cast<float>(x + y)));
    }
    for (std::uint32_t y = 3; y < 5; ++y) {
        for (std::uint32_t x = 20; x < 23; ++x) image.setColor({x, y}, {20, 18, 12});
    }
    return image;
}

TEST(LightSampling, EnvironmentMap) {
    // The map is turned to the test's axis, so that the bins of both coincide and the density is constant in them.
    testEnvironment(EnvironmentMap(patchySky(), Transform::rotate({1, 0, 0}, 90), 1.f), 18);
}

TEST(EnvironmentMap, HasMitsubasOrientation) {
    Image image(4, 2);
    image.setColor({2, 0}, {1, 0, 0});  // right of the centre, upper half
    const EnvironmentMap map(image, Transform(), 2.f);
    // u = 5/8: phi = 225 degrees; v = 1/4: theta = 45 degrees.
    const float s = std::sqrt(0.5f);
    const Vec3f direction{-s * s, s, s * s};
    EXPECT_NEAR(map.environment(direction).r, 2.f, 1e-5);
    EXPECT_NEAR(map.environment({s * s, s, s * s}).r, 0.f, 1e-5);
}

TEST(TessellationFace, IsTheTriangleThatTheRayFromTheCentreHits) {
    const TriangleMesh sphere = makeSphere();
    testing::TestRandom random(4);
    for (int i = 0; i < 3000; ++i) {
        const float z = 2 * random.next() - 1, phi = 2 * 3.14159265f * random.next(), r = std::sqrt(1 - z * z);
        const Vec3f d{r * std::cos(phi), r * std::sin(phi), z};
        const auto face = static_cast<std::size_t>(sphereFace(d));
        ASSERT_LT(face, sphere.triangles.size());
        const auto& t = sphere.triangles[face];
        const Vec3f a = sphere.positions[t[0]], b = sphere.positions[t[1]], c = sphere.positions[t[2]];
        EXPECT_GE(dot(cross(a, b), d), -1e-5f) << i << " face " << face;
        EXPECT_GE(dot(cross(b, c), d), -1e-5f) << i << " face " << face;
        EXPECT_GE(dot(cross(c, a), d), -1e-5f) << i << " face " << face;
    }
    const TriangleMesh disk = makeDisk();
    for (int i = 0; i < 64; ++i) {
        const float angle = (static_cast<float>(i) + 0.25f) / 64.f;
        const auto& t = disk.triangles[static_cast<std::size_t>(diskFace(angle))];
        const Vec3f d{std::cos(angle * 6.2831853f), std::sin(angle * 6.2831853f), 0};
        EXPECT_GE(cross(disk.positions[t[1]], d).z, 0.f);
        EXPECT_LE(cross(disk.positions[t[2]], d).z, 0.f);
    }
}

}  // namespace
}  // namespace emca::render
