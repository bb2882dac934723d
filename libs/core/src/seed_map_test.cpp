#include "emca/core/seed_map.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <set>

namespace emca {
namespace {

TEST(SeedMap, SeedsOfAnImageAreDistinct) {
    const SeedMap map(7);
    std::set<std::uint64_t> seeds;
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            for (std::uint64_t s = 0; s < 8; ++s) seeds.insert(map.seed({x, y}, s));
    EXPECT_EQ(seeds.size(), 64u * 64u * 8u);
}

TEST(SeedMap, EqualInputGivesEqualSeedAndMasterSeedChangesAll) {
    EXPECT_EQ(SeedMap(1).seed({3, 4}, 5), SeedMap(1).seed({3, 4}, 5));
    EXPECT_NE(SeedMap(1).seed({3, 4}, 5), SeedMap(2).seed({3, 4}, 5));
    EXPECT_NE(SeedMap(1).seed({3, 4}, 5), SeedMap(1).seed({4, 3}, 5));
}

TEST(SeedMap, StoredMapUsesTheStoredSeed) {
    const SeedMap map(2, {1, 2, 3, 1});
    EXPECT_EQ(map.seed({0, 0}), map.seed({1, 1}));
    EXPECT_NE(map.seed({0, 0}), map.seed({1, 0}));
}

// Each output bit is set in half of the seeds: 4096 draws, so 6 standard deviations are 192.
TEST(SeedMap, BitsAreBalanced) {
    const SeedMap map;
    std::array<int, 64> ones{};
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const std::uint64_t seed = map.seed({i % 64, i / 64}, 0);
        for (int b = 0; b < 64; ++b) ones[std::size_t(b)] += int((seed >> b) & 1);
    }
    for (const int n : ones) EXPECT_NEAR(n, 2048, 192);
}

}  // namespace
}  // namespace emca
