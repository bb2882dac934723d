#include "emca/analysis/image_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "emca/analysis/metric_scale.h"
#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

TEST(ImageChannels, LayersAreFoundByNameWhateverTheirOrder) {
    const Image image(1, 1, {"B", "R", "normal.X", "G", "A", "diffuse.b", "normal.Z", "diffuse.g", "Z", "normal.Y", "diffuse.r", "half.R"});
    const std::vector<ColorLayer> layers = colorLayers(image);
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].name, "");
    EXPECT_EQ(layers[1].name, "normal");
    EXPECT_EQ(layers[2].name, "diffuse");
    const auto names = [&](const ColorLayer& layer) {
        std::string all;
        for (const std::uint32_t c : layer.channels) all += image.channels()[c] + " ";
        return all;
    };
    EXPECT_EQ(names(layers[0]), "R G B ");
    EXPECT_EQ(names(layers[1]), "normal.X normal.Y normal.Z ");
    EXPECT_EQ(names(layers[2]), "diffuse.r diffuse.g diffuse.b ");
    EXPECT_TRUE(colorLayers(Image(1, 1, {"R", "G", "x.B"})).empty()) << "three channels of two layers are no colour";
}

TEST(ImageChannels, PickedChannelsKeepNamesAndValues) {
    Image image(3, 2, {"R", "G", "B", "Z"});
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<float>(i);
    const std::uint32_t wanted[] = {3, 0};
    const Image picked = pickChannels(image, wanted);
    EXPECT_EQ(picked.channels(), (std::vector<std::string>{"Z", "R"}));
    EXPECT_EQ(picked.at({2, 1})[0], image.at({2, 1})[3]);
    EXPECT_EQ(picked.at({2, 1})[1], image.at({2, 1})[0]);
}

TEST(ImageRange, LeavesOutTheTailsAndIgnoresWhatIsNoNumber) {
    Image image(1000, 500, {"Y"});
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(2, 6);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = uniform(random);
    for (std::size_t i = 0; i < image.size(); i += 5000) image.data()[i] = i % 10000 == 0 ? 1e6f : std::nanf("");
    const ValueRange range = imageRange(image, {0});
    EXPECT_NEAR(range.min, 2.02, 0.02);
    EXPECT_NEAR(range.max, 5.98, 0.02);
}

TEST(MetricRange, SignedErrorsLieAroundZero) {
    Image difference(200, 100);
    for (std::size_t i = 0; i < difference.size(); ++i) difference.data()[i] = i % 2 ? -0.25f : 0.125f;
    const ValueRange range = metricRange(difference, ImageMetric::error, {0});
    EXPECT_EQ(range.min, -range.max);
    EXPECT_NEAR(range.max, 0.25, 0.01);
    EXPECT_TRUE(ColorMap::get(suggestedMap(ImageMetric::error)).isDiverging());
    const ValueRange absolute = metricRange(difference, ImageMetric::absoluteError, {0});
    EXPECT_EQ(absolute.min, 0);
    EXPECT_EQ(metricRange(Image(4, 4, {"FLIP"}), ImageMetric::hdrFlip), (ValueRange{0, 1, false}));
    for (std::size_t m = 0; m < kImageMetricCount; ++m)
        EXPECT_TRUE(metricRange(Image(4, 4), static_cast<ImageMetric>(m)).isValid()) << "equal images";
}

}  // namespace
}  // namespace emca::analysis
