#include "program/tour_story.h"

#include <gtest/gtest.h>

#include "emca/recorder/recorder.h"

namespace emca::explorer {
namespace {

/// Four dim paths and a strong one that a glossy vertex sent through clear glass into a lamp.
PathSet recorded(bool contributions) {
    RecordingOptions options;
    options.pixels = {Pixel{0, 0}};
    Recording recording(options);
    {
        const RecordScope scope(recording, Pixel{0, 0});
        PathRecorder& emca = recorder();
        for (int sample = 0; sample < 20; ++sample) {
            emca.setPathIndex(sample);
            const float value = sample == 7 ? 100.f : 0.1f;
            const Event events[] = {Event::reflect, Event::transmit, Event::transmit, Event::emission};
            const Lobe lobes[] = {Lobe::diffuse, Lobe::glossy, Lobe::straight, Lobe::none};
            for (int depth = 1; depth <= 4; ++depth) {
                emca.setDepthIndex(depth);
                emca.setIntersectionPos(Vec3f{float(depth), 0, 0});
                emca.setIntersectionEvent(events[depth - 1], lobes[depth - 1]);
                emca.addIntersectionData("throughput", Color(depth > 1 && sample == 7 ? 8.f : 1.f));
                if (contributions && depth == 4) emca.addContribution(Color(value), "BSDF sampling", 0.5f, LightEnd::hit);
            }
            emca.setFinalEstimate(Color(value));
            emca.endPath();
        }
    }
    auto paths = recording.finish();
    EXPECT_TRUE(paths);
    return *paths;
}

TEST(TourStory, TheVertexThatChoseTheDirectionOfTheLightIsTheSuspect) {
    const PathSet paths = recorded(true);
    const auto suspect = findSuspect(paths);
    ASSERT_TRUE(suspect);
    EXPECT_EQ(paths.sample(suspect->path), 7);
    ASSERT_TRUE(suspect->vertex && suspect->light);
    EXPECT_EQ(paths.depthIndex(*suspect->vertex), 2) << "not the glass that light goes straight through, not the lamp";
    EXPECT_EQ(paths.depthIndex(suspect->light->vertex), 4);
    EXPECT_NEAR(suspect->share, 100 / (100 + 19 * 0.1), 1e-6);
    EXPECT_EQ(suspect->report.outliers.size(), 1u);
}

TEST(TourStory, WithoutContributionsTheThroughputTells) {
    const PathSet paths = recorded(false);
    const auto suspect = findSuspect(paths);
    ASSERT_TRUE(suspect && suspect->vertex);
    EXPECT_EQ(paths.depthIndex(*suspect->vertex), 1);
    EXPECT_DOUBLE_EQ(*suspect->after / *suspect->before, 8);
}

TEST(TourStory, NoPathsNoSuspect) { EXPECT_FALSE(findSuspect(PathSet())); }

TEST(TourStory, TheStrikingPixelIsAFireflyElseTheBrightest) {
    Image image(16, 16);
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) image.setColor({x, y}, Color(0.5f));
    image.setColor({3, 12}, Color(0.6f));
    EXPECT_EQ(strikingPixel(image)->pixel, (Pixel{3, 12}));
    image.setColor({9, 4}, Color(500.f));
    const auto found = strikingPixel(image);
    EXPECT_EQ(found->pixel, (Pixel{9, 4}));
    EXPECT_TRUE(found->firefly);
    EXPECT_FALSE(strikingPixel(Image()));
}

}  // namespace
}  // namespace emca::explorer
