#include "emca/analysis/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace emca::analysis {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Image filled(std::uint32_t width, std::uint32_t height, Color c) {
    Image image(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image.setColor({x, y}, c);
    return image;
}

TEST(ImageMetric, KnownValues) {
    EXPECT_DOUBLE_EQ(apply(ImageMetric::error, 1, 3), -2);
    EXPECT_DOUBLE_EQ(apply(ImageMetric::absoluteError, 1, 3), 2);
    EXPECT_DOUBLE_EQ(apply(ImageMetric::squaredError, 1, 3), 4);
    EXPECT_DOUBLE_EQ(apply(ImageMetric::relativeAbsoluteError, 1, 3), 2 / 3.01);
    EXPECT_DOUBLE_EQ(apply(ImageMetric::relativeSquaredError, 1, 3), 4 / 9.01);
    EXPECT_DOUBLE_EQ(apply(ImageMetric::symmetricAbsoluteError, 1, 3), 4 / 4.02);
    for (std::size_t m = 0; m < kImageMetricCount; ++m) {
        const auto metric = static_cast<ImageMetric>(m);
        EXPECT_EQ(imageMetricByName(name(metric)), metric);
        EXPECT_TRUE(!isPerChannel(metric) || apply(metric, 0, 0) == 0);
    }
    EXPECT_FALSE(imageMetricByName("psnr"));
}

TEST(DifferenceImage, IsSignedAndZeroWhereEqual) {
    Image a = filled(2, 1, {1, 2, 3}), b = filled(2, 1, {2, 2, 1});
    b.setColor({1, 0}, {kNaN, kInf, 0});
    a.setColor({1, 0}, {kNaN, kInf, kNaN});
    const Result<Image> d = differenceImage(a, b);
    ASSERT_TRUE(d.ok());
    EXPECT_EQ(d->color({0, 0}), Color(-1, 0, 2));
    EXPECT_EQ(d->color({1, 0}).r, 0);
    EXPECT_EQ(d->color({1, 0}).g, 0);
    EXPECT_TRUE(std::isnan(d->color({1, 0}).b));
    EXPECT_NEAR(meanOf(*d), 1.0 / 5, 1e-7);
}

TEST(DifferenceImage, GreyAgainstColorComparesLuminance) {
    Image grey(1, 1, {"Y"});
    grey.data()[0] = 0.25f;
    const Result<Image> d = differenceImage(filled(1, 1, {1, 1, 1}), grey);
    ASSERT_TRUE(d.ok());
    EXPECT_EQ(d->channels(), std::vector<std::string>{"Y"});
    EXPECT_NEAR(d->data()[0], 0.75f, 1e-6f);
}

TEST(DifferenceImage, HasOneChannelOfFlip) {
    const Image white = filled(4, 4, {1, 1, 1}), black = filled(4, 4, {0, 0, 0});
    for (const ImageMetric metric : {ImageMetric::ldrFlip, ImageMetric::hdrFlip}) {
        const Result<Image> d = differenceImage(black, white, metric);
        ASSERT_TRUE(d.ok());
        EXPECT_EQ(d->channels(), std::vector<std::string>{"FLIP"});
        EXPECT_GT(meanOf(*d), 0.9);
    }
    EXPECT_NE(meanOf(*differenceImage(black, white, ImageMetric::ldrFlip)), meanOf(*differenceImage(black, white, ImageMetric::hdrFlip)));
}

TEST(DifferenceImage, SizesMustAgree) {
    for (std::size_t m = 0; m < kImageMetricCount; ++m) {
        const Result<Image> d = differenceImage(Image(3, 4), Image(4, 3), static_cast<ImageMetric>(m));
        ASSERT_FALSE(d.ok());
        EXPECT_EQ(d.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(d.error().message.find("3 x 4"), std::string::npos);
        EXPECT_NE(d.error().message.find("4 x 3"), std::string::npos);
    }
}

TEST(ImageStatistics, CountsFaultsPerChannelAndRegion) {
    Image image = filled(4, 4, {1, 1, 1});
    image.setColor({0, 0}, {kNaN, 1, 1});
    image.setColor({3, 3}, {-1, kInf, 1});
    const auto whole = imageStatistics(image);
    ASSERT_EQ(whole.size(), 4u);
    EXPECT_EQ(whole[0].channel, "R");
    EXPECT_EQ(whole[0].summary.nan, 1u);
    EXPECT_EQ(whole[0].negative, 1u);
    EXPECT_EQ(whole[1].summary.positiveInfinite, 1u);
    EXPECT_EQ(whole[2].summary.mean, 1);
    EXPECT_EQ(whole[3].channel, "luminance");
    const auto part = imageStatistics(image, {1, 1, 3, 99});
    EXPECT_EQ(part[0].summary.count, 6u);
    EXPECT_EQ(part[0].summary.nan, 0u);
    EXPECT_EQ(regionValues(image, {2}, {9, 9, 12, 12}).size(), 0u);
}

TEST(FaultyPixels, InReadingOrderWorstFaultEach) {
    Image image = filled(3, 2, {1, 1, 1});
    image.setColor({2, 0}, {-1, 1, 1});
    image.setColor({0, 1}, {-kInf, 1, -1});
    image.setColor({1, 1}, {-1, kInf, kNaN});
    const auto faults = faultyPixels(image);
    ASSERT_EQ(faults.size(), 3u);
    EXPECT_EQ(faults[0].pixel, (Pixel{2, 0}));
    EXPECT_EQ(faults[0].fault, PixelFault::negative);
    EXPECT_EQ(faults[1].fault, PixelFault::infinite);
    EXPECT_EQ(faults[2].fault, PixelFault::nan);
    EXPECT_EQ(faultyPixels(image, 1).size(), 1u);
}

}  // namespace
}  // namespace emca::analysis
