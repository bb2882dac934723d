#include "emca/analysis/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "emca/analysis/image_metrics.h"
#include "flip_color.h"
#include "flip_filters.h"

namespace emca::analysis {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const FlipOptions kLow{.range = FlipRange::low};

Image drawn(std::uint32_t width, std::uint32_t height,
            const std::function<Color(std::uint32_t, std::uint32_t)>& color) {
    Image image(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image.setColor({x, y}, color(x, y));
    return image;
}
Image filled(Color c) {
    return drawn(8, 8, [c](auto, auto) { return c; });
}
Image errorOf(const Image& image, const Image& reference, const FlipOptions& options) {
    auto result = flip(image, reference, options);
    EXPECT_TRUE(result.ok());
    return result ? std::move(result->error) : Image();
}
float at(const Image& error, std::uint32_t x, std::uint32_t y) { return *error.at({x, y}); }

Image randomImage(std::uint32_t seed, float top = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, top);
    return drawn(40, 30, [&](auto, auto) { return Color(uniform(random), uniform(random), uniform(random)); });
}

TEST(FlipColor, KnownColors) {
    // CIELAB of Rec. 709's green and blue as textbooks have them; chroma times 0.01 L*.
    const HuntLab green = toHuntLab({0, 1, 0}), blue = toHuntLab({0, 0, 1}), white = toHuntLab({1, 1, 1});
    EXPECT_NEAR(green.l, 87.735f, 2e-2f);
    EXPECT_NEAR(green.a, -86.183f * 0.87735f, 5e-2f);
    EXPECT_NEAR(green.b, 83.180f * 0.87735f, 5e-2f);
    EXPECT_NEAR(blue.l, 32.297f, 2e-2f);
    EXPECT_NEAR(blue.a, 79.188f * 0.32297f, 5e-2f);
    EXPECT_NEAR(blue.b, -107.860f * 0.32297f, 5e-2f);
    EXPECT_NEAR(white.l, 100, 1e-4f);
    EXPECT_NEAR(white.a, 0, 1e-3f);
    EXPECT_NEAR(white.b, 0, 1e-3f);
    const Color back = fromRelativeXyz(toRelativeXyz({0.2f, 0.7f, 0.4f}));
    EXPECT_NEAR(back.r, 0.2f, 1e-6f);
    EXPECT_NEAR(back.g, 0.7f, 1e-6f);
    EXPECT_NEAR(back.b, 0.4f, 1e-6f);
    EXPECT_NEAR(flipColorDifference(green, blue), 1, 1e-6f);
}

TEST(FlipColor, ToneMapperAndItsInverse) {
    for (const double t : {0.01, 0.5, 0.85}) EXPECT_NEAR(acesToneMap(static_cast<float>(acesInverse(t))), t, 1e-6);
    EXPECT_EQ(acesToneMap(0), 0);
    EXPECT_EQ(acesToneMap(-1), 0);
    EXPECT_EQ(acesToneMap(kNaN), 0);
    EXPECT_EQ(acesToneMap(kInf), 1);
}

TEST(FlipFilters, PassConstantsAndMeasureSteps) {
    for (const double ppd : {0.5, 10.0, 67.02, 300.0}) {
        const FlipFilters filters(ppd);
        for (const HalfKernel* kernel : {&filters.achromatic, &filters.redGreen, &filters.blueYellowWide,
                                         &filters.blueYellowNarrow, &filters.smooth}) {
            double sum = static_cast<double>((*kernel)[0]);
            for (std::size_t k = 1; k < kernel->size(); ++k) sum += 2 * static_cast<double>((*kernel)[k]);
            EXPECT_NEAR(sum, 1, 1e-6) << ppd;
        }
    }
    // Radii and shares at the papers' screen, worked out by hand: 3 sqrt(0.04 / 2) / pi degrees and 3 * 0.041 degrees;
    // the sums of the two Gaussians are a sqrt(pi / b) * pi * b, so that they are to each other as a sqrt(b).
    const FlipFilters filters(flipPixelsPerDegree(0.7, 0.7, 3840));
    EXPECT_EQ(filters.blueYellowWide.size(), 11u);
    EXPECT_EQ(filters.smooth.size(), 10u);
    EXPECT_NEAR(filters.wideShare, 34.1 * 0.2 / (34.1 * 0.2 + 13.5 * std::sqrt(0.025)), 2e-3);
    double positive = 0, negative = 0, edge = 0;
    for (std::size_t k = 0; k < filters.point.size(); ++k) {
        (filters.point[k] > 0 ? positive : negative) += static_cast<double>(filters.point[k]) * (k > 0 ? 2 : 1);
        edge += static_cast<double>(filters.edge[k]);
    }
    EXPECT_NEAR(positive, 1, 1e-6);
    EXPECT_NEAR(negative, -1, 1e-6);
    EXPECT_NEAR(edge, 1, 1e-6);
}

/// Row and column filters one after the other are the papers' square filters, also at the borders.
TEST(FlipFilters, EqualTheSquareFilter) {
    const FlipFilters filters(30);
    for (const std::uint32_t width : {7u, 45u}) {
        const std::uint32_t height = 13;
        std::mt19937 random(4);
        std::uniform_real_distribution<float> uniform;
        const Image image = drawn(width, height, [&](auto, auto) { return Color(uniform(random)); });
        const auto pixel = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
            x = std::clamp<std::ptrdiff_t>(x, 0, width - 1);
            y = std::clamp<std::ptrdiff_t>(y, 0, height - 1);
            return static_cast<double>(image.at({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)})[0]);
        };
        PerceivedImage perceived(filters, width, height, [&](std::uint32_t y, std::span<Color> row) {
            for (std::uint32_t x = 0; x < width; ++x) row[x] = image.color({x, y});
        });
        const auto r = static_cast<std::ptrdiff_t>(filters.radius);
        const double sigma = 0.041 * 30, b = 0.0047;
        for (std::uint32_t y = 0; y < height; ++y) {
            const PerceivedRow& row = perceived.row(y);
            for (std::uint32_t x = 0; x < width; ++x) {
                double grey = 0, greySum = 0, edgeX = 0, edgeY = 0, edgeSum = 0, positiveX = 0, negativeX = 0,
                       positive = 0, negative = 0;
                double positiveY = 0, negativeY = 0;
                for (std::ptrdiff_t v = -r; v <= r; ++v)
                    for (std::ptrdiff_t u = -r; u <= r; ++u) {
                        const double value = pixel(x + u, y + v), square = static_cast<double>(u * u + v * v);
                        const double csf = std::exp(-9.869604401 * square / 900 / b);
                        grey += csf * value;
                        greySum += csf;
                        if (std::max(std::abs(u), std::abs(v)) > 4) continue;  // 3 sigma
                        const double g = std::exp(-square / (2 * sigma * sigma)), du = static_cast<double>(u),
                                     dv = static_cast<double>(v);
                        edgeX += du * g * value;
                        edgeY += dv * g * value;
                        edgeSum += std::max(0.0, du * g);
                        const double pu = (du * du / (sigma * sigma) - 1) * g, pv = (dv * dv / (sigma * sigma) - 1) * g;
                        (pu > 0 ? positiveX : negativeX) += pu * value;
                        (pv > 0 ? positiveY : negativeY) += pv * value;
                        (pu > 0 ? positive : negative) += pu;
                    }
                EXPECT_NEAR(row.edge[x], std::hypot(edgeX, edgeY) / edgeSum, 1e-5);
                EXPECT_NEAR(row.point[x],
                            std::hypot(positiveX / positive - negativeX / negative,
                                       positiveY / positive - negativeY / negative),
                            1e-5);
                EXPECT_NEAR(row.color[x].l, 116 * std::cbrt(grey / greySum) - 16, 2e-3) << x << " " << y;
            }
        }
    }
}

