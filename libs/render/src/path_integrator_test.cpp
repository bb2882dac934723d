#include "emca/render/path_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "testing/test_scenes.h"

namespace emca::render {
namespace {

constexpr double kPi = 3.14159265358979;

std::string integrator(int maximumDepth) {
    return R"(<integrator type="path"><integer name="max_depth" value=")" + std::to_string(maximumDepth) + R"("/></integrator>)";
}

/// Expects the pixel's mean within 4.5 standard errors, and these below a bound, so that the test can fail.
void expectRadiance(const std::string& text, double expected, std::uint32_t samples = 20000, double largestError = 0.01,
                    LightStrategy strategy = LightStrategy::mis) {
    const auto scene = testing::sceneFromText(text);
    ASSERT_TRUE(scene);
    for (const Diagnostic& diagnostic : scene->diagnostics()) ADD_FAILURE() << diagnostic.message;
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
        RenderOptions options = testing::optionsWith(*scene, samples, sampler);
        options.integrator.strategy = strategy;
        const auto estimate = testing::estimatePixel(*scene, options);
        EXPECT_NEAR(estimate.mean.g, expected, 4.5 * double(estimate.error.g) + 1e-4 * expected) << name(sampler);
        EXPECT_LE(estimate.error.g, largestError * expected) << name(sampler);
    }
}

// Direct light on a diffuse plane of albedo 0.5 at the origin, normal +z, seen from the side: L = 0.5 F, F being the
// form factor of the light (of radiance 1) as seen from the plane (Siegel and Howell, "Thermal Radiation", appendix C).

const std::string kPlane = R"(<shape type="rectangle"><transform name="to_world"><scale value="10"/></transform>)" +
                           testing::diffuse("0.5,0.5,0.5") + "</shape>";
const std::string kPlaneScene = integrator(2) + kPlane + testing::spotCamera("3,0,1.5", "0,0,0", "0,0,1");
const std::string kUnitLight = R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)";

TEST(DirectLight, OfARectangleIsItsFormFactor) {
    // Half extents 0.8 and 0.5 at height 2, centred: four corner rectangles.
    const double x = 0.8 / 2, y = 0.5 / 2, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    const double formFactor = 4 / (2 * kPi) * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
    const std::string light = R"(<shape type="rectangle"><transform name="to_world"><scale x="0.8" y="0.5"/>
        <rotate x="1" angle="180"/><translate z="2"/></transform>)" + kUnitLight;
    expectRadiance(kPlaneScene + light, 0.5 * formFactor);
    expectRadiance(kPlaneScene + light, 0.5 * formFactor, 20000, 0.01, LightStrategy::lightSampling);
    expectRadiance(kPlaneScene + light, 0.5 * formFactor, 100000, 0.02, LightStrategy::bsdfSampling);
}

TEST(DirectLight, EmittersShineToTheirFrontAlone) {
    expectRadiance(kPlaneScene + R"(<shape type="rectangle"><transform name="to_world"><scale x="0.8" y="0.5"/>
        <translate z="2"/></transform>)" + kUnitLight, 0.0, 100, 1.0);
}

TEST(DirectLight, OfASphereIsItsFormFactor) {
    // Radius 0.5 at (1, 0, 2): (r / d)^2 cos(theta).
    const double d2 = 1 + 4;
    const std::string light = R"(<shape type="sphere"><point name="center" x="-1" y="0" z="2"/>
        <float name="radius" value="0.5"/>)" + kUnitLight;
    const double expected = 0.5 * 0.25 / d2 * 2 / std::sqrt(d2);
    expectRadiance(kPlaneScene + light, expected);
    expectRadiance(kPlaneScene + light, expected, 200000, 0.02, LightStrategy::bsdfSampling);
}

