#include "parallel/parallel_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "parallel/line_pictures.h"
#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

ParallelAxes axesOf(const PathSet& paths, const std::vector<AxisWish>& wishes) {
    ParallelAxes axes;
    axes.setPaths(paths);
    axes.setWishes(wishes);
    return axes;
}

std::vector<Index> taken(const ParallelAxis& axis, const query::Brush& brush) {
    const query::BrushedAxis one{&axis.values, {&brush, 1}};
    return query::brushedPaths({&one, 1}, static_cast<Index>(axis.values.size()));
}

PathSet wild() {
    std::vector<Color> estimates;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.01f, 2.f);
    for (int i = 0; i < 300; ++i) estimates.emplace_back(uniform(random));
    estimates[7] = Color(kNaN);
    estimates[8] = Color(kInfinity);
    estimates[9] = Color(5000.f);
    estimates[10] = Color(0.f);
    estimates[11] = Color(-3.f);
    return test::pathsWithEstimates(estimates, {1, 2, 5});
}

/// Whatever heights are dragged over: the brush takes exactly the paths whose lines cross the axis there, but for the
/// pixel at each end, to which numbers are rounded.
TEST(ParallelFrame, ABrushTakesWhatLiesUnderIt) {
    const PathSet paths = wild();
    std::mt19937 random(5);
    for (const bool log : {false, true})
        for (const bool flipped : {false, true}) {
            const ParallelAxes axes = axesOf(paths, {{"luminance", log, flipped}, {"depth", false, flipped}, {"min(v.segment)"}});
            const ParallelFrame frame({700, 420}, axes.all(), 50, 40);
            EXPECT_TRUE(frame.hasNanRow());
            EXPECT_TRUE(frame.hasMissingRow()) << "a path of one vertex has no segment";
            std::uniform_real_distribution<double> heights(ParallelFrame::kHeader, 420);
            for (int i = 0; i < 200; ++i) {
                const double a = heights(random), b = heights(random), upper = std::min(a, b), lower = std::max(a, b);
                for (const std::size_t k : {0u, 1u}) {
                    const query::Brush brush = frame.brush(axes[k], a, b);
                    const std::vector<Index> found = taken(axes[k], brush);
                    for (Index path = 0; path < paths.pathCount(); ++path) {
                        const double y = frame.y(axes[k], path);
                        const bool in = std::binary_search(found.begin(), found.end(), path);
                        const bool inRow = y < frame.top() || y > frame.bottom();
                        const double slack = inRow ? ParallelFrame::kRow / 2 + 2 : 1.01;
                        if (y > upper + slack && y < lower - slack) {
                            EXPECT_TRUE(in) << y << " in " << upper << ", " << lower << " log " << log << " flipped " << flipped;
                        } else if (y < upper - slack || y > lower + slack) {
                            EXPECT_FALSE(in) << y << " out of " << upper << ", " << lower << " log " << log << " flipped " << flipped;
                        }
                    }
                }
            }
        }
}

TEST(ParallelFrame, PlacesBesideTheScaleAreBrushedAlone) {
    const PathSet paths = wild();
    const ParallelAxes axes = axesOf(paths, {{"luminance", true}, {"min(v.segment)"}});
    const ParallelFrame frame({700, 420}, axes.all(), 50, 40);
    const auto at = [&](double center) { return taken(axes[0], frame.brush(axes[0], center - 3, center + 3)); };
    EXPECT_EQ(at(frame.nanCenter()), std::vector<Index>{7});
    EXPECT_EQ(at(frame.bottomRowCenter()), (std::vector<Index>{10, 11})) << "0 and less have no logarithm";
    const std::vector<Index> above = at(frame.topRowCenter());
    EXPECT_TRUE(std::binary_search(above.begin(), above.end(), 8u));
    EXPECT_TRUE(std::binary_search(above.begin(), above.end(), 9u));
    EXPECT_LT(above.size(), 5u);
    EXPECT_EQ(taken(axes[1], frame.brush(axes[1], frame.missingCenter() - 2, frame.missingCenter() + 2)).size(), paths.pathCount());
}

