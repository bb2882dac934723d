#include "emca/render/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

TEST(Spectrum, MatchingFunctionsAgreeWithTheTable) {
    // CIE 1931 (CIE 015:2018, table 6); the fit's stated errors are of the order of one percent of the peak.
    struct Row { double wavelength; Vec3d xyz; };
    const Row rows[] = {{450, {0.3362, 0.0380, 1.7721}}, {500, {0.0049, 0.3230, 0.2720}}, {550, {0.4334, 0.9950, 0.0087}},
                        {600, {1.0622, 0.6310, 0.0008}}, {650, {0.2835, 0.1070, 0.0000}}};
    for (const auto& [wavelength, xyz] : rows) {
        const Vec3d fit = cieXyz(wavelength);
        EXPECT_NEAR(fit.x, xyz.x, 0.02) << wavelength;
        EXPECT_NEAR(fit.y, xyz.y, 0.02) << wavelength;
        EXPECT_NEAR(fit.z, xyz.z, 0.04) << wavelength;
    }
}

TEST(Spectrum, ReflectanceOfOneIsWhite) {
    const SpectrumSample one[] = {{300, 1}, {900, 1}};
    const Color white = toRgb(one, SpectrumUse::ratio);
    EXPECT_NEAR(white.r, 1, 1e-6);
    EXPECT_NEAR(white.g, 1, 1e-6);
    EXPECT_NEAR(white.b, 1, 1e-6);
}

TEST(Spectrum, ScalesLinearlyAndForgetsTheOrder) {
    const SpectrumSample up[] = {{400, 0.1}, {500, 0.2}, {600, 0.6}, {700, 0.5}};
    const SpectrumSample shuffledAndDoubled[] = {{600, 1.2}, {400, 0.2}, {700, 1.0}, {500, 0.4}};
    const Color a = toRgb(up, SpectrumUse::ratio), b = toRgb(shuffledAndDoubled, SpectrumUse::ratio);
    EXPECT_NEAR(b.r, 2 * a.r, 1e-6);
    EXPECT_NEAR(b.g, 2 * a.g, 1e-6);
    EXPECT_NEAR(b.b, 2 * a.b, 1e-6);
    EXPECT_GT(a.r, a.g);
    EXPECT_GT(a.g, a.b);
}

TEST(Spectrum, RefiningALinearSpectrumChangesNothing) {
    const SpectrumSample coarse[] = {{400, 0}, {700, 1}};
    std::vector<SpectrumSample> fine;
    for (int i = 0; i <= 41; ++i)
        fine.push_back({400 + 300.0 * i / 41, i / 41.0});
    const Color a = toRgb(coarse, SpectrumUse::light), b = toRgb(fine, SpectrumUse::light);
    EXPECT_NEAR(a.r, b.r, 1e-6);
    EXPECT_NEAR(a.g, b.g, 1e-6);
    EXPECT_NEAR(a.b, b.b, 1e-6);
}

TEST(Spectrum, FlatLightHasItsValueAsLuminanceAndIsReddish) {
    const SpectrumSample flat[] = {{360, 3}, {830, 3}};
    const Color light = toRgb(flat, SpectrumUse::light);
    EXPECT_NEAR(luminance(light), 3, 2e-3);
    // Illuminant E in linear Rec. 709.
    EXPECT_NEAR(light.r / 3, 1.205, 0.01);
    EXPECT_NEAR(light.g / 3, 0.948, 0.01);
    EXPECT_NEAR(light.b / 3, 0.909, 0.01);
}

TEST(Spectrum, OneColourOutsideOfTheGamutIsNotNegative) {
    const SpectrumSample green[] = {{510, 0}, {515, 1}, {520, 0}};
    const Color color = toRgb(green, SpectrumUse::light);
    EXPECT_EQ(color.r, 0);
    EXPECT_GT(color.g, 0);
}

/// CIE xy of a linear Rec. 709 colour.
Vec2d chromaticity(Color c) {
    const double r = double(c.r), g = double(c.g), b = double(c.b);
    const double x = 0.4124564 * r + 0.3575761 * g + 0.1804375 * b;
    const double y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
    const double z = 0.0193339 * r + 0.1191920 * g + 0.9503041 * b;
    return {x / (x + y + z), y / (x + y + z)};
}

TEST(Spectrum, BlackbodiesLieOnThePlanckianLocus) {
    // Wyszecki and Stiles, "Color Science", table 1(3.11).
    struct Row { double kelvin, x, y; };
    for (const auto& [kelvin, x, y] : {Row{2856, 0.4475, 0.4074}, Row{4000, 0.3805, 0.3768}, Row{6504, 0.3135, 0.3237}}) {
        const Vec2d xy = chromaticity(blackbodyRgb(kelvin));
        EXPECT_NEAR(xy.x, x, 0.004) << kelvin;
        EXPECT_NEAR(xy.y, y, 0.004) << kelvin;
    }
}

TEST(Spectrum, BlackbodyHasThePlanckianRadiance) {
    // Luminance is the mean of the radiance weighted by y, so it lies near the radiance at 560 nm:
    // 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1) = 2.15e4 W/(sr m^2 nm) at 5,778 K.
    const double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23, lambda = 560e-9;
    const double radiance = 2 * h * c * c / std::pow(lambda, 5) / (std::exp(h * c / (lambda * k * 5778)) - 1) * 1e-9;
    EXPECT_NEAR(double(luminance(blackbodyRgb(5778))) / radiance, 1, 0.02);
}

TEST(Spectrum, ParsesPairs) {
    const auto samples = parseSpectrum(" 400:0.1, 500:0.2\n600:1e-1 ");
    ASSERT_TRUE(samples.ok()) << samples.error().message;
    EXPECT_EQ(*samples, (std::vector<SpectrumSample>{{400, 0.1}, {500, 0.2}, {600, 0.1}}));
    for (const char* bad : {"400", "400:", ":1", "400:1:2", "400:x", "400:nan"})
        EXPECT_FALSE(parseSpectrum(bad).ok()) << bad;
}

TEST(Spectrum, ReadsFiles) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.spd", "# a comment\n400 0.5\r\n\n 700\t0.25 # another\n");
    const auto samples = readSpectrumFile(path);
    ASSERT_TRUE(samples.ok()) << samples.error().message;
    EXPECT_EQ(*samples, (std::vector<SpectrumSample>{{400, 0.5}, {700, 0.25}}));
    const auto bad = readSpectrumFile(folder.write("b.spd", "400 1\n500 1 2\n"));
    ASSERT_FALSE(bad.ok());
    EXPECT_NE(bad.error().message.find("b.spd:2:"), std::string::npos) << bad.error().message;
    EXPECT_EQ(readSpectrumFile(folder.path() / "none.spd").error().code, ErrorCode::fileNotFound);
}

TEST(Spectrum, DecodesSrgb) {
    EXPECT_EQ(srgbToLinear(0), 0);
    EXPECT_NEAR(srgbToLinear(1), 1, 1e-6);
    EXPECT_NEAR(srgbToLinear(0.5f), 0.21404f, 1e-5);
    EXPECT_NEAR(srgbToLinear(0.04045f), 0.0031308f, 1e-6);
}

}  // namespace
}  // namespace emca::render
