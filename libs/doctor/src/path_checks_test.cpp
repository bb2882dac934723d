#include "emca/doctor/path_checks.h"

#include <cmath>
#include <string>

#include "recorded_for_tests.h"

namespace emca::doctor {
namespace {

const float kNan = std::nanf(""), kInfinity = INFINITY;

/// `samples` paths with three vertices each.
PathSet paths(Pixel pixel, int samples, int firstDepth = 1, int step = 1) {
    return recorded(pixel, [&](PathRecorder& emca) {
        for (int i = 0; i < samples; ++i) {
            emca.setPathIndex(i);
            for (int v = 0; v < 3; ++v) {
                emca.setDepthIndex(firstDepth + v * step);
                emca.setIntersectionPos(Vec3f{float(v), 0, 0});
            }
            emca.setFinalEstimate(Color(float(i)));
        }
    });
}

Outcome outcomeOf(const PathSet& set, std::uint64_t expected, const RecordingStats& stats = {}) {
    PathCheck check;
    check.add(set, {3, 4}, expected, stats);
    return check.finding().outcome;
}

TEST(PathChecks, OnePathForEachSample) {
    EXPECT_EQ(outcomeOf(paths({3, 4}, 5), 5), Outcome::ok);
    EXPECT_EQ(outcomeOf(paths({3, 4}, 5), 0), Outcome::ok) << "unknown";
    EXPECT_EQ(outcomeOf(paths({3, 4}, 5), 6), Outcome::failed);
    EXPECT_EQ(outcomeOf(paths({3, 4}, 5), 4), Outcome::failed);
    EXPECT_EQ(outcomeOf(PathSet(), 4), Outcome::failed);
    EXPECT_EQ(outcomeOf(paths({3, 4}, 5), 6, {.droppedByBudget = 9}), Outcome::warning) << "then nobody knows";
    PathCheck check;
    check.add(paths({3, 4}, 5), {3, 4}, 5, {});
    check.add(paths({8, 9}, 2), {8, 9}, 5, {});
    const Finding finding = check.finding();
    EXPECT_NE(finding.sentence.find("1 of 2 pixels"), std::string::npos) << finding.sentence;
    ASSERT_EQ(finding.pixels.size(), 1u);
    EXPECT_EQ(finding.pixels[0].pixel, (Pixel{8, 9}));
    EXPECT_EQ(finding.pixels[0].why, "2 paths for 5 samples");
}

TEST(PathChecks, LightTracersHaveAnyNumberOfPaths) {
    const PathSet light = recorded({3, 4}, [](PathRecorder& emca) {
        emca.setPathIndex(17);
        emca.setDepthIndex(1);
        emca.setIntersectionPos(Vec3f{0, 0, 0});
        emca.addSplat({3, 4}, Color(1));
    });
    EXPECT_EQ(outcomeOf(light, 64), Outcome::ok);
}

TEST(PathChecks, DepthsGoUpOneByOne) {
    EXPECT_EQ(outcomeOf(paths({3, 4}, 2, 0), 2), Outcome::ok) << "0 is the camera";
    EXPECT_EQ(outcomeOf(paths({3, 4}, 2, 2), 2), Outcome::warning);
    EXPECT_EQ(outcomeOf(paths({3, 4}, 2, 1, 2), 2), Outcome::warning);
    EXPECT_EQ(outcomeOf(paths({3, 4}, 2), 2, {.droppedWithoutVertex = 1}), Outcome::warning);
}

TEST(PathChecks, DifferencesAreNamed) {
    EXPECT_EQ(differenceOf(paths({3, 4}, 5), paths({3, 4}, 5)), "");
    EXPECT_NE(differenceOf(paths({3, 4}, 5), paths({3, 4}, 4)).find("4 paths instead of 5"), std::string::npos);
    const auto one = [](float value, int vertices) {
        return recorded({1, 2}, [=](PathRecorder& emca) {
            emca.setPathIndex(7);
            for (int v = 1; v <= vertices; ++v) emca.setDepthIndex(v);
            emca.setFinalEstimate(Color(value));
        });
    };
    EXPECT_EQ(differenceOf(one(kNan, 1), one(kNan, 1)), "");
    EXPECT_NE(differenceOf(one(1, 1), one(std::nextafter(1.f, 2.f), 1)).find("pixel (1, 2), path 7"), std::string::npos);
    EXPECT_NE(differenceOf(one(1, 1), one(1, 2)).find("vertices"), std::string::npos);
}

/// One path with everything that is numbers; `value` where each of them may be spoilt.
PathSet numbers(const std::string& spoilt, float value) {
    const auto one = [&](const char* quantity) { return spoilt == quantity ? value : 0.5f; };
    return recorded({3, 4}, [&](PathRecorder& emca) {
        emca.setPathIndex(2);
        emca.setPathOrigin(Vec3f{0, one("origin"), 0});
        emca.setDepthIndex(1);
        emca.setIntersectionPos(Vec3f{0, 0, one("position")});
        emca.setNextEventEstimationPos(Vec3f{one("next-event position"), 0, 0}, true);
        emca.setIntersectionEstimate(Color(0, one("intersection estimate"), 0));
        emca.setIntersectionEmission(Color(one("emission"), 0, 0));
        emca.addContribution(Color(0, 0, one("contribution")), "light sampling", one("MIS weight"));
        emca.addIntersectionData("float", one("float"));
        emca.addIntersectionData("double", double(one("double")));
        emca.addIntersectionData("double3", Vec3d{0, 0, double(one("double3"))});
        emca.addIntersectionData("vector", Vec2f{0, one("vector")});
        emca.addIntersectionData("spectrum", std::vector<float>{1, 2, 3, one("spectrum")});
        emca.addIntersectionData("huge", 1e300);
        emca.addIntersectionData("count", 3);
        emca.addIntersectionData("name", "NaN");
        emca.addPathData("throughput", Color(one("throughput"), 1, 1));
        emca.addSplat({3, 4}, Color(0, one("splat"), 0));
        emca.setFinalEstimate(Color(0, 0, one("final estimate")));
    });
}

TEST(ValueChecks, EveryQuantityIsLookedAt) {
    ValueCheck sound;
    sound.add(numbers("", 0));
    EXPECT_EQ(sound.finding().outcome, Outcome::ok) << sound.finding().sentence;
    for (const char* quantity : {"origin", "position", "next-event position", "intersection estimate", "emission", "contribution", "MIS weight", "float", "double",
                                 "double3", "vector", "spectrum", "throughput", "splat", "final estimate"}) {
        for (const float value : {kNan, kInfinity, -kInfinity}) {
            if (std::isnan(value) && std::string(quantity) == "MIS weight") continue;  // means that it was not said
            ValueCheck check;
            check.add(numbers("", 0));
            check.add(numbers(quantity, value));
            const Finding finding = check.finding();
            const bool place = std::string(quantity).find("position") != std::string::npos || std::string(quantity) == "origin";
            EXPECT_EQ(finding.outcome, place ? Outcome::failed : Outcome::warning) << quantity;
            EXPECT_NE(finding.sentence.find(std::string(quantity) + ": 1 " + (std::isnan(value) ? "NaN" : "infinite")), std::string::npos) << finding.sentence;
            EXPECT_NE(finding.sentence.find("pixel (3, 4), path 2"), std::string::npos) << finding.sentence;
            const Value* count = finding.find((std::isnan(value) ? "nan " : "infinite ") + std::string(quantity));
            ASSERT_NE(count, nullptr);
            EXPECT_EQ(std::get<std::int64_t>(*count), 1);
        }
    }
}

TEST(ValueChecks, NothingRecordedIsAWarning) {
    ValueCheck check;
    check.add(PathSet());
    EXPECT_EQ(check.finding().outcome, Outcome::warning);
}

}  // namespace
}  // namespace emca::doctor