TEST(DirectLight, OfADiskIsItsFormFactor) {
    const std::string light = R"(<shape type="disk"><transform name="to_world"><scale value="0.7"/>
        <rotate x="1" angle="180"/><translate z="2"/></transform>)" + kUnitLight;
    expectRadiance(kPlaneScene + light, 0.5 * 0.49 / (0.49 + 4));
}

TEST(DirectLight, OfPointSpotAndDirectionalLights) {
    const double d2 = 1 + 4, cosine = 2 / std::sqrt(d2);
    const std::string position = R"(<point name="position" x="-1" y="0" z="2"/>)";
    expectRadiance(kPlaneScene + R"(<emitter type="point">)" + position +
                       R"(<rgb name="intensity" value="3"/></emitter>)", 0.5 / kPi * 3 * cosine / d2, 16);
    const std::string spot = R"(<emitter type="spot"><rgb name="intensity" value="3"/><float name="cutoff_angle" value="40"/>
        <float name="beam_width" value="20"/><transform name="to_world"><lookat origin="-1,0,2" target="TARGET" up="0,1,0"/>
        </transform></emitter>)";
    const auto aimed = [&](const std::string& target) {
        return std::string(spot).replace(spot.find("TARGET"), 6, target);
    };
    expectRadiance(kPlaneScene + aimed("0,0,0"), 0.5 / kPi * 3 * cosine / d2, 16);
    // Aimed straight down, the origin is atan(1 / 2) = 26.565 degrees off the axis: (40 - 26.565) / 20 of the light.
    expectRadiance(kPlaneScene + aimed("-1,0,0"), 0.5 / kPi * 3 * cosine / d2 * (40 - 26.56505) / 20, 16);
    expectRadiance(kPlaneScene + R"(<emitter type="directional"><vector name="direction" x="1" y="0" z="-1"/>
        <rgb name="irradiance" value="3"/></emitter>)", 0.5 / kPi * 3 * std::sqrt(0.5), 16);
}

TEST(DirectLight, OfAnEvenSky) {
    expectRadiance(kPlaneScene + R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)", 0.5);
}

TEST(DirectLight, MasksLetTheirShareThrough) {
    // A black pane of opacity 0.25 between light and plane; and one between camera and plane.
    const auto pane = [](const std::string& height) {
        return R"(<shape type="rectangle"><transform name="to_world"><scale value="0.4"/><translate x="-0.5" z=")" + height +
               R"("/></transform><bsdf type="mask"><float name="opacity" value="0.25"/>)" + testing::diffuse("0,0,0") +
               "</bsdf></shape>";
    };
    const double open = 0.5 / kPi * 3 * (2 / std::sqrt(5.0)) / 5;
    const std::string light = R"(<emitter type="point"><point name="position" x="-1" y="0" z="2"/>
        <rgb name="intensity" value="3"/></emitter>)";
    expectRadiance(kPlaneScene + light + pane("1"), 0.75 * open, 16);
    expectRadiance(kPlaneScene + light + pane("1") + pane("0.9"), 0.75 * 0.75 * open, 16);
    const std::string before = R"(<shape type="rectangle"><transform name="to_world"><scale value="0.2"/>
        <rotate y="1" angle="90"/><translate x="1.5" z="0.75"/></transform><bsdf type="mask"><float name="opacity" value="0.25"/>)" +
        testing::diffuse("0,0,0") + "</bsdf></shape>";
    expectRadiance(kPlaneScene + light + before, 0.75 * open, 20000);
}

// Furnaces: a closed surface of albedo 0.5 that emits 1 everywhere. Every point sees 1 + 0.5 + 0.25 + …

std::string furnace(const std::string& shape, int depth, const std::string& place = "") {
    return integrator(depth) + R"(<shape type=")" + shape + R"("><boolean name="flip_normals" value="true"/>
        <transform name="to_world"><scale value="2"/>)" + place + "</transform>" + testing::diffuse("0.5,0.5,0.5") + kUnitLight;
}
const std::string kInside = testing::spotCamera("0.1,0.2,-0.1", "1,0.3,0.4");