TEST(Flip, EqualImagesDoNotDiffer) {
    for (const FlipRange range : {FlipRange::low, FlipRange::high}) {
        const Image image = randomImage(1, 4);
        const Image error = errorOf(image, image, {.range = range});
        EXPECT_EQ(error.channels(), std::vector<std::string>{"FLIP"});
        for (std::size_t i = 0; i < error.size(); ++i) EXPECT_EQ(error.data()[i], 0);
    }
}

TEST(Flip, IsSymmetricAndWithinZeroAndOne) {
    const Image a = randomImage(1, 3), b = randomImage(2, 3);
    const FlipOptions fixed{.range = FlipRange::high, .exposures = FlipExposures{-3, 3, 4}};
    for (const FlipOptions& options : {kLow, fixed}) {
        const Image forth = errorOf(a, b, options), back = errorOf(b, a, options);
        for (std::size_t i = 0; i < forth.size(); ++i) {
            EXPECT_EQ(forth.data()[i], back.data()[i]);
            EXPECT_GT(forth.data()[i], 0);
            EXPECT_LE(forth.data()[i], 1);
        }
    }
}

/// Flat images have no features and pass all filters, so that the difference follows from two numbers: HyAB is 100
/// between black and white, and 203.30 (from CIELAB of textbooks) between the screen's green and blue.
TEST(Flip, BlackAgainstWhiteByHand) {
    const double largest = std::pow(203.30, 0.7), knee = 0.4 * largest;
    const double expected = 0.95 + 0.05 * (std::pow(100, 0.7) - knee) / (largest - knee);
    EXPECT_NEAR(expected, 0.9674, 1e-4);
    EXPECT_NEAR(at(errorOf(filled({1, 1, 1}), filled({0, 0, 0}), kLow), 3, 3), expected, 2e-5);
    EXPECT_NEAR(at(errorOf(filled({0, 1, 0}), filled({0, 0, 1}), kLow), 3, 3), 1, 1e-6);
    // A small difference is on the lower line: L* of 0.5 is 76.07.
    EXPECT_NEAR(at(errorOf(filled(Color(0.5f)), filled({1, 1, 1}), kLow), 3, 3),
                0.95 * std::pow(100 - 76.0693, 0.7) / knee, 5e-5);
}

