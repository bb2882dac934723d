#include "emca/analysis/image_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

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

TEST(ImageStatistics, OfChosenPixelsAreThoseOfTheSameValues) {
    std::mt19937 random(11);
    std::lognormal_distribution<float> radiance(0, 2);
    Image image(13, 9, {"R", "G", "B", "A"});
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = radiance(random) - 0.5f;
    image.at({3, 3})[1] = kNaN;
    image.at({4, 3})[1] = -kInf;
    for (const std::size_t count : {0u, 1u, 2u, 7u, 64u, 117u}) {
        std::vector<Pixel> pixels;
        for (std::uint32_t y = 0; y < 9; ++y)
            for (std::uint32_t x = 0; x < 13; ++x) pixels.push_back({x, y});
        std::shuffle(pixels.begin(), pixels.end(), random);
        pixels.resize(count);
        std::vector<Pixel> asked = pixels;
        asked.push_back({99, 1});
        const auto found = imageStatistics(image, asked);
        ASSERT_EQ(found.size(), 5u);
        for (int c = 0; c < 4; ++c) {
            // Brute force: all the values, sorted.
            std::vector<double> values;
            std::size_t negative = 0;
            for (const Pixel p : pixels) {
                values.push_back(double(image.at(p)[c]));
                negative += values.back() < 0;
            }
            const ChannelStatistics& s = found[std::size_t(c)];
            const std::vector<double> sorted = sortedFinite(values);
            EXPECT_EQ(s.summary.count, count);
            EXPECT_EQ(s.summary.finite, sorted.size());
            EXPECT_EQ(s.negative, negative);
            if (sorted.empty()) continue;
            EXPECT_DOUBLE_EQ(s.median, quantile(sorted, 0.5));
            EXPECT_EQ(s.summary.min, sorted.front());
            EXPECT_EQ(s.summary.max, sorted.back());
        }
    }
    const std::vector<Pixel> corner{{1, 1}, {2, 1}, {1, 2}, {2, 2}};
    const auto listed = imageStatistics(image, corner), cut = imageStatistics(image, PixelRect{1, 1, 3, 3});
    for (std::size_t c = 0; c < 5; ++c) {
        EXPECT_EQ(listed[c].summary.mean, cut[c].summary.mean);
        EXPECT_EQ(listed[c].median, cut[c].median);
    }
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
    const FaultCounts counts = countFaults(image);
    EXPECT_EQ(counts.nan, 1u);
    EXPECT_EQ(counts.infinite, 1u);
    EXPECT_EQ(counts.negative, 1u);
    EXPECT_EQ(countFaults(image, {.channels = 1}).nan, 0u);
    EXPECT_EQ(countFaults(image, {.negative = false}).all(), 2u);
}

/// One after the other, round and round, is the list.
TEST(FaultyPixels, EachIsTheNextOfTheOneBefore) {
    Image image = filled(70, 50, {1, 1, 1});
    for (std::uint32_t y = 0; y < 50; ++y)
        for (std::uint32_t x = 0; x < 70; ++x)
            if ((x * 31 + y * 17) % 3 != 0) image.setColor({x, y}, {1, x % 2 ? kNaN : kInf, -1});
    const auto all = faultyPixels(image, 10000);
    ASSERT_GT(all.size(), 2000u);
    std::optional<Pixel> at;
    for (int round = 0; round < 2; ++round)
        for (const FaultyPixel& expected : all) {
            const auto next = nextFault(image, at);
            ASSERT_EQ(next, expected);
            at = next->pixel;
        }
    const Image fine = filled(3, 2, {1, 1, 1});
    EXPECT_FALSE(nextFault(fine, {}));
    EXPECT_FALSE(nextFault(fine, Pixel{2, 1}));
    Image one = fine;
    one.setColor({1, 1}, {kNaN, 0, 0});
    EXPECT_EQ(nextFault(one, Pixel{1, 1})->pixel, (Pixel{1, 1})) << "the only one";
    EXPECT_FALSE(nextFault(Image(), Pixel{7, 7}));
}

}  // namespace
}  // namespace emca::analysis
