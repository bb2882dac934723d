#include "emca/core/pixel_sums.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emca {
namespace {

TEST(PixelSums, MeanAndVarianceAreThoseOfTheDefinition) {
    PixelSums sums;
    for (const float v : {1.f, 2.f, 6.f}) sums.add({v, 2 * v, 5.f});
    EXPECT_EQ(sums.count(), 3u);
    EXPECT_EQ(sums.mean(), (Color{3, 6, 5}));
    EXPECT_EQ(sums.variance(), (Color{7, 28, 0}));  // (4 + 1 + 9) / 2
}

TEST(PixelSums, FewSamplesHaveNoVariance) {
    PixelSums sums;
    EXPECT_TRUE(std::isnan(sums.mean().r));
    sums.add(Color(4));
    EXPECT_EQ(sums.mean(), Color(4));
    EXPECT_EQ(sums.variance(), Color(0));
}

TEST(PixelSums, AnInvalidSampleShows) {
    PixelSums sums;
    sums.add({std::nanf(""), 1, 1});
    sums.add(Color(1));
    EXPECT_TRUE(std::isnan(sums.mean().r));
    EXPECT_TRUE(std::isnan(sums.variance().r));
    EXPECT_EQ(sums.mean().g, 1.f);
}

TEST(PixelSums, ManySmallSamplesBesideALargeOneAreNotLost) {
    PixelSums sums;
    sums.add(Color(1e7f));
    for (int i = 0; i < 1000000; ++i) sums.add(Color(0.25f));
    EXPECT_FLOAT_EQ(sums.mean().r, static_cast<float>((1e7 + 250000.0) / 1000001.0));
}

TEST(SamplePasses, CoverAllSamplesOnceAndInOrder) {
    for (std::uint32_t samples = 1; samples < 300; ++samples) {
        const auto passes = samplePasses(samples, true);
        std::uint32_t next = 0;
        for (const SampleRange& pass : passes) {
            EXPECT_EQ(pass.first, next);
            EXPECT_LT(pass.first, pass.last);
            next = pass.last;
        }
        EXPECT_EQ(next, samples);
    }
    EXPECT_EQ(samplePasses(64, false), (std::vector<SampleRange>{{0, 64}}));
    EXPECT_EQ(samplePasses(64, true), (std::vector<SampleRange>{{0, 1}, {1, 2}, {2, 4}, {4, 8}, {8, 16}, {16, 64}}));
    EXPECT_EQ(samplePasses(0xffffffffu, true).back().last, 0xffffffffu);
}

}  // namespace
}  // namespace emca
