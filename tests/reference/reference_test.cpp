// Our images against those of another renderer, which share no code and no random numbers with ours.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "emca/imageio/imageio.h"
#include "emca/render/image_renderer.h"
#include "support/test_scenes.h"

namespace emca {
namespace {

constexpr int kSeeds = 16;
constexpr std::uint32_t kSamples = 64;

struct Renders {
    Image reference;
    std::vector<Image> ours;  ///< one per seed
};

/// Empty if the public scenes are not there.
Renders renderScene(const std::string& name) {
    for (const test::TestScene& scene : test::publicScenes()) {
        if (scene.name != name) continue;
        auto reference = imageio::read(scene.reference);
        EXPECT_TRUE(reference.ok()) << (reference.ok() ? "" : reference.error().message);
        const auto loaded = test::load(scene, scene.width, scene.height);
        if (!reference.ok() || !loaded) return {};
        Renders renders{std::move(*reference), {}};
        render::RenderOptions options = render::sceneOptions(*loaded);
        options.samplesPerPixel = kSamples;
        for (int seed = 0; seed < kSeeds; ++seed) {
            options.seed = std::uint64_t(seed);
            auto image = render::ImageRenderer(loaded).renderImage(options);
            EXPECT_TRUE(image.ok());
            if (image.ok()) renders.ours.push_back(std::move(image->color));
        }
        return renders;
    }
    return {};
}

#define SKIP_WITHOUT_SCENES(renders) \
    if ((renders).ours.empty()) GTEST_SKIP() << "The public scenes with references are not beside this checkout."

void expectChannelMeans(const Renders& renders, double tolerance) {
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const auto mean = [&](const Image& image) {
            double sum = 0;
            for (std::uint32_t y = 0; y < image.height(); ++y)
                for (std::uint32_t x = 0; x < image.width(); ++x) sum += double(image.at({x, y})[channel]);
            return sum / (double(image.width()) * image.height());
        };
        double ours = 0;
        for (const Image& image : renders.ours) ours += mean(image) / double(renders.ours.size());
        const double theirs = mean(renders.reference);
        EXPECT_NEAR(ours / theirs, 1.0, tolerance) << "channel " << channel << ": ours " << ours << ", reference " << theirs;
        testing::Test::RecordProperty("ratio_" + std::to_string(channel), std::to_string(ours / theirs));
        std::printf("[  MEASURE ] channel %u: ours / reference = %.5f\n", channel, ours / theirs);
    }
}

double tileLuminance(const Image& image, std::uint32_t tileX, std::uint32_t tileY) {
    double sum = 0;
    for (std::uint32_t y = 8 * tileY; y < 8 * tileY + 8; ++y)
        for (std::uint32_t x = 8 * tileX; x < 8 * tileX + 8; ++x) sum += double(luminance(image.color({x, y})));
    return sum / 64;
}

// Whole 8x8 tiles, mean over 16 seeds against the reference by a t-test with 15 degrees of freedom. The reference has
// noise of its own: 2,048 samples per pixel, whose variance is taken from ours.
TEST(Reference, CornellBoxTilesPassATTest) {
    const Renders renders = renderScene("cornell-box");
    SKIP_WITHOUT_SCENES(renders);
    ASSERT_EQ(renders.reference.width(), renders.ours[0].width());
    ASSERT_EQ(renders.reference.height(), renders.ours[0].height());
    constexpr double kThreshold = 4.0728;  // two-sided 0.1 % quantile of Student's t, 15 degrees of freedom
    constexpr double kReferenceSamples = 2048;
    int tiles = 0, beyond = 0;
    for (std::uint32_t ty = 0; ty < renders.reference.height() / 8; ++ty)
        for (std::uint32_t tx = 0; tx < renders.reference.width() / 8; ++tx) {
            double sum = 0, squares = 0;
            for (const Image& image : renders.ours) {
                const double value = tileLuminance(image, tx, ty);
                sum += value;
                squares += value * value;
            }
            const double mean = sum / kSeeds;
            const double variance = std::max(0.0, (squares - sum * sum / kSeeds) / (kSeeds - 1));
            const double error = std::sqrt(variance * (1.0 / kSeeds + double(kSamples) / kReferenceSamples));
            const double difference = std::abs(mean - tileLuminance(renders.reference, tx, ty));
            ++tiles;
            // Where nothing varies (the light seen directly) rounding is all that may differ.
            if (difference > kThreshold * error + 1e-5 * mean) ++beyond;
        }
    EXPECT_LE(beyond, tiles * 0.02) << beyond << " of " << tiles << " tiles";
    std::printf("[  MEASURE ] %d of %d tiles beyond the 0.1 %% threshold\n", beyond, tiles);
    expectChannelMeans(renders, 0.01);
}

TEST(Reference, VeachMisMeans) {
    const Renders renders = renderScene("veach-mis");
    SKIP_WITHOUT_SCENES(renders);
    expectChannelMeans(renders, 0.01);
}

TEST(Reference, VeachAjarMeans) {
    const Renders renders = renderScene("veach-ajar");
    SKIP_WITHOUT_SCENES(renders);
    expectChannelMeans(renders, 0.03);
}

TEST(Reference, VeachBidirMeans) {
    const Renders renders = renderScene("veach-bidir");
    SKIP_WITHOUT_SCENES(renders);
    expectChannelMeans(renders, 0.03);
}

}  // namespace
}  // namespace emca
