// Two renders of one scene differ nowhere, and any pixel can be rendered again alone, bit by bit the same, whatever is
// recorded meanwhile.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <random>
#include <thread>

#include "emca/core/replay.h"
#include "emca/recorder/recorder.h"
#include "emca/render/image_renderer.h"
#include "support/test_scenes.h"

namespace emca {
namespace {

using render::ImageRenderer;
using render::RenderOptions;
using render::SamplerKind;

constexpr std::uint32_t kWidth = 96, kHeight = 72, kSamples = 16;

std::vector<test::TestScene> allScenes() {
    auto scenes = test::ownScenes();
    for (const test::TestScene& scene : test::publicScenes()) scenes.push_back(scene);
    return scenes;
}

RenderOptions optionsFor(const render::Scene& scene, SamplerKind sampler) {
    RenderOptions options = render::sceneOptions(scene);
    options.samplesPerPixel = kSamples;
    options.sampler = sampler;
    return options;
}

bool sameBits(const Image& a, const Image& b) {
    return a.size() == b.size() && a.size() > 0 && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Replay : public testing::TestWithParam<SamplerKind> {};

TEST_P(Replay, OneAndTwoThreadsRecordingOrNotGiveEqualBits) {
    for (const test::TestScene& scene : allScenes()) {
        SCOPED_TRACE(scene.name);
        const auto loaded = test::load(scene, kWidth, kHeight);
        ASSERT_TRUE(loaded);
        const RenderOptions options = optionsFor(*loaded, GetParam());
        const auto one = ImageRenderer(loaded, 1).renderImage(options);
        ASSERT_TRUE(one.ok());

        // Pixels are replayed and recorded all the while the image renders with two threads.
        const ImageRenderer renderer(loaded, 2);
        std::atomic<bool> done = false;
        std::thread clicking([&] {
            std::mt19937 random(1);
            do {
                const Pixel pixel{std::uint32_t(random() % kWidth), std::uint32_t(random() % kHeight)};
                Recording recording({.pixels = {pixel}});
                const RecordScope scope(recording, pixel);
                const auto replayed = renderer.renderPixel(pixel, options);
                ASSERT_TRUE(replayed.ok());
                EXPECT_EQ(compare(one->color.color(pixel), *replayed), Verdict::exact);
            } while (!done);
        });
        const auto two = renderer.renderImage(options);
        done = true;
        clicking.join();
        ASSERT_TRUE(two.ok());
        EXPECT_TRUE(sameBits(one->color, two->color));
        EXPECT_TRUE(sameBits(one->variance, two->variance));
    }
}

// 2,000 pixels over all scenes and both samplers; every recorded path adds up.
TEST_P(Replay, ThousandRandomPixelsAreExact) {
    const auto scenes = allScenes();
    const std::size_t perScene = (1000 + scenes.size() - 1) / scenes.size();
    std::size_t exact = 0;
    for (const test::TestScene& scene : scenes) {
        SCOPED_TRACE(scene.name);
        const auto loaded = test::load(scene, kWidth, kHeight);
        ASSERT_TRUE(loaded);
        const RenderOptions options = optionsFor(*loaded, GetParam());
        const ImageRenderer renderer(loaded, 2);
        const auto image = renderer.renderImage(options);
        ASSERT_TRUE(image.ok());
        std::mt19937 random(7);
        for (std::size_t i = 0; i < perScene; ++i) {
            const Pixel pixel{std::uint32_t(random() % kWidth), std::uint32_t(random() % kHeight)};
            Recording recording({.pixels = {pixel}});
            Color replayed;
            {
                const RecordScope scope(recording, pixel);
                const auto result = renderer.renderPixel(pixel, options);
                ASSERT_TRUE(result.ok());
                replayed = *result;
            }
            exact += compare(image->color.color(pixel), replayed) == Verdict::exact;
            const auto paths = recording.finish();
            ASSERT_TRUE(paths.ok());
            ASSERT_EQ(paths->pathCount(), kSamples);
            double sum = 0;
            for (Index p = 0; p < paths->pathCount(); ++p) sum += double(paths->estimate(p)->g);
            EXPECT_NEAR(sum / kSamples, double(replayed.g), 1e-5 * std::abs(sum)) << pixel.x << " " << pixel.y;
        }
    }
    EXPECT_EQ(exact, perScene * scenes.size());
}

TEST_P(Replay, MoreSamplesExtendThePathsAndChangeNone) {
    for (const test::TestScene& scene : test::ownScenes()) {
        SCOPED_TRACE(scene.name);
        const auto loaded = test::load(scene, kWidth, kHeight);
        ASSERT_TRUE(loaded);
        const auto pathsWith = [&](std::uint32_t samples) {
            RenderOptions options = optionsFor(*loaded, GetParam());
            options.samplesPerPixel = samples;
            Recording recording;
            {
                const RecordScope scope(recording, {40, 40});
                EXPECT_TRUE(ImageRenderer(loaded, 1).renderPixel({40, 40}, options).ok());
            }
            return *recording.finish();
        };
        const PathSet few = pathsWith(8), many = pathsWith(13);
        ASSERT_EQ(few.pathCount(), 8u);
        ASSERT_EQ(many.pathCount(), 13u);
        for (Index p = 0; p < few.pathCount(); ++p) {
            EXPECT_EQ(few.estimate(p), many.estimate(p));
            ASSERT_EQ(few.vertices(p).size(), many.vertices(p).size());
            for (Index v = few.vertices(p).first; v < few.vertices(p).last; ++v) EXPECT_EQ(few.position(v), many.position(v));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Samplers, Replay, testing::Values(SamplerKind::independent, SamplerKind::sobol),
                         [](const auto& p) { return p.param == SamplerKind::sobol ? "sobol" : "independent"; });

}  // namespace
}  // namespace emca
