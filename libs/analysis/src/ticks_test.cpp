#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
    std::vector<std::string> result;
    for (const Tick& t : ticks)
        if (t.major) result.push_back(t.label);
    return result;
}
using Labels = std::vector<std::string>;

TEST(Ticks, ReadAsAPersonWouldWriteThem) {
    EXPECT_EQ(labels(ticks({0, 1}, 6)), (Labels{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    EXPECT_EQ(labels(ticks({-3, 7}, 6)), (Labels{"-2", "0", "2", "4", "6"}));
    EXPECT_EQ(labels(ticks({0, 0.003}, 5)), (Labels{"0", "0.001", "0.002", "0.003"}));
    EXPECT_EQ(labels(ticks({0, 2500000}, 6)), (Labels{"0", "5.0e+05", "1.0e+06", "1.5e+06", "2.0e+06", "2.5e+06"}));
    EXPECT_EQ(labels(ticks({0.001, 1000, true}, 7)), (Labels{"0.001", "0.01", "0.1", "1", "10", "100", "1000"}));
    EXPECT_EQ(labels(ticks({1e-8, 1, true}, 5)), (Labels{"1e-08", "1e-06", "1e-04", "1e-02", "1e+00"}));
    EXPECT_EQ(labels(ticks({1.5, 95, true}, 6)), (Labels{"2", "5", "10", "20", "50"}));
    EXPECT_EQ(labels(integerTicks({-0.5, 3.5}, 6)), (Labels{"0", "1", "2", "3"}));
    EXPECT_EQ(labels(integerTicks({0, 1023}, 6)), (Labels{"0", "200", "400", "600", "800", "1000"}));
}

TEST(Ticks, PropertiesHoldForAnyRange) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 5000; ++round) {
        const double scale = std::pow(10, 24 * unit(random) - 12);
        const double start = (2 * unit(random) - 1) * scale * (round % 3 ? 1 : 1000);
        const bool log = round % 2 != 0;
        const ValueRange range =
            log ? ValueRange{scale, scale * std::pow(10, 0.05 + 14 * unit(random) * unit(random)), true}
                : ValueRange{start, start + scale * (0.01 + unit(random)), false};
        const int room = 2 + static_cast<int>(random() % 9);
        const std::vector<Tick> marks = ticks(range, room);
        SCOPED_TRACE(testing::Message() << range.min << " to " << range.max << (log ? " log" : "") << ", room "
                                        << room);
        std::set<std::string> seen;
        int majors = 0;
        double step = 0, last = 0;
        for (std::size_t i = 0; i < marks.size(); ++i) {
            EXPECT_GE(marks[i].value, range.min);
            EXPECT_LE(marks[i].value, range.max);
            if (i > 0) {
                EXPECT_GT(marks[i].value, marks[i - 1].value);
            }
            EXPECT_EQ(marks[i].major, !marks[i].label.empty());
            if (!marks[i].major) continue;
            EXPECT_TRUE(seen.insert(marks[i].label).second) << marks[i].label;
            // The label says the value: what it leaves out is nothing against the range.
            EXPECT_NEAR(std::strtod(marks[i].label.c_str(), nullptr), marks[i].value,
                        1e-6 * (log ? marks[i].value : range.max - range.min));
            if (!log && majors == 1) step = marks[i].value - last;
            if (!log && majors > 1) {
                EXPECT_NEAR(marks[i].value - last, step, 1e-6 * step);
            }
            last = marks[i].value;
            ++majors;
        }
        EXPECT_LE(majors, room);
        if (room >= 5) {
            EXPECT_GE(majors, 2);
        }
        if (!log && majors > 1) {
            const double mantissa = step / std::pow(10, std::floor(std::log10(step * 1.0000001)));
            EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
                << step;
        }
    }
}

TEST(Ticks, RoundEndsAreMarked) {
    for (const double end : {0.3, 0.7, 1.1, 70.0, 1e-7}) {
        const std::vector<Tick> marks = ticks({0, end}, 12);
        EXPECT_DOUBLE_EQ(marks.front().value, 0);
        EXPECT_DOUBLE_EQ(marks.back().value, end) << end;
    }
}

TEST(Ticks, AreNeverFractionsOnAxesOfIntegers) {
    for (const double length : {0.4, 1.0, 2.5, 9.0, 77.0, 1e6})
        for (const Tick& t : integerTicks({-0.5, length}, 6)) EXPECT_EQ(t.value, std::round(t.value));
}

TEST(Ticks, SurviveInvalidRanges) {
    for (const double min : {0.0, -1.0, 1e308, -1e308, std::nan(""), 5e-324})
        for (const double max : {0.0, 1.0, 1e308, std::nan(""), 1e-320, 5e-324})
            for (const bool log : {false, true}) EXPECT_LE(ticks({min, max, log}, 6).size(), 5000u);
}

}  // namespace
}  // namespace emca::analysis
