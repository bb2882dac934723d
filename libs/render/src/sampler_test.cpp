#include "emca/render/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "testing/chi_square.h"

namespace emca::render {
namespace {

/// Second Sobol dimension from its direction numbers: Joe and Kuo's table has m = {1} for x + 1, and the recurrence
/// v_k = v_(k-1) ^ (v_(k-1) >> 1).
std::uint32_t sobol1ByDirectionNumbers(std::uint32_t index) {
    std::uint32_t value = 0, direction = 1u << 31;
    for (; index != 0; index >>= 1, direction ^= direction >> 1) {
        if (index & 1u) value ^= direction;
    }
    return value;
}

TEST(Sobol, FastSecondDimensionEqualsDirectionNumbers) {
    for (std::uint32_t i = 0; i < 4096; ++i) ASSERT_EQ(reverseBits(reversedSobol1(i)), sobol1ByDirectionNumbers(i)) << i;
    std::uint32_t x = 1;
    for (int i = 0; i < 1000; ++i) {
        x = x * 1664525u + 1013904223u;
        ASSERT_EQ(reverseBits(reversedSobol1(x)), sobol1ByDirectionNumbers(x)) << x;
    }
}

TEST(Sobol, ScrambleIsAPermutationThatKeepsElementaryIntervals) {
    // Two fractions that agree in their first k bits, and differ in the next, still do so after Owen scrambling.
    for (std::uint32_t seed : {0u, 1u, 0xdeadbeefu}) {
        for (int k = 0; k < 32; ++k) {
            const std::uint32_t a = 0x5a3c9f17u, b = a ^ (0x80000000u >> k);
            const std::uint32_t difference = owenScramble(a, seed) ^ owenScramble(b, seed);
            EXPECT_EQ(difference >> (31 - k), 1u) << "seed " << seed << ", bit " << k;
        }
    }
}

class SamplerTest : public ::testing::TestWithParam<SamplerKind> {};

TEST_P(SamplerTest, SameAddressGivesSameNumberWhateverCameBefore) {
    Sampler a(GetParam(), 7), b(GetParam(), 7);
    a.start({3, 5}, 11);
    const float first = a.next1D();
    const Vec2f second = a.next2D();
    const float third = a.next1D();
    b.start({9, 9}, 2);
    (void)b.next2D();
    b.start({3, 5}, 11);
    b.setDimension(2);
    EXPECT_EQ(b.next1D(), third);
    b.setDimension(1);
    EXPECT_EQ(b.next2D(), second);
    b.setDimension(0);
    EXPECT_EQ(b.next1D(), first);
}

TEST_P(SamplerTest, OtherPixelSampleDimensionOrSeedGivesOtherNumbers) {
    const auto draw = [](std::uint64_t seed, Pixel pixel, std::uint32_t sample, std::uint32_t dimension) {
        Sampler sampler(GetParam(), seed);
        sampler.start(pixel, sample);
        sampler.setDimension(dimension);
        return sampler.next2D();
    };
    const Vec2f base = draw(1, {4, 4}, 3, 2);
    EXPECT_NE(base, draw(2, {4, 4}, 3, 2));
    EXPECT_NE(base, draw(1, {5, 4}, 3, 2));
    EXPECT_NE(base, draw(1, {4, 5}, 3, 2));
    EXPECT_NE(base, draw(1, {4, 4}, 4, 2));
    EXPECT_NE(base, draw(1, {4, 4}, 3, 3));
}

TEST_P(SamplerTest, NumbersAreUniformOverPixelsAndNeverOne) {
    testing::ChiSquareOptions options;
    options.xBins = options.yBins = 16;
    options.tests = 6;
    for (const std::uint32_t dimension : {0u, 5u, 100u}) {
        Sampler sampler(GetParam(), 3);
        std::uint32_t n = 0;
        float largest = 0;
        const auto draw = [&](testing::TestRandom&) -> std::optional<Vec2d> {
            // Each from another pixel: within one pixel Sobol points are more even than chance.
            sampler.start({n % 512, n / 512}, n % 7);
            sampler.setDimension(dimension);
            ++n;
            const Vec2f u = sampler.next2D();
            largest = std::max(largest, std::max(u.x, u.y));
            return Vec2d{double(u.x), double(u.y)};
        };
        const auto result = testing::testPoints({}, draw, [](Vec2d) { return 1.0; }, options);
        EXPECT_TRUE(result.accepted) << "dimension " << dimension << ": " << result.text;
        EXPECT_LT(largest, 1.f);
        EXPECT_GT(largest, 0.999f);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SamplerTest, ::testing::Values(SamplerKind::independent, SamplerKind::sobol),
                         [](const auto& kind) { return name(kind.param); });

TEST(SobolSampler, EveryAlignedRunIsANet) {
    // 2^m points: one in each of the 2^m boxes of every shape 2^-a by 2^-(m-a).
    constexpr int kLog = 8, kCount = 1 << kLog;
    Sampler sampler(SamplerKind::sobol, 5);
    for (const std::uint32_t first : {0u, 256u, 4096u}) {
        for (int a = 0; a <= kLog; ++a) {
            std::vector<int> hits(kCount);
            for (std::uint32_t i = 0; i < kCount; ++i) {
                sampler.start({17, 4}, first + i);
                sampler.setDimension(9);
                const Vec2f u = sampler.next2D();
                const auto x = static_cast<int>(std::ldexp(u.x, a)), y = static_cast<int>(std::ldexp(u.y, kLog - a));
                ++hits[static_cast<std::size_t>((x << (kLog - a)) + y)];
            }
            for (const int count : hits) ASSERT_EQ(count, 1) << "boxes 2^-" << a << ", from sample " << first;
        }
    }
}

}  // namespace
}  // namespace emca::render