/// What the authors' own program (version 1.6) says of the same images.
TEST(Flip, EqualsThePublishedImplementation) {
    const auto pattern = [](bool changed, bool high) {
        return drawn(48, 32, [=](std::uint32_t x, std::uint32_t y) {
            Color c(static_cast<float>(x) / 47, static_cast<float>((x / 6 + y / 4) % 2) * 0.75f + 0.125f,
                    static_cast<float>((x * 37 + y * 101) % 64) / 63);
            if (changed) {
                c.r *= 0.875f;
                if ((x + 3 * y) % 29 == 0) c = {1, 0.25f, 0};
                if (x > 30) c.b = static_cast<float>((x * 37 + y * 101 + 5) % 64) / 63;
            }
            return high ? c * (0.015625f * static_cast<float>(1 + y * y)) : c;
        });
    };
    const auto low = errorOf(pattern(true, false), pattern(false, false), kLow);
    EXPECT_NEAR(meanOf(low), 0.1912072, 1e-5);
    EXPECT_NEAR(at(low, 0, 0), 0.816836, 5e-5);
    EXPECT_NEAR(at(low, 20, 10), 0.154811, 5e-5);
    EXPECT_NEAR(at(low, 31, 16), 0.217306, 5e-5);
    EXPECT_NEAR(at(low, 47, 31), 0.291572, 5e-5);

    const auto high = flip(pattern(true, true), pattern(false, true));
    ASSERT_TRUE(high.ok());
    EXPECT_NEAR(high->exposures.start, -2.614050, 2e-6);
    EXPECT_NEAR(high->exposures.stop, 0.598340, 2e-6);
    EXPECT_EQ(high->exposures.count, 4u);
    EXPECT_NEAR(meanOf(high->error), 0.1497978, 1e-5);
    EXPECT_NEAR(at(high->error, 0, 0), 0.048977, 5e-5);
    EXPECT_NEAR(at(high->error, 20, 10), 0.141290, 5e-5);
    EXPECT_NEAR(at(high->error, 31, 16), 0.168564, 5e-5);
    EXPECT_NEAR(at(high->error, 47, 31), 0.174988, 5e-5);
}

