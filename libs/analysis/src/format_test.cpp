#include "emca/analysis/format.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace emca::analysis {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(FormatNumber, HasFourSignificantDigits) {
    EXPECT_EQ(formatNumber(1), "1.000");
    EXPECT_EQ(formatNumber(-1), "-1.000");
    EXPECT_EQ(formatNumber(0.012345), "0.01235");
    EXPECT_EQ(formatNumber(123.45), "123.5");
    EXPECT_EQ(formatNumber(1234), "1234");
    EXPECT_EQ(formatNumber(9999.4), "9999");
    EXPECT_EQ(formatNumber(9999.6), "1.000e+04");
    EXPECT_EQ(formatNumber(123449), "1.234e+05");
    EXPECT_EQ(formatNumber(0.0001), "0.0001000");
    EXPECT_EQ(formatNumber(0.00009999), "9.999e-05");
    EXPECT_EQ(formatNumber(0.000099999), "0.0001000");
    EXPECT_EQ(formatNumber(5e-324), "4.941e-324");
    EXPECT_EQ(formatNumber(1.7976931348623157e308), "1.798e+308");
}

TEST(FormatNumber, KeepsTheSignOfZeroAndWritesWords) {
    EXPECT_EQ(formatNumber(0.0), "0");
    EXPECT_EQ(formatNumber(-0.0), "-0");
    EXPECT_EQ(formatNumber(kNaN), "NaN");
    EXPECT_EQ(formatNumber(-kNaN), "NaN");
    EXPECT_EQ(formatNumber(kInf), "Infinity");
    EXPECT_EQ(formatNumber(-kInf), "-Infinity");
    for (const double v : {kNaN, kInf, -kInf}) EXPECT_TRUE(isNonFiniteWord(formatNumber(v)));
    EXPECT_FALSE(isNonFiniteWord("1.000"));
}

TEST(FormatNumber, ReadsBackWithinHalfAUnitOfTheFourthDigit) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i) {
        const double v = std::bit_cast<double>(random());
        if (!std::isfinite(v) || std::abs(v) < 1e-300) continue;
        const std::string text = formatNumber(v);
        EXPECT_LE(std::abs(std::strtod(text.c_str(), nullptr) - v), 0.50001e-3 * std::abs(v)) << text;
        EXPECT_LE(text.size(), 11u) << text;
    }
}

TEST(FormatNumber, IgnoresTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    // Where German is not installed there is nothing to go wrong; the assertion still holds.
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    EXPECT_EQ(formatNumber(1.5), "1.500");
    EXPECT_EQ(formatFull(1.5), "1.5");
    std::setlocale(LC_ALL, before.c_str());
}

TEST(FormatFull, ReadsBackAsTheSameBits) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20000; ++i) {
        const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        const float readFloat = std::strtof(formatFull(f).c_str(), nullptr);
        EXPECT_TRUE(!std::isfinite(f) || std::bit_cast<std::uint32_t>(readFloat) == std::bit_cast<std::uint32_t>(f))
            << f;
        const auto d = std::bit_cast<double>(random());
        const double readDouble = std::strtod(formatFull(d).c_str(), nullptr);
        EXPECT_TRUE(!std::isfinite(d) || std::bit_cast<std::uint64_t>(readDouble) == std::bit_cast<std::uint64_t>(d))
            << d;
    }
    EXPECT_EQ(formatFull(0.1f), "0.1");
    EXPECT_EQ(formatFull(kNaN), "NaN");
}

TEST(FormatValue, WritesEveryTypeOnOneLine) {
    EXPECT_EQ(formatValue(true), "true");
    EXPECT_EQ(formatValue(std::int64_t(123456789)), "123456789");
    EXPECT_EQ(formatValue(Vec2i{1, -2}), "(1, -2)");
    EXPECT_EQ(formatValue(0.5f), "0.5000");
    EXPECT_EQ(formatValue(Vec3f{1, 0, 2}), "(1.000, 0, 2.000)");
    EXPECT_EQ(formatValue(1e-9), "1.000e-09");
    EXPECT_EQ(formatValue(Color(1, 2, 3)), "(1.000, 2.000, 3.000)");
    EXPECT_EQ(formatValue(ColorA{1, 2, 3, 0.5f}), "(1.000, 2.000, 3.000, 0.5000)");
    EXPECT_EQ(formatValue(std::string("glass")), "glass");
    EXPECT_EQ(formatValue(std::vector<float>{1, 2}), "[1.000, 2.000]");
    EXPECT_EQ(formatValue(std::vector<float>{1, 2, 3}, 2), "[1.000, 2.000, …] (3)");
    EXPECT_EQ(formatValue(std::vector<float>{}), "[]");
    EXPECT_EQ(formatValueFull(Vec2f{0.1f, 1e-7f}), "(0.1, 1e-07)");
    EXPECT_EQ(formatPixel({12, 345}), "(12, 345)");
}

TEST(FormatBytes, UsesBinaryUnits) {
    EXPECT_EQ(formatBytes(0), "0 B");
    EXPECT_EQ(formatBytes(1023), "1023 B");
    EXPECT_EQ(formatBytes(1536), "1.500 KiB");
    EXPECT_EQ(formatBytes(256u << 20), "256.0 MiB");
    EXPECT_EQ(formatBytes((std::uint64_t(1) << 30) - 1), "1.000 GiB");
    EXPECT_EQ(formatBytes(~std::uint64_t(0)), "16.00 EiB");
}

TEST(FormatDuration, ChoosesItsUnit) {
    EXPECT_EQ(formatDuration(0), "0 s");
    EXPECT_EQ(formatDuration(850e-9), "850.0 ns");
    EXPECT_EQ(formatDuration(12.34e-6), "12.34 µs");
    EXPECT_EQ(formatDuration(0.01234), "12.34 ms");
    EXPECT_EQ(formatDuration(0.99999), "1.000 s");
    EXPECT_EQ(formatDuration(59.9), "59.90 s");
    EXPECT_EQ(formatDuration(59.999), "1 min 00 s");
    EXPECT_EQ(formatDuration(125), "2 min 05 s");
    EXPECT_EQ(formatDuration(3 * 3600 + 7 * 60 + 10), "3 h 07 min");
    EXPECT_EQ(formatDuration(kNaN), "NaN s");
}

}  // namespace
}  // namespace emca::analysis
