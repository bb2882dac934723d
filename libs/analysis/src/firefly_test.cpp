#include "emca/analysis/firefly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace emca::analysis {
namespace {

Image noisy(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(1);
    Image image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = 0.5f + static_cast<float>(random()) * 0x1p-32f;
    return image;
}

TEST(Fireflies, AreFoundMostStrikingFirst) {
    Image image = noisy(64, 48);
    image.setColor({10, 10}, Color(100));
    image.setColor({0, 0}, Color(400));
    image.setColor({63, 47}, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
    const auto found = findFireflies(image);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].pixel, (Pixel{63, 47}));
    EXPECT_TRUE(std::isinf(found[0].ratio));
    EXPECT_EQ(found[1].pixel, (Pixel{0, 0}));
    EXPECT_EQ(found[2].pixel, (Pixel{10, 10}));
    EXPECT_NEAR(found[2].neighbours, 1, 0.25);
    EXPECT_NEAR(found[2].ratio, 100 / (found[2].neighbours + 0.05f), 1);
}

TEST(Fireflies, BrightObjectsAndNoiseAreNone) {
    Image image = noisy(64, 48);
    for (std::uint32_t y = 10; y < 20; ++y)
        for (std::uint32_t x = 10; x < 20; ++x) image.setColor({x, y}, Color(1000));
    // Not even its corners, where the median of the neighbours is dark.
    EXPECT_TRUE(findFireflies(image).empty());
    EXPECT_TRUE(findFireflies(noisy(64, 48)).empty());
}

TEST(Fireflies, DimSpotsInBlackCornersAreNone) {
    Image image = noisy(64, 48);
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) image.setColor({x, y}, Color(0.f));
    image.setColor({5, 5}, Color(0.01f));
    for (const Firefly& f : findFireflies(image)) EXPECT_NE(f.pixel, (Pixel{5, 5}));
    image.setColor({5, 5}, Color(10));
    ASSERT_FALSE(findFireflies(image).empty());
    EXPECT_EQ(findFireflies(image)[0].pixel, (Pixel{5, 5}));
}

TEST(Fireflies, LimitsAndTinyImages) {
    Image image = noisy(32, 32);
    for (std::uint32_t i = 0; i < 32; i += 8) image.setColor({i, i}, Color(50 + static_cast<float>(i)));
    const auto two = findFireflies(image, {.maximum = 2});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_GE(two[0].ratio, two[1].ratio);
    EXPECT_TRUE(findFireflies(Image()).empty());
    EXPECT_TRUE(findFireflies(Image(1, 1)).empty());
    Image black(8, 8);
    EXPECT_TRUE(findFireflies(black).empty());
    black.setColor({3, 3}, Color(1));
    EXPECT_EQ(findFireflies(black).size(), 1u);
}

}  // namespace
}  // namespace emca::analysis