TEST(Flip, AnEdgeThatMovedByAPixelIsSeenThereAndNowhereElse) {
    const auto edge = [](std::uint32_t column) {
        return drawn(64, 16, [column](std::uint32_t x, auto) { return Color(x < column ? 0.f : 1.f); });
    };
    const Image error = errorOf(edge(32), edge(33), kLow);
    float largest = 0;
    for (std::uint32_t x = 29; x < 36; ++x) largest = std::max(largest, at(error, x, 8));
    EXPECT_GT(largest, 0.6f);
    const auto radius = static_cast<std::uint32_t>(FlipFilters(67.02).radius);
    for (std::uint32_t x = 0; x < 64; ++x) {
        EXPECT_EQ(at(error, x, 8), at(error, x, 0)) << "rows are alike";
        EXPECT_LE(at(error, x, 8), largest);
        if (x + radius < 32 || x > 32 + radius) {
            EXPECT_EQ(at(error, x, 8), 0) << x;
        }
    }
    // One that moved by two differs more.
    EXPECT_GT(meanOf(errorOf(edge(32), edge(34), kLow)), 1.1 * meanOf(error));
}

TEST(Flip, FinePatternsVanishWithDistance) {
    const Image checkers =
        drawn(96, 96, [](std::uint32_t x, std::uint32_t y) { return Color((x + y) % 2 == 0 ? 0.4f : 0.6f); });
    const Image grey = drawn(96, 96, [](auto, auto) { return Color(0.5f); });
    float before = 1;
    for (const double ppd : {20.0, 30.0, 45.0, 67.0}) {
        const float inside =
            at(errorOf(checkers, grey, {.range = FlipRange::low, .pixelsPerDegree = ppd}), 48, 48);  // far from borders
        EXPECT_LT(inside, before) << ppd;
        before = inside;
    }
    EXPECT_LT(before, 0.001f);
}

TEST(Flip, HighRangeKnowsNoUnit) {
    const Image a = randomImage(1, 9), b = randomImage(2, 9);
    Image a64 = a, b64 = b;
    for (std::size_t i = 0; i < a.size(); ++i) {
        a64.data()[i] *= 64;
        b64.data()[i] *= 64;
    }
    const auto one = flip(a, b), other = flip(a64, b64);
    ASSERT_TRUE(one.ok() && other.ok());
    EXPECT_NEAR(one->exposures.start, other->exposures.start + 6, 1e-12);
    EXPECT_EQ(one->exposures.count, other->exposures.count);
    for (std::size_t i = 0; i < one->error.size(); ++i)
        EXPECT_NEAR(one->error.data()[i], other->error.data()[i], 1e-5f);
}

TEST(Flip, HighRangeIsTheLargestOfItsExposures) {
    const Image a = randomImage(1, 5), b = randomImage(2, 5);
    const FlipExposures all{-4, 2, 3};
    const Image error = errorOf(a, b, {.exposures = all});
    std::vector<Image> single;
    for (std::uint32_t i = 0; i < 3; ++i)
        single.push_back(errorOf(a, b, {.exposures = FlipExposures{all.at(i), all.at(i), 1}}));
    for (std::size_t i = 0; i < error.size(); ++i)
        EXPECT_EQ(error.data()[i], std::max({single[0].data()[i], single[1].data()[i], single[2].data()[i]}));
}

