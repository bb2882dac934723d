#include "emca/render/light_probe.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "testing/test_scenes.h"

namespace emca::render {
namespace {

constexpr double kPi = std::numbers::pi;

const std::string kAnyCamera = testing::spotCamera("3,0,1.5", "0,0,0", "0,0,1");
const std::string kFloor = R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)" +
                           testing::diffuse("0.5,0.5,0.5") + "</shape>";

probe::LightProbeRequest request(Vec3f position, Vec3f normal, std::uint32_t height = 32, std::uint32_t samples = 16) {
    probe::LightProbeRequest asked;
    asked.position = position;
    asked.normal = normal;
    asked.frame = probe::SphereFrame::around({0, 0, 1}, {1, 0, 0});
    asked.width = 2 * height;
    asked.height = height;
    asked.samplesPerPixel = samples;
    asked.seed = 7;
    return asked;
}

probe::LightProbe render(const std::string& text, const probe::LightProbeRequest& asked, int threads = 2) {
    const auto scene = testing::sceneFromText(kAnyCamera + text);
    if (!scene) return {};
    auto probe = renderLightProbe(*scene, asked, scene->integrator(), SamplerKind::independent, threads);
    EXPECT_TRUE(probe) << (probe ? "" : probe.error().message);
    return probe ? std::move(probe).value() : probe::LightProbe();
}

/// Sum of f(direction) L over the sphere.
template <typename F>
double integral(const probe::LightProbe& probe, F f) {
    double sum = 0;
    for (std::uint32_t y = 0; y < probe.map.height(); ++y)
        for (std::uint32_t x = 0; x < probe.map.width(); ++x)
            sum += probe.map.solidAngle(y) * double(probe.image.at({x, y})[1]) * f(probe.map.direction({x + 0.5, y + 0.5}));
    return sum;
}

TEST(LightProbe, AnEvenSkyIsTheSameEverywhere) {
    const auto probe = render(R"(<emitter type="constant"><rgb name="radiance" value="0.25,0.5,2"/></emitter>)", request({1, 2, 3}, {}, 8, 3));
    ASSERT_EQ(probe.image.size(), 16u * 8 * 4);
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) {
            EXPECT_EQ(probe.image.color({x, y}), Color(0.25f, 0.5f, 2)) << x << ", " << y;
            EXPECT_EQ(probe.image.at({x, y})[3], 0.f);
        }
}

TEST(LightProbe, AFurnaceIsTheSameEverywhere) {
    // Inside a sphere of radiance 1 and albedo 0.5, points see 1 + 0.5 + 0.25 with three segments.
    auto asked = request({2, 0, 0}, {1, 0, 0}, 16, 64);
    asked.maximumDepth = 3;
    const auto probe = render(R"(<shape type="sphere"><boolean name="flip_normals" value="true"/><float name="radius" value="2"/>)" +
                                  testing::diffuse("0.5,0.5,0.5") + R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)",
                              asked);
    // The point lies on the sphere: what looks outwards is black, what looks inwards sees the furnace.
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const float outwards = probe.map.direction({x + 0.5, y + 0.5}).x;
            if (outwards > 0.15f) { EXPECT_EQ(probe.image.at({x, y})[1], 0.f) << x << ", " << y; }
            if (outwards < -0.15f) { EXPECT_NEAR(probe.image.at({x, y})[1], 1.75, 0.1) << x << ", " << y; }
        }
    EXPECT_NEAR(integral(probe, [](Vec3f) { return 1.0; }) / (2 * kPi), 1.75, 0.01);
}

TEST(LightProbe, ASmallLightHasItsSolidAngleAndDirection) {
    // Radius 0.3 at distance 3: a cone of sin(a) = 1/10, solid angle 2 pi (1 - cos(a)).
    const Vec3f direction = normalize(Vec3f{1, -2, 2});
    const std::string light = R"(<shape type="sphere"><point name="center" x="1" y="-2" z="2"/><float name="radius" value="0.3"/>
        <emitter type="area"><rgb name="radiance" value="5"/></emitter></shape>)";
    auto asked = request({}, {}, 64, 64);
    asked.maximumDepth = 1;
    const auto probe = render(light, asked);
    const double cosine = std::sqrt(1 - 1.0 / 100), solidAngle = 2 * kPi * (1 - cosine);
    const double found = integral(probe, [](Vec3f) { return 1.0; }) / 5;
    EXPECT_NEAR(found, solidAngle, 0.02 * solidAngle);  // some 13 pixels of 64 samples

    Vec3d mean;
    for (std::uint32_t y = 0; y < probe.map.height(); ++y)
        for (std::uint32_t x = 0; x < probe.map.width(); ++x) {
            const float value = probe.image.at({x, y})[1];
            const Vec3f at = probe.map.direction({x + 0.5, y + 0.5});
            mean += Vec3d{double(at.x), double(at.y), double(at.z)} * (double(value) * probe.map.solidAngle(y));
            // A pixel whose middle is more than a pixel's diagonal from the cone sees nothing of it.
            const double angle = std::acos(std::min(1.0, double(dot(at, direction))));
            if (angle > std::asin(0.1) + kPi / 64) { EXPECT_EQ(value, 0.f) << x << ", " << y; }
        }
    mean = normalize(mean);
    EXPECT_GT(mean.x * double(direction.x) + mean.y * double(direction.y) + mean.z * double(direction.z), std::cos(0.25 * kPi / 64));
    EXPECT_NEAR(probe.image.at(probe.map.pixelOf(direction))[1], 5, 1e-5);
}

