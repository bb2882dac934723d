#include "plots/plot_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace emca::explorer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PlotFrame, PixelsAndValuesAreInverse) {
    for (const bool log : {false, true}) {
        const PlotFrame frame({600, 200}, {-0.5, 1023.5, false}, {0.001, 40, log}, {true, true, true});
        for (const double y : {0.001, 0.02, 1.0, 39.0}) EXPECT_NEAR(frame.y().value(frame.y().pixel(y)), y, 1e-12 * 40);
        EXPECT_GT(frame.y().pixel(0.002), frame.y().pixel(0.003)) << "larger values are higher";
    }
}

TEST(PlotFrame, WhatTheRangeDoesNotHoldHasARowAtTheEdge) {
    const PlotFrame frame({600, 200}, {0, 10, false}, {0.1, 10, true}, {true, true, true});
    EXPECT_EQ(frame.row(1), PlotRow::inside);
    EXPECT_EQ(frame.row(10), PlotRow::inside);
    EXPECT_EQ(frame.row(10.001), PlotRow::above);
    EXPECT_EQ(frame.row(kInfinity), PlotRow::above);
    EXPECT_EQ(frame.row(0), PlotRow::below);
    EXPECT_EQ(frame.row(-3), PlotRow::below);
    EXPECT_EQ(frame.row(kNaN), PlotRow::nan);
    // The rows do not overlap the scale or each other.
    EXPECT_LT(frame.center(PlotRow::above) + 8, frame.y().end);
    EXPECT_GT(frame.center(PlotRow::below) - 8, frame.y().start);
    EXPECT_GE(frame.center(PlotRow::nan) - frame.center(PlotRow::below), 16);
    EXPECT_FALSE(frame.place(kNaN, 1));
    EXPECT_FALSE(frame.place(10.5, 1));
}

TEST(PlotFrame, NearestAndInsideAgreeWithBruteForce) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> xs, ys;
    for (int i = 0; i < 2000; ++i) {
        xs.push_back(i % 200);
        ys.push_back(i % 37 == 0 ? kNaN : i % 41 == 0 ? 1e6 : unit(random) * 10 - 1);
    }
    const analysis::ValueRange y{0, 8, false};
    const PlotFrame frame({500, 160}, {-0.5, 180.5, false}, y, PlotFrame::rowsFor(ys, y));
    for (int trial = 0; trial < 50; ++trial) {
        const QPointF a(unit(random) * 500, unit(random) * 160), b(unit(random) * 500, unit(random) * 160);
        std::vector<std::uint32_t> expected;
        std::optional<std::uint32_t> closest;
        double distance = 12;
        for (std::uint32_t i = 0; i < xs.size(); ++i) {
            const auto at = frame.place(xs[i], ys[i]);
            if (!at) continue;
            const bool inX = (at->x() - a.x()) * (at->x() - b.x()) <= 0,
                       inY = (at->y() - a.y()) * (at->y() - b.y()) <= 0;
            if (inX && inY) expected.push_back(i);
            const double d = std::hypot(at->x() - a.x(), at->y() - a.y());
            if (d <= distance) distance = d, closest = i;
        }
        EXPECT_EQ(frame.inside(xs, ys, QRectF(a, b)), expected);
        EXPECT_EQ(frame.nearest(xs, ys, a, 12), closest);
    }
}

TEST(PlotFrame, ZoomKeepsWhatIsUnderTheCursor) {
    for (const bool log : {false, true}) {
        const analysis::ValueRange range{1, 1000, log};
        const analysis::ValueRange closer = zoomed(range, 0.25, 0.5);
        EXPECT_NEAR(closer.position(range.value(0.25)), 0.25, 1e-12);
        const analysis::ValueRange back = zoomed(closer, 0.25, 2);
        EXPECT_NEAR(back.min, 1, 1e-9);
        EXPECT_NEAR(back.max, 1000, 1e-6);
        EXPECT_NEAR(moved(range, 0.1).position(range.value(0.1)), 0, 1e-12);
    }
}

TEST(PlotFrame, TinyCanvasesHaveAValidFrame) {
    const PlotFrame frame({0, 0}, {0, 1, false}, {0, 1, false}, {true, true, true});
    EXPECT_TRUE(std::isfinite(frame.y().pixel(0.5)));
    EXPECT_TRUE(frame.spannedY().isValid());
}

}  // namespace
}  // namespace emca::explorer