TEST(Flip, ExposuresByTheRuleOfThePaper) {
    // The brightest pixel and the median (of an even number of pixels the larger one) come out at 0.85.
    const Image image = drawn(4, 1, [](std::uint32_t x, auto) {
        return Color(x == 3 ? 600.f : std::exp2(static_cast<float>(x * x)));
    });  // 1, 2, 16, 600
    const FlipExposures e = automaticExposures(image);
    EXPECT_NEAR(acesToneMap(static_cast<float>(std::exp2(e.start) * 600)), 0.85, 1e-5);
    EXPECT_NEAR(acesToneMap(static_cast<float>(std::exp2(e.stop) * 16)), 0.85, 1e-5);
    EXPECT_EQ(e.count, 6u);  // log2(600 / 16) = 5.2
    // Where the paper says nothing.
    const Image dark = drawn(4, 1, [](std::uint32_t x, auto) { return Color(x == 3 ? 2.f : x == 0 ? kNaN : 0.f); });
    EXPECT_EQ(automaticExposures(dark).count, 1u);
    EXPECT_NEAR(automaticExposures(dark).start, std::log2(acesInverse(0.85) / 2), 1e-6);
    EXPECT_EQ(automaticExposures(filled({0, 0, 0})).count, 1u);
    EXPECT_EQ(automaticExposures(Image()).count, 1u);
}

TEST(Flip, WhatIsNoNumberStaysWhereItIs) {
    for (const FlipRange range : {FlipRange::low, FlipRange::high}) {
        Image a = randomImage(1), b = a;
        a.at({20, 15})[1] = kNaN;
        a.setColor({3, 3}, {kNaN, kInf, -kInf});
        b.setColor({3, 3}, {kNaN, 1, -5});
        a.setColor({30, 3}, Color(kInf));
        b.setColor({30, 3}, Color(1e30f));
        const Image error = errorOf(a, b, {.range = range, .exposures = FlipExposures{-1, 1, 2}});
        EXPECT_TRUE(std::isnan(at(error, 20, 15)));
        EXPECT_EQ(at(error, 30, 3), 0) << "both are white";
        for (std::uint32_t y = 0; y < 30; ++y)
            for (std::uint32_t x = 0; x < 40; ++x) EXPECT_TRUE(std::isfinite(at(error, x, y)) || (x == 20 && y == 15));
    }
}

TEST(Flip, GreyIsThreeEqualChannels) {
    Image grey(40, 30, {"Y"});
    for (std::size_t i = 0; i < grey.size(); ++i) grey.data()[i] = static_cast<float>(i % 17) / 17;
    const Image color = drawn(40, 30, [&](std::uint32_t x, std::uint32_t y) { return Color(*grey.at({x, y})); });
    EXPECT_EQ(meanOf(errorOf(grey, color, kLow)), 0);
}

TEST(Flip, RefusesNonsense) {
    const Image image = filled({1, 1, 1});
    EXPECT_FALSE(flip(image, Image(3, 4)).ok());
    for (const double ppd : {0.0, -1.0, 1e9, static_cast<double>(kNaN)})
        EXPECT_FALSE(flip(image, image, {.pixelsPerDegree = ppd}).ok());
    for (const FlipExposures& e : {FlipExposures{0, 0, 0}, FlipExposures{0, 1e9, 2},
                                   FlipExposures{static_cast<double>(kNaN), 0, 2}, FlipExposures{0, 1, 100000}})
        EXPECT_FALSE(flip(image, image, {.exposures = e}).ok());
    EXPECT_TRUE(flip(Image(), Image()).ok());
}

TEST(Flip, ProgressGrowsToOneAndCanEndTheWork) {
    Image image(12, 9), reference(12, 9);
    reference.setColor({3, 3}, {1, 4, 2});
    image.setColor({5, 5}, {9, 1, 0});
    double last = 0;
    FlipOptions options;
    options.exposures = FlipExposures{-2, 2, 3};
    options.progress = [&](double fraction) {
        EXPECT_GT(fraction, last);
        last = fraction;
        return true;
    };
    ASSERT_TRUE(flip(image, reference, options));
    EXPECT_DOUBLE_EQ(last, 1);
    int calls = 0;
    options.progress = [&](double) { return ++calls < 10; };
    const auto ended = flip(image, reference, options);
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, ErrorCode::cancelled);
    EXPECT_EQ(calls, 10);
}

}  // namespace
}  // namespace emca::analysis
