#include "emca/core/replay.h"

#include <gtest/gtest.h>

#include <limits>

namespace emca {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Replay, ExactMeansEqualBits) {
    EXPECT_EQ(compare({1, 2, 3}, {1, 2, 3}), Verdict::exact);
    EXPECT_EQ(compare({kNan, 2, kInf}, {-kNan, 2, kInf}), Verdict::exact);
    EXPECT_EQ(compare({1, 2, 3}, {1, 2, std::nextafter(3.f, 4.f)}), Verdict::close);
    EXPECT_EQ(compare({0.f, 0, 0}, {-0.f, 0, 0}), Verdict::close) << "zero and minus zero differ in a bit";
}

TEST(Replay, CloseEndsAtOneInTenThousand) {
    EXPECT_EQ(compare(Color(1.f), Color(1.00009f)), Verdict::close);
    EXPECT_EQ(compare(Color(1.f), Color(1.0002f)), Verdict::different);
    EXPECT_EQ(compare(Color(0.f), Color(1e-30f)), Verdict::different);
    EXPECT_EQ(compare({kNan, 0, 0}, {1, 0, 0}), Verdict::different);
    EXPECT_EQ(compare({kInf, 0, 0}, {-kInf, 0, 0}), Verdict::different);
}

TEST(Replay, CountsOfSeveralPixels) {
    std::vector<Replay> replays(7);
    EXPECT_EQ(countReplays(replays).worst(), Verdict::unknown);
    for (const std::size_t i : {0u, 1u, 2u}) replays[i].verdict = Verdict::exact;
    EXPECT_EQ(countReplays(replays).worst(), Verdict::exact);
    replays[5].verdict = Verdict::close;
    EXPECT_EQ(countReplays(replays).worst(), Verdict::close);
    replays[6].verdict = Verdict::different;
    replays[6].sums = SumCheck::differs;
    const ReplayCounts counts = countReplays(replays);
    EXPECT_EQ(counts.worst(), Verdict::different);
    EXPECT_EQ(counts.pixels, 7u);
    EXPECT_EQ(counts.exact, 3u);
    EXPECT_EQ(counts.close + counts.different, 2u);
    EXPECT_EQ(counts.unknown, 2u);
    EXPECT_EQ(counts.sumsDiffer, 1u);
    EXPECT_EQ(countReplays({}).worst(), Verdict::unknown);
}

}  // namespace
}  // namespace emca
