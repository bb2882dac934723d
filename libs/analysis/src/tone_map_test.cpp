#include "emca/analysis/tone_map.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace emca::analysis {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Srgb, PublishedPoints) {
    // 18 % grey is 118 of 255 (117.6); half light is 188; the linear piece has slope 12.92.
    EXPECT_NEAR(encodeSrgb(0.18f) * 255, 117.64f, 0.02f);
    EXPECT_NEAR(encodeSrgb(0.5f) * 255, 187.52f, 0.02f);
    EXPECT_FLOAT_EQ(encodeSrgb(0.001f), 0.01292f);
    EXPECT_FLOAT_EQ(encodeSrgb(0), 0);
    EXPECT_NEAR(encodeSrgb(1), 1, 1e-7f);
    EXPECT_NEAR(decodeSrgb(0.5f), 0.21404114f, 1e-7f);
    EXPECT_FLOAT_EQ(encodeSrgb(-0.5f), -encodeSrgb(0.5f));
}

TEST(Srgb, RoundTrip) {
    for (int i = -1000; i <= 3000; ++i) {
        const float x = static_cast<float>(i) / 1000;
        EXPECT_NEAR(decodeSrgb(encodeSrgb(x)), x, 2e-6f * std::max(1.f, std::abs(x)));
    }
    for (int i = 0; i < 256; ++i) {
        const float encoded = static_cast<float>(i) / 255;
        EXPECT_EQ(std::lround(encodeSrgb(decodeSrgb(encoded)) * 255), i);
        EXPECT_EQ(ToneMapper().channel(decodeSrgb(encoded)), i);
    }
}

TEST(ToneMapper, TableEqualsTheFormulaRounded) {
    std::mt19937_64 random(3);
    for (const ToneMap settings : {ToneMap{}, ToneMap{0, Transfer::gamma, 2.2f}, ToneMap{0, Transfer::gamma, 0.25f},
                                   ToneMap{0, Transfer::gamma, 8.f}, ToneMap{0, Transfer::linear}}) {
        const ToneMapper mapper(settings);
        const auto exact = [&](double x) {
            if (settings.transfer == Transfer::linear) return x;
            if (settings.transfer == Transfer::gamma) return std::pow(x, 1 / static_cast<double>(settings.gamma));
            return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
        };
        for (int i = 0; i < 200000; ++i) {
            // Any positive float below 1 is as likely as any other; half of them are uniform in value instead.
            const auto bits = static_cast<std::uint32_t>(random() % 0x3f800000u);
            const float x = i % 2 ? std::bit_cast<float>(bits) : static_cast<float>(random() >> 40) * 0x1p-24f;
            ASSERT_EQ(mapper.channel(x), static_cast<int>(std::floor(exact(static_cast<double>(x)) * 255 + 0.5)))
                << x << " gamma " << settings.gamma;
        }
    }
}

TEST(ToneMapper, ExposureIsInStopsAndValuesClamp) {
    const ToneMapper mapper({-2, Transfer::linear});
    EXPECT_EQ(mapper.channel(4), 255);
    EXPECT_EQ(mapper.channel(2), 128);
    EXPECT_EQ(mapper.channel(1e30f), 255);
    EXPECT_EQ(mapper.channel(kInf), 255);
    EXPECT_EQ(mapper.channel(-1), 0);
    EXPECT_EQ(mapper.channel(-kInf), 0);
    EXPECT_EQ(mapper.channel(kNaN), 0);
    EXPECT_EQ(mapper.channel(-0.f), 0);
    EXPECT_TRUE(mapper.clips(Color(4.01f, 0, 0)));
    EXPECT_FALSE(mapper.clips(Color(4, 4, 4)));
    EXPECT_EQ(ToneMapper({kNaN}).channel(1), 255);
    EXPECT_EQ(ToneMapper({1e9f}).channel(0), 0);
}

TEST(ToneMapper, MarksWhatNoScreenCanShow) {
    Image image(5, 1);
    image.setColor({0, 0}, {kNaN, 0, 0});
    image.setColor({1, 0}, {0, kInf, 0});
    image.setColor({2, 0}, {1, 1, -0.1f});
    image.setColor({3, 0}, {0.5f, 0, 0});
    image.setColor({4, 0}, {-0.f, 0, 1});
    std::vector<std::uint8_t> rgba(20);
    const auto at = [&](std::size_t i) {
        return Color8{rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]};
    };
    ToneMapper().convert(image, rgba);
    EXPECT_EQ(at(0), kNaNColor);
    EXPECT_EQ(at(1), kInfinityColor);
    EXPECT_EQ(at(2), kNegativeColor);
    EXPECT_EQ(at(3), (Color8{188, 0, 0}));
    EXPECT_EQ(at(4), (Color8{0, 0, 255}));  // a negative zero is no negative value
    ToneMap plain;
    plain.markInvalid = false;
    ToneMapper(plain).convert(image, rgba);
    EXPECT_EQ(at(0), (Color8{0, 0, 0}));
    EXPECT_EQ(at(1), (Color8{0, 255, 0}));
    EXPECT_EQ(at(2), (Color8{255, 255, 0}));
}

