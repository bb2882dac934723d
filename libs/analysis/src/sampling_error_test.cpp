#include "emca/analysis/sampling_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace emca::analysis {
namespace {

RenderedImage rendered(std::uint32_t width, std::uint32_t height, float samples) {
    RenderedImage image{Image(width, height), Image(width, height, {"samples"}), Image(width, height)};
    for (std::size_t i = 0; i < image.samples.size(); ++i) image.samples.data()[i] = samples;
    return image;
}

TEST(SamplingErrorImage, KnownValues) {
    RenderedImage image = rendered(2, 1, 16);
    image.color.setColor({1, 0}, {2, 0, -1});
    image.variance.setColor({1, 0}, {4, 9, 1});
    const auto at = [&](SamplingError error) { return samplingErrorImage(image, error)->color({1, 0}); };
    EXPECT_EQ(at(SamplingError::variance), Color(4, 9, 1));
    EXPECT_EQ(at(SamplingError::standardError), Color(0.5f, 0.75f, 0.25f));
    EXPECT_FLOAT_EQ(at(SamplingError::relativeError).r, 0.5f / 2.01f);
    EXPECT_FLOAT_EQ(at(SamplingError::relativeError).g, 75);
    EXPECT_FLOAT_EQ(at(SamplingError::relativeError).b, 0.25f / 1.01f);
    EXPECT_EQ(samplingErrorImage(image, SamplingError::relativeError)->color({0, 0}), Color(0)) << "no spread, no error";
}

/// The standard error is what the means of repeated renders scatter by.
TEST(SamplingErrorImage, PredictsHowMeansScatter) {
    constexpr std::uint32_t kPixels = 4000, kSamples = 64;
    RenderedImage image = rendered(kPixels, 1, kSamples);
    std::mt19937 random(11);
    std::exponential_distribution<float> value(0.5f);  // mean 2, variance 4
    double scatter = 0;
    for (std::uint32_t x = 0; x < kPixels; ++x) {
        double sum = 0, squares = 0;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            const double v = static_cast<double>(value(random));
            sum += v;
            squares += v * v;
        }
        const double mean = sum / kSamples;
        scatter += (mean - 2) * (mean - 2);
        image.color.setColor({x, 0}, Color(static_cast<float>(mean)));
        image.variance.setColor({x, 0}, Color(static_cast<float>((squares - sum * mean) / (kSamples - 1))));
    }
    const Image errors = *samplingErrorImage(image, SamplingError::standardError);
    double predicted = 0;
    for (std::uint32_t x = 0; x < kPixels; ++x) predicted += std::pow(static_cast<double>(errors.color({x, 0}).r), 2);
    EXPECT_NEAR(std::sqrt(predicted / kPixels), std::sqrt(scatter / kPixels), 0.02 * std::sqrt(scatter / kPixels));
    EXPECT_NEAR(std::sqrt(scatter / kPixels), 2 / 8.0, 0.01);
}

TEST(SamplingErrorImage, AFileThatWasSavedFromARenderHasThemAsChannels) {
    RenderedImage file;
    file.color = Image(1, 1, {"R", "G", "B", "samples", "variance.B", "variance.G", "variance.R"});
    const float values[] = {1, 1, 1, 4, 30, 20, 10};
    std::copy(std::begin(values), std::end(values), file.color.data());
    EXPECT_TRUE(hasVariance(file));
    EXPECT_EQ(samplingErrorImage(file, SamplingError::variance)->color({0, 0}), Color(10, 20, 30));
}

TEST(SamplingErrorImage, WhatIsNotKnownIsSaid) {
    RenderedImage plain{Image(2, 2), {}, {}};
    EXPECT_FALSE(hasVariance(plain));
    EXPECT_EQ(samplingErrorImage(plain, SamplingError::variance).error().code, ErrorCode::notSupported);
    RenderedImage single = rendered(2, 1, 1);
    EXPECT_TRUE(hasVariance(single));
    EXPECT_FALSE(samplingErrorImage(single, SamplingError::variance)) << "one sample has no variance";
    *single.samples.at({1, 0}) = 2;
    const auto some = samplingErrorImage(single, SamplingError::variance);
    ASSERT_TRUE(some);
    EXPECT_TRUE(std::isnan(some->color({0, 0}).r));
    EXPECT_EQ(some->color({1, 0}).r, 0);
}

}  // namespace
}  // namespace emca::analysis
