#include "image/region_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

namespace emca::explorer {
namespace {

using Edge = std::pair<std::pair<int, int>, bool>;   // corner, and whether it goes down

/// Unit edges between a pixel inside and one outside: what an outline is.
std::map<Edge, int> expectedEdges(const std::set<Pixel>& inside) {
    std::map<Edge, int> edges;
    const auto has = [&](int x, int y) { return x >= 0 && y >= 0 && inside.contains({std::uint32_t(x), std::uint32_t(y)}); };
    for (int y = 0; y <= 12; ++y) {
        for (int x = 0; x <= 12; ++x) {
            if (has(x, y) != has(x, y - 1)) ++edges[{{x, y}, false}];
            if (has(x, y) != has(x - 1, y)) ++edges[{{x, y}, true}];
        }
    }
    return edges;
}

std::map<Edge, int> edgesOf(const std::vector<QLineF>& lines) {
    std::map<Edge, int> edges;
    for (const QLineF& line : lines) {
        const bool down = line.x1() == line.x2();
        const int length = int(std::lround(line.length()));
        for (int i = 0; i < length; ++i) ++edges[{{int(line.x1()) + (down ? 0 : i), int(line.y1()) + (down ? i : 0)}, down}];
    }
    return edges;
}

TEST(RegionOutline, ARectangleHasFourLines) {
    std::vector<Pixel> pixels;
    for (std::uint32_t y = 3; y < 9; ++y)
        for (std::uint32_t x = 2; x < 7; ++x) pixels.push_back({x, y});
    EXPECT_EQ(regionOutline(pixels).size(), 4u);
    EXPECT_TRUE(regionOutline({}).empty());
}

TEST(RegionOutline, EveryEdgeBetweenInsideAndOutsideOnceAndNoOther) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        std::set<Pixel> inside;
        const auto density = 1 + random() % 9;
        for (std::uint32_t y = 0; y < 12; ++y)
            for (std::uint32_t x = 0; x < 12; ++x)
                if (random() % 10 < density) inside.insert({x, y});
        const std::vector<Pixel> pixels(inside.begin(), inside.end());
        ASSERT_EQ(edgesOf(regionOutline(pixels)), expectedEdges(inside)) << "round " << round;
    }
}

}  // namespace
}  // namespace emca::explorer