TEST(LightProbe, CosineWeightedItIsTheIrradiance) {
    // E = pi L F, F the form factor of a sphere: (r / d)^2 cos(theta), as seen from a floor.
    const std::string light = R"(<shape type="sphere"><point name="center" x="-1" y="0" z="2"/><float name="radius" value="0.5"/>
        <emitter type="area"><rgb name="radiance" value="3"/></emitter></shape>)";
    auto asked = request({}, {0, 0, 1}, 64, 64);
    asked.maximumDepth = 1;
    const auto probe = render(kFloor + light, asked);
    const double expected = 3 * kPi * 0.25 / 5 * 2 / std::sqrt(5.0);
    EXPECT_NEAR(integral(probe, [](Vec3f d) { return std::max(0.0, double(d.z)); }), expected, 0.01 * expected);
}

TEST(LightProbe, APointOnAFloorSeesNothingOfIt) {
    // Even sky above a floor that reflects half: no ray may meet the floor it starts from, neither above nor below.
    const std::string sky = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)";
    for (const Vec3f position : {Vec3f{}, Vec3f{0.3f, -0.7f, 0}, Vec3f{9, 9, 0}})
        for (const float side : {1.f, -1.f}) {
            const auto probe = render(kFloor + sky, request(position, {0, 0, side}, 16, 4));
            for (std::size_t i = 0; i < probe.image.size(); i += 4) EXPECT_EQ(probe.image.data()[i], 1.f);
        }
    // Tilted, far from the origin, where floats are coarse; the normal as coarse as a tessellation's.
    const std::string tilted = R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/><rotate x="1" angle="37"/>
        <translate x="300" y="-200" z="1000"/></transform>)" + testing::diffuse("0.5,0.5,0.5") + "</shape>";
    const double angle = 37 * kPi / 180;
    const Vec3f normal{0, static_cast<float>(-std::sin(angle)), static_cast<float>(std::cos(angle))};
    const auto probe = render(tilted + sky, request({300, -200, 1000}, normalize(normal + Vec3f{0.02f, 0, 0.01f}), 16, 4));
    for (std::size_t i = 0; i < probe.image.size(); i += 4) EXPECT_EQ(probe.image.data()[i], 1.f);
}

TEST(LightProbe, StandardErrorsAreThoseOfTheNoise) {
    // Over all pixels (value - truth) / error has variance 1; a floor of albedo 0.5 under an even sky reflects 0.5.
    auto asked = request({0, 0, 1}, {}, 32, 64);
    asked.maximumDepth = 2;
    const std::string bright = R"(<emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/><rgb name="irradiance" value="1"/></emitter>)";
    const std::string sky = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)";
    const auto probe = render(kFloor + sky + bright, asked);
    double squares = 0;
    int count = 0;
    for (std::uint32_t y = 24; y < 32; ++y)  // well below the horizon
        for (std::uint32_t x = 0; x < 64; ++x) {
            const float* pixel = probe.image.at({x, y});
            if (pixel[3] == 0.f) continue;
            squares += std::pow((double(pixel[1]) - 0.5 - 0.5 / kPi) / double(pixel[3]), 2);
            ++count;
        }
    ASSERT_GT(count, 400);
    EXPECT_NEAR(squares / count, 1, 0.35);
}

TEST(LightProbe, IsTheSameForAnyNumberOfThreads) {
    const std::string light = R"(<shape type="sphere"><point name="center" x="-1" y="0" z="2"/><float name="radius" value="0.5"/>
        <emitter type="area"><rgb name="radiance" value="3"/></emitter></shape>)";
    const auto asked = request({0.1f, 0.2f, 0}, {0, 0, 1}, 16, 8);
    const auto one = render(kFloor + light, asked, 1), three = render(kFloor + light, asked, 3);
    auto other = asked;
    other.seed = 8;
    const auto differs = render(kFloor + light, other, 1);
    ASSERT_EQ(one.image.size(), three.image.size());
    bool same = true, changed = false;
    for (std::size_t i = 0; i < one.image.size(); ++i) {
        same = same && one.image.data()[i] == three.image.data()[i];
        changed = changed || one.image.data()[i] != differs.image.data()[i];
    }
    EXPECT_TRUE(same);
    EXPECT_TRUE(changed);
}

TEST(LightProbe, CanBeCancelledAndTellsItsProgress) {
    const auto scene = testing::sceneFromText(kAnyCamera + kFloor);
    ASSERT_TRUE(scene);
    std::atomic<int> calls = 0;
    RenderCallbacks callbacks;
    callbacks.cancelled = [&] { return ++calls > 100; };
    const auto cancelled = renderLightProbe(*scene, request({}, {}), scene->integrator(), SamplerKind::independent, 2, callbacks);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);

    std::atomic<int> complete = 0;
    RenderCallbacks watched;
    watched.progress = [&](double fraction) { complete += fraction == 1.0; };
    EXPECT_TRUE(renderLightProbe(*scene, request({}, {}, 16, 1), scene->integrator(), SamplerKind::independent, 2, watched));
    EXPECT_EQ(complete, 1);
    EXPECT_FALSE(renderLightProbe(*scene, request({}, {}, 0, 1), scene->integrator(), SamplerKind::independent));
}

}  // namespace
}  // namespace emca::render