TEST(Furnace, SphereSumsTheGeometricSeries) {
    expectRadiance(furnace("sphere", -1) + kInside, 2.0);
    expectRadiance(furnace("sphere", 3) + kInside, 1.75);
    expectRadiance(furnace("sphere", 1) + kInside, 1.0, 16);
}

TEST(Furnace, CubeSumsTheGeometricSeries) {
    expectRadiance(furnace("cube", -1) + kInside, 2.0);
    expectRadiance(furnace("cube", 4) + kInside, 1.875);
}

TEST(Furnace, HoldsFarFromTheOrigin) {
    // Coordinates of 5000 at a size of 2: rounding of hit points is 2^-11 of the size there.
    const std::string away = R"(<translate x="5000" y="-3000" z="4000"/>)";
    const std::string camera = testing::spotCamera("5000.1,-2999.8,3999.9", "5001,-2999.7,4000.4");
    expectRadiance(furnace("sphere", -1, away) + camera, 2.0);
    expectRadiance(furnace("cube", -1, away) + camera, 2.0);
}

TEST(WhiteFurnace, WhiteAndClearThingsVanishInAnEvenSky) {
    const std::string sky = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)";
    for (const std::string shape : {"sphere", "cube"}) {
        for (const std::string& bsdf : {testing::diffuse("1,1,1"), std::string(R"(<bsdf type="dielectric"/>)")}) {
            SCOPED_TRACE(shape + bsdf);
            expectRadiance(integrator(-1) + sky + "<shape type=\"" + shape + "\">" + bsdf + "</shape>" +
                               testing::spotCamera("3,0.8,0.5", "0.1,0.2,0.3"), 1.0);
        }
    }
}

TEST(PathIntegrator, AllLightStrategiesHaveOneMean) {
    // A glossy and a diffuse surface, two lights of different size, several bounces.
    const std::string text = integrator(5) +
        R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform><bsdf type="roughconductor">
        <float name="alpha" value="0.3"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate y="1" angle="90"/><translate x="-2"/>
        </transform>)" + testing::diffuse("0.7,0.7,0.7") + "</shape>" +
        R"(<shape type="sphere"><point name="center" x="-1" y="0.5" z="1.5"/><float name="radius" value="0.6"/>)" + kUnitLight +
        R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="3" y="1"/></transform>)" +
        kUnitLight + testing::spotCamera("2,-1,1.5", "0,0,0", "0,0,1");
    const auto scene = testing::sceneFromText(text);
    ASSERT_TRUE(scene);
    testing::Estimate estimates[3];
    int i = 0;
    for (const auto strategy : {LightStrategy::mis, LightStrategy::lightSampling, LightStrategy::bsdfSampling}) {
        RenderOptions options = testing::optionsWith(*scene, 100000);
        options.seed = static_cast<std::uint64_t>(i);
        options.integrator.strategy = strategy;
        estimates[i++] = testing::estimatePixel(*scene, options);
    }
    for (int other : {1, 2}) {
        const double error = std::hypot(double(estimates[0].error.g), double(estimates[other].error.g));
        EXPECT_NEAR(estimates[0].mean.g, estimates[other].mean.g, 4.5 * error) << "strategy " << other;
        EXPECT_LT(error, 0.03 * double(estimates[0].mean.g));
    }
    EXPECT_LT(estimates[0].error.g, estimates[1].error.g) << "combined is better than light sampling";
}

TEST(PathIntegrator, EmittersCanBeHidden) {
    const std::string light = R"(<shape type="sphere">)" + kUnitLight + testing::spotCamera("3,0,0", "0,0,0");
    expectRadiance(light, 1.0, 16);
    expectRadiance(R"(<integrator type="path"><boolean name="hide_emitters" value="true"/></integrator>)" + light, 0.0, 16, 1.0);
}

}  // namespace
}  // namespace emca::render