TEST(ToneMapper, StripesOnClippedPixelsOnly) {
    Image image(16, 16);
    for (std::uint32_t y = 0; y < 16; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) image.setColor({x, y}, Color(y < 8 ? 1.f : 2.f));
    ToneMap settings;
    settings.markClipped = true;
    std::vector<std::uint8_t> rgba(4 * 256);
    ToneMapper(settings).convert(image, rgba);
    int upper = 0, lower = 0;
    for (std::size_t i = 0; i < 256; ++i) (i < 128 ? upper : lower) += rgba[4 * i] == 0;
    EXPECT_EQ(upper, 0);
    EXPECT_GT(lower, 32);
    EXPECT_LT(lower, 96);
}

TEST(ToneMapper, RowsSharedAmongThreadsGiveTheSameImage) {
    std::mt19937 random(4);
    Image image(33, 17);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<float>(random()) * 0x1p-31f;
    std::vector<std::uint8_t> whole(4 * 33 * 17), parts(whole.size());
    const ToneMapper mapper;
    mapper.convert(image, whole);
    mapper.convert(image, parts, 9, 100);
    mapper.convert(image, parts, 0, 9);
    EXPECT_EQ(whole, parts);
    for (std::uint32_t y = 0; y < 17; ++y)
        for (std::uint32_t x = 0; x < 33; ++x) {
            const Color8 c = mapper.color(image.color({x, y}));
            EXPECT_EQ(whole[4 * (y * 33 + x) + 1], c.g);
        }
}

TEST(ToneMapper, GreyAndChannelImages) {
    Image grey(2, 1, {"Y"});
    grey.data()[1] = 0.5f;
    std::vector<std::uint8_t> rgba(8);
    ToneMapper().convert(grey, rgba);
    EXPECT_EQ(rgba, (std::vector<std::uint8_t>{0, 0, 0, 255, 188, 188, 188, 255}));
    Image color(1, 1, {"R", "G", "B", "A"});
    color.setColor({0, 0}, {0, 0.5f, 1});
    rgba.resize(4);
    ToneMapper().convertChannel(color, {1}, rgba);
    EXPECT_EQ(rgba, (std::vector<std::uint8_t>{188, 188, 188, 255}));
    EXPECT_FLOAT_EQ(scalar(color, {0, 0}, {}), 0.7152f * 0.5f + 0.0722f);
    EXPECT_EQ(scalar(color, {0, 0}, {2}), 1);
}

TEST(FalseColor, EqualsTheMapOfEachPixel) {
    std::mt19937 random(5);
    Image image(64, 8, {"Y"});
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = std::exp2(static_cast<float>(random()) * 0x1p-27f - 16);
    image.data()[0] = kNaN;
    image.data()[1] = kInf;
    image.data()[2] = 0;
    image.data()[3] = -1;
    const ColorMap& map = ColorMap::get(ColorMapId::viridis);
    std::vector<std::uint8_t> rgba(4 * image.size());
    for (const ValueRange range : {ValueRange{0, 1000, false}, ValueRange{1e-3, 1000, true}}) {
        falseColor(image, {}, map, range, rgba);
        const auto at = [&](std::size_t i) {
            return Color8{rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]};
        };
        EXPECT_EQ(at(0), kNaNColor);
        EXPECT_EQ(at(1), kInfinityColor);
        EXPECT_EQ(at(2), map.entries()[0]);
        EXPECT_EQ(at(3), map.entries()[0]);
        for (std::size_t i = 4; i < image.size(); ++i) {
            const double t = range.position(static_cast<double>(image.data()[i])) * 256;
            // At the edge between two entries either is right.
            if (std::abs(t - std::round(t)) < 1e-3) continue;
            EXPECT_EQ(at(i), map.map(static_cast<double>(image.data()[i]), range));
        }
    }
}

}  // namespace
}  // namespace emca::analysis