TEST(ParallelFrame, ValuesAndHeightsAreInverse) {
    const ParallelAxes axes = axesOf(wild(), {{"luminance", true}, {"luminance", false, true}});
    const ParallelFrame frame({700, 420}, axes.all(), 50, 40);
    for (const std::size_t i : {0u, 1u})
        for (double y = frame.top(); y <= frame.bottom(); y += 17) EXPECT_NEAR(frame.position(axes[i], frame.value(axes[i], y)), y, 1e-6);
    EXPECT_LT(frame.position(axes[0], 1), frame.position(axes[0], 0.1)) << "larger values are higher";
    EXPECT_GT(frame.position(axes[1], 1), frame.position(axes[1], 0.1)) << "upside down";
}

TEST(ParallelFrame, LinesOfOneCategoryStayInItsRoom) {
    const ParallelAxes axes = axesOf(test::fakePaths({.samples = 500, .vertices = 0}), {{"first(v.lobe)"}, {"last(v.label)"}});
    const ParallelFrame frame({700, 420}, axes.all(), 50, 40);
    ASSERT_TRUE(axes[0].isText());
    const double room = (frame.bottom() - frame.top()) / double(axes[0].values.categories.size());
    double widest = 0;
    for (Index path = 0; path < 500; ++path) {
        const double off = std::abs(frame.y(axes[0], path) - frame.position(axes[0], axes[0].values.numbers[path]));
        EXPECT_LT(off, room * 0.3);
        widest = std::max(widest, off);
    }
    EXPECT_GT(widest, room * 0.2) << "they are spread";
}

TEST(LinePictures, TheNearestLineIsThatOfBruteForce) {
    LineField field{{400, 300}, {50, 200, 350}, {}};
    std::mt19937 random(8);
    std::uniform_real_distribution<float> heights(50, 290);
    field.ys.assign(3, std::vector<float>(200));
    for (auto& axis : field.ys)
        for (float& y : axis) y = heights(random);
    std::uniform_real_distribution<double> xs(0, 400), ys(40, 300);
    int found = 0;
    for (int i = 0; i < 500; ++i) {
        const QPointF at(xs(random), ys(random));
        std::optional<Index> best;
        double nearest = 6;
        for (Index path = 0; path < 200; ++path)
            for (std::size_t k = 0; k + 1 < 3; ++k) {
                if (at.x() < field.xs[k] || at.x() >= field.xs[k + 1]) continue;
                const QPointF a(field.xs[k], double(field.ys[k][path])), b(field.xs[k + 1], double(field.ys[k + 1][path])), d = b - a;
                const double distance = std::abs(d.x() * (at.y() - a.y()) - d.y() * (at.x() - a.x())) / std::hypot(d.x(), d.y());
                if (distance <= nearest) nearest = distance, best = path;
            }
        const auto line = lineAt(field, at, 6);
        ASSERT_EQ(line.has_value(), best.has_value()) << at.x() << ' ' << at.y();
        if (line) {
            EXPECT_EQ(*line, *best);
        }
        found += best.has_value();
    }
    EXPECT_GT(found, 100);
}

/// Many lines are density, few are lines: both say where something is.
TEST(LinePictures, PicturesHaveInkWhereLinesAre) {
    for (const std::size_t count : {std::size_t(5), kMostLines + 1}) {
        LineField field{{400, 300}, {50, 350}, {}};
        field.ys.assign(2, std::vector<float>(count, 100.5f));
        for (const double ratio : {1.0, 2.0}) {
            const QImage picture = linePicture(field, std::nullopt, Qt::white, ratio);
            const double own = picture.devicePixelRatio();
            EXPECT_GT(qAlpha(picture.pixel(int(200 * own), int(100.5 * own))), 100);
            EXPECT_EQ(qAlpha(picture.pixel(int(200 * own), int(160 * own))), 0);
            EXPECT_EQ(qAlpha(picture.pixel(int(20 * own), int(100.5 * own))), 0) << "no line goes beyond the axes";
        }
    }
    EXPECT_TRUE(linePicture({{400, 300}, {50}, {{1.f}}}, std::nullopt, Qt::white, 1).isNull()) << "one axis has no lines";
}

}  // namespace
}  // namespace emca::explorer
