#include <cmath>
#include <functional>

#include "emca/doctor/scene_checks.h"
#include "recorded_for_tests.h"

namespace emca::doctor {
namespace {

constexpr std::uint32_t kWidth = 400, kHeight = 200;

BoundingBox box() {
    BoundingBox box;
    box.extend({-1, -1, -1});
    box.extend({1, 1, 1});
    return box;
}

Camera camera() {
    Camera camera;
    camera.position = {1, 2, 5};
    camera.direction = normalize(Vec3f{-0.2f, -0.4f, -1});
    camera.up = normalize(cross(cross(camera.direction, Vec3f{0, 1, 0}), camera.direction));
    camera.verticalFieldOfView = 40;
    return camera;
}

Outcome outcomeOf(const std::function<void(Camera&)>& change) {
    Camera changed = camera();
    change(changed);
    return checkCamera(changed, box()).outcome;
}

TEST(CameraChecks, OneRuleAfterTheOther) {
    EXPECT_EQ(outcomeOf([](Camera&) {}), Outcome::ok);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.kind = CameraKind::spherical; c.verticalFieldOfView = 360; }), Outcome::ok);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.farClip = INFINITY; }), Outcome::ok);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.direction *= 1.01f; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.up *= 0.9f; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.up = {0, 1, 0}; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.direction.x = std::nanf(""); }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.direction = {}; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.verticalFieldOfView = 0; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.verticalFieldOfView = 180; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.verticalFieldOfView = 0.3f; }), Outcome::warning);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.nearClip = c.farClip; }), Outcome::failed);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.farClip = 2; }), Outcome::warning);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.nearClip = 20; }), Outcome::warning);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.direction = -c.direction; }), Outcome::warning);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.position = c.position - c.direction * 500.f; }), Outcome::warning);
    EXPECT_EQ(outcomeOf([](Camera& c) { c.position = {}; }), Outcome::ok) << "inside the scene";
}

/// Paths of pixels all over the image, whose first vertices lie on the rays of `truth`, `offset` pixels beside the centre.
CameraRays raysOf(const Camera& truth, const Camera& announced, float offset = 0.3f) {
    CameraRays rays(announced, kWidth, kHeight);
    const double half = std::tan(double(truth.verticalFieldOfView) * M_PI / 360);
    const Vec3f right = cross(truth.direction, truth.up) * (truth.rightHanded ? 1.f : -1.f);
    for (std::uint32_t y = 5; y < kHeight; y += 37)
        for (std::uint32_t x = 5; x < kWidth; x += 41) {
            const double u = (2 * (x + 0.5 + double(offset)) / kWidth - 1) * half * kWidth / kHeight, v = (1 - 2 * (y + 0.5 + double(offset)) / kHeight) * half;
            const Vec3f direction = truth.direction + right * static_cast<float>(u) + truth.up * static_cast<float>(v);
            // Through the lens, at a place that depends on the pixel; the point in focus is the same for all of them.
            const Vec3f lens = truth.position + right * (truth.apertureRadius * float(x) / kWidth);
            const Vec3f focus = truth.position + direction * (truth.focusDistance > 0 ? truth.focusDistance : 1);
            rays.add(recorded({x, y}, [&](PathRecorder& emca) {
                emca.setPathIndex(0);
                emca.setPathOrigin(truth.apertureRadius > 0 ? lens : truth.position + direction * 0.1f);
                emca.setDepthIndex(1);
                emca.setIntersectionPos((truth.apertureRadius > 0 ? lens : truth.position) + (focus - (truth.apertureRadius > 0 ? lens : truth.position)) * 3.f);
            }));
        }
    return rays;
}

void expectFound(const std::function<void(Camera&)>& change, Outcome outcome, const char* word) {
    Camera wrong = camera();
    change(wrong);
    const Finding finding = raysOf(camera(), wrong).finding();
    EXPECT_EQ(finding.outcome, outcome) << finding.sentence;
    EXPECT_NE((finding.sentence + finding.advice).find(word), std::string::npos) << finding.sentence << finding.advice;
}

TEST(CameraRays, TheTrueCameraFits) {
    EXPECT_EQ(raysOf(camera(), camera()).finding().outcome, Outcome::ok);
    EXPECT_EQ(raysOf(camera(), camera(), 2.2f).finding().outcome, Outcome::ok) << "filter importance sampling leaves the pixel";
    Camera lens = camera();
    lens.apertureRadius = 0.3f;
    lens.focusDistance = 4;
    EXPECT_EQ(raysOf(lens, lens).finding().outcome, Outcome::ok);
    Camera mirrored = camera();
    mirrored.rightHanded = false;
    EXPECT_EQ(raysOf(mirrored, mirrored).finding().outcome, Outcome::ok);
}

TEST(CameraRays, EachMistakeIsNamed) {
    expectFound([](Camera& c) { c.rightHanded = false; }, Outcome::failed, "left and right");
    expectFound([](Camera& c) { c.up = -c.up; c.rightHanded = false; }, Outcome::failed, "upside down");
    expectFound([](Camera& c) { c.up = -c.up; }, Outcome::failed, "180 degrees");
    expectFound([](Camera& c) { c.direction = -c.direction; }, Outcome::failed, "opposite way");
    expectFound([](Camera& c) { c.verticalFieldOfView = static_cast<float>(2 * std::atan(2 * std::tan(20 * M_PI / 180)) * 180 / M_PI); }, Outcome::failed, "width");
    expectFound([](Camera& c) { c.verticalFieldOfView = 20; }, Outcome::failed, "doubled");
    expectFound([](Camera& c) { c.verticalFieldOfView = 80; }, Outcome::failed, "halved");
    expectFound([](Camera& c) { c.position.x += 1; }, Outcome::warning, "other pixels");
}

TEST(CameraRays, NothingToCompareIsSkipped) {
    EXPECT_EQ(CameraRays(camera(), kWidth, kHeight).finding().outcome, Outcome::skipped);
    Camera fisheye = camera();
    fisheye.kind = CameraKind::other;
    EXPECT_EQ(raysOf(camera(), fisheye).finding().outcome, Outcome::skipped);
}

}  // namespace
}  // namespace emca::doctor
