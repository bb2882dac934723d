#include "emca/analysis/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "emca/analysis/tone_map.h"

namespace emca::analysis {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// CIE L*, in [0, 100].
double lightness(Color8 c) {
    const auto linear = [](std::uint8_t v) { return decodeSrgb(static_cast<float>(v) / 255.f); };
    const double y = static_cast<double>(luminance(Color(linear(c.r), linear(c.g), linear(c.b))));
    return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(ColorMap, PublishedEndsAndMiddles) {
    // First and last colours as their authors print them.
    EXPECT_EQ(ColorMap::get(ColorMapId::viridis).map(0), (Color8{0x44, 0x01, 0x54}));
    EXPECT_EQ(ColorMap::get(ColorMapId::viridis).map(1), (Color8{0xfd, 0xe7, 0x25}));
    EXPECT_EQ(ColorMap::get(ColorMapId::plasma).map(0), (Color8{0x0d, 0x08, 0x87}));
    EXPECT_EQ(ColorMap::get(ColorMapId::inferno).map(1), (Color8{0xfc, 0xff, 0xa4}));
    EXPECT_EQ(ColorMap::get(ColorMapId::magma).map(1), (Color8{0xfc, 0xfd, 0xbf}));
    EXPECT_EQ(ColorMap::get(ColorMapId::turbo).map(0), (Color8{0x30, 0x12, 0x3b}));
    EXPECT_EQ(ColorMap::get(ColorMapId::cividis).map(0), (Color8{0x00, 0x22, 0x4e}));
    EXPECT_EQ(ColorMap::get(ColorMapId::grey).map(0.5), (Color8{128, 128, 128}));
}

TEST(ColorMap, LightnessRisesInPerceptualMaps) {
    for (const ColorMapId id : {ColorMapId::viridis, ColorMapId::plasma, ColorMapId::inferno, ColorMapId::magma,
                                ColorMapId::cividis, ColorMapId::grey}) {
        const ColorMap& map = ColorMap::get(id);
        double least = lightness(map.entries()[0]);
        for (std::size_t i = 1; i < 256; ++i) {
            const double l = lightness(map.entries()[i]);
            // A step of one in the blue channel moves L* by less than 0.3: rounding to 8 bits may go back that far.
            EXPECT_GT(l, least - 0.3) << map.name() << " entry " << i;
            least = std::max(least, l);
        }
        EXPECT_GT(lightness(map.entries()[255]) - lightness(map.entries()[0]), 50) << map.name();
    }
}

TEST(ColorMap, DivergingMapsAreDarkInTheMiddleAndSymmetric) {
    for (const ColorMapId id : {ColorMapId::redGreen, ColorMapId::blueOrange}) {
        const ColorMap& map = ColorMap::get(id);
        EXPECT_TRUE(map.isDiverging());
        EXPECT_EQ(map.map(0.4999), (Color8{0, 0, 0}));
        EXPECT_EQ(map.map(0.5), (Color8{0, 0, 0}));
        for (std::size_t i = 0; i < 127; ++i) {
            EXPECT_GE(lightness(map.entries()[i]), lightness(map.entries()[i + 1]));
            EXPECT_LE(lightness(map.entries()[254 - i]), lightness(map.entries()[255 - i]));
        }
    }
    EXPECT_GT(ColorMap::get(ColorMapId::redGreen).map(0).r, 200);
    EXPECT_GT(ColorMap::get(ColorMapId::redGreen).map(1).g, 200);
}

TEST(ColorMap, WarningColorsAreInNoMapAndNaNIsOne) {
    for (std::size_t m = 0; m < kColorMapCount; ++m) {
        const ColorMap& map = ColorMap::get(static_cast<ColorMapId>(m));
        for (const Color8 c : map.entries())
            for (const Color8 warning : {kNaNColor, kInfinityColor, kNegativeColor}) {
                const int distance = std::abs(c.r - warning.r) + std::abs(c.g - warning.g) + std::abs(c.b - warning.b);
                EXPECT_GT(distance, 40) << map.name();
            }
        EXPECT_EQ(map.map(kNaN), kNaNColor);
        EXPECT_EQ(map.map(-kInf), map.entries()[0]);
        EXPECT_EQ(map.map(kInf), map.entries()[255]);
        EXPECT_EQ(map.map(1e300), map.entries()[255]);
    }
}

TEST(ColorMap, NamesFindTheirMaps) {
    std::set<std::string_view> names;
    for (std::size_t m = 0; m < kColorMapCount; ++m) {
        const auto id = static_cast<ColorMapId>(m);
        EXPECT_EQ(colorMapByName(name(id)), id);
        EXPECT_EQ(ColorMap::get(id).id(), id);
        names.insert(name(id));
    }
    EXPECT_EQ(names.size(), kColorMapCount);
    EXPECT_FALSE(colorMapByName("jet"));
}

TEST(ValueRange, PositionAndValueAreInverse) {
    for (const ValueRange range : {ValueRange{-3, 7, false}, ValueRange{1e-5, 1e4, true}}) {
        EXPECT_DOUBLE_EQ(range.position(range.min), 0);
        EXPECT_DOUBLE_EQ(range.position(range.max), 1);
        for (double t = -0.5; t <= 1.5; t += 0.125) EXPECT_NEAR(range.position(range.value(t)), t, 1e-12);
    }
    EXPECT_DOUBLE_EQ((ValueRange{1, 100, true}.position(10)), 0.5);
    EXPECT_EQ((ValueRange{1, 100, true}.position(0)), -kInf);
    EXPECT_TRUE(std::isnan(ValueRange{}.position(kNaN)));
}

TEST(ValueRange, RepairedIsValidForAnyInput) {
    const double ends[] = {kNaN, kInf, -kInf, 0, -0.0, 1, -1, 5e-324, 1e308, -1e308, 1e-300, 3};
    for (const double min : ends)
        for (const double max : ends)
            for (const bool log : {false, true}) {
                const ValueRange range{min, max, log};
                const ValueRange repaired = range.repaired();
                EXPECT_TRUE(repaired.isValid())
                    << min << " " << max << " " << log << " -> " << repaired.min << " " << repaired.max;
                EXPECT_EQ(repaired.log, log);
                if (range.isValid()) {
                    EXPECT_EQ(repaired, range);
                }
            }
    EXPECT_EQ((ValueRange{5, 2, false}.repaired()), (ValueRange{2, 5, false}));
    EXPECT_EQ((ValueRange{0, 10, true}.repaired()), (ValueRange{10 * 1e-6, 10, true}));
}

}  // namespace
}  // namespace emca::analysis
