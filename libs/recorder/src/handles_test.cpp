// A wavefront renderer: every stage runs over all paths before the next begins, on whatever thread.
#include "emca/recorder/handles.h"

#include <gtest/gtest.h>

#include <thread>

namespace emca {
namespace {

TEST(Handles, StagesOnDifferentThreadsMakeWholePaths) {
    constexpr int kPaths = 64, kDepth = 5;
    Recording recording({.pixels = {{0, 0}, {1, 0}}});
    const auto stage = [&](auto&& work) {
        std::thread even([&] { for (int i = 0; i < kPaths; i += 2) work(i); });
        std::thread odd([&] { for (int i = 1; i < kPaths; i += 2) work(i); });
        even.join();
        odd.join();
    };
    const auto pathOf = [&](int i) { return recording.path({std::uint32_t(i % 3), 0}, i); };
    for (int depth = 1; depth <= kDepth; ++depth) {
        stage([&](int i) { pathOf(i).vertex(depth).position(Vec3f{float(i), float(depth), 0}); });
        stage([&](int i) { pathOf(kPaths - 1 - i).vertex(depth).add("pdf", float(depth)).event(Event::reflect, Lobe::diffuse, "wall"); });
    }
    stage([&](int i) { pathOf(i).finalEstimate(Color(float(i))).add("index", i); });
    auto result = recording.finish();
    ASSERT_TRUE(result.ok());
    const PathSet& paths = *result;
    ASSERT_EQ(paths.pathCount(), 43u) << "those of pixel 2 were not asked for";
    const Column& index = *paths.find(Scope::path, "index").at(0);
    const Column& pdf = *paths.find(Scope::vertex, "pdf").at(0);
    for (Index p = 0; p < paths.pathCount(); ++p) {
        EXPECT_EQ(paths.pixel(p).x, std::uint32_t(paths.sample(p) % 3));
        EXPECT_EQ(paths.estimate(p), Color(float(paths.sample(p))));
        EXPECT_EQ(paths.last(index, p), Value(paths.sample(p)));
        ASSERT_EQ(paths.vertices(p).size(), Index(kDepth));
        for (Index v = paths.vertices(p).first; v < paths.vertices(p).last; ++v) {
            EXPECT_EQ(paths.position(v), (Vec3f{float(paths.sample(p)), float(paths.depthIndex(v)), 0}));
            EXPECT_EQ(paths.last(pdf, v), Value(float(paths.depthIndex(v))));
            EXPECT_EQ(paths.scattering(v)->label, "wall");
        }
    }
}

TEST(Handles, ARecordingAtTheSameAddressIsAnotherOne) {
    for (int round = 0; round < 3; ++round) {
        Recording recording;
        recording.path({0, 0}, round).add("round", round);
        auto paths = recording.finish();
        ASSERT_TRUE(paths.ok());
        ASSERT_EQ(paths->pathCount(), 1u);
        EXPECT_EQ(paths->sample(0), round);
    }
}

}  // namespace
}  // namespace emca
