// Memory in pieces: what is handed out at once never overlaps, and what came back is handed out again.
#include "slab.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace emca::detail {
namespace {

constexpr std::size_t kKiB = 1024;

/// Fills slabs of random sizes with their own number, and looks whether somebody else wrote there.
void useSlabs(unsigned seed, bool& intact) {
    std::mt19937 random(seed);
    std::vector<std::pair<Slab, int>> held;
    intact = true;
    const auto check = [&](const std::pair<Slab, int>& slab) {
        const std::byte* bytes = slab.first.get();
        const auto own = static_cast<std::byte>(slab.second);
        for (std::size_t i = 0; i < slab.first.get_deleter().bytes; i += 512) intact = intact && bytes[i] == own;
        intact = intact && bytes[slab.first.get_deleter().bytes - 1] == own;
    };
    for (int round = 0; round < 300; ++round) {
        const std::size_t asked = random() % 10 == 0 ? (1 + random() % 3000) * kKiB : (1 + random() % 300) * kKiB;
        held.emplace_back(allocateSlab(asked), static_cast<int>((seed * 7 + unsigned(round)) % 251));
        auto& [slab, own] = held.back();
        ASSERT_TRUE(slab);
        ASSERT_GE(slab.get_deleter().bytes, asked);
        ASSERT_LT(slab.get_deleter().bytes, asked + 64 * kKiB);
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(slab.get()) % 64, 0u);
        std::memset(slab.get(), own, slab.get_deleter().bytes);
        while (held.size() > 20) {
            const std::size_t i = random() % held.size();
            check(held[i]);
            std::swap(held[i], held.back());
            held.pop_back();
        }
    }
    for (const auto& slab : held) check(slab);
}

TEST(Slab, SlabsOfAllThreadsAreApart) {
    bool intact[3] = {};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 3; ++t) threads.emplace_back([t, &intact] { useSlabs(t + 1, intact[t]); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(intact[0] && intact[1] && intact[2]);
}

TEST(Slab, AFreedPieceIsHandedOutAgainAndWholeBlocksFit) {
    releaseKeptSlabs();
    Slab first = allocateSlab(64 * kKiB), second = allocateSlab(64 * kKiB), third = allocateSlab(64 * kKiB);
    const std::byte* place = second.get();
    second.reset();
    EXPECT_NE(allocateSlab(128 * kKiB).get(), place) << "the gap is too small";
    EXPECT_EQ(allocateSlab(64 * kKiB).get(), place);
    const Slab whole = allocateSlab(2048 * kKiB);
    ASSERT_TRUE(whole);
    std::memset(whole.get(), 1, 2048 * kKiB);
    EXPECT_EQ(whole.get_deleter().bytes, 2048 * kKiB);
}

}  // namespace
}  // namespace emca::detail
