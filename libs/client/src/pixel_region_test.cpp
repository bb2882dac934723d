#include "emca/client/pixel_region.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace emca::client {
namespace {

TEST(PixelRegion, ARectangleHoldsItsPixelsInReadingOrder) {
    const PixelRegion region(PixelRect{2, 5, 4, 7});
    const std::vector<Pixel> expected{{2, 5}, {3, 5}, {2, 6}, {3, 6}};
    EXPECT_EQ(std::vector<Pixel>(region.pixels().begin(), region.pixels().end()), expected);
    EXPECT_TRUE(region.isRectangle());
    EXPECT_EQ(region.text(), "region 2x2 at (2, 5)");
    EXPECT_EQ(region, PixelRegion(std::vector<Pixel>{{3, 6}, {2, 5}, {3, 5}, {2, 6}, {2, 5}})) << "order and duplicates do not matter";
    EXPECT_TRUE(PixelRegion(PixelRect{4, 4, 4, 9}).empty());
    EXPECT_EQ(PixelRegion(PixelRect{4, 4, 4, 9}), PixelRegion());
}

TEST(PixelRegion, BehavesAsASetOfPixels) {
    std::mt19937 random(7);
    const auto coordinate = [&] { return static_cast<std::uint32_t>(random() % 6); };
    std::set<Pixel> expected;
    PixelRegion region;
    for (int step = 0; step < 400; ++step) {
        const Pixel pixel{coordinate(), coordinate()};
        if (!expected.erase(pixel)) expected.insert(pixel);
        region = region.toggled(pixel);
        ASSERT_EQ(std::vector<Pixel>(expected.begin(), expected.end()), std::vector<Pixel>(region.pixels().begin(), region.pixels().end()));
        std::uint64_t inside = 0;
        for (std::uint32_t y = 0; y < 7; ++y) {
            for (std::uint32_t x = 0; x < 7; ++x) {
                ASSERT_EQ(region.contains({x, y}), expected.contains({x, y}));
                inside += expected.contains({x, y});
                ASSERT_TRUE(!expected.contains({x, y}) || region.bounds().contains({x, y}));
            }
        }
        ASSERT_EQ(region.isRectangle(), region.bounds().count() == inside);
    }
    const PixelRegion square(PixelRect{1, 1, 3, 3});
    for (const Pixel pixel : square.pixels()) expected.insert(pixel);
    EXPECT_EQ(region.with(square), PixelRegion(std::vector<Pixel>(expected.begin(), expected.end())));
    EXPECT_EQ(PixelRegion().with(square), square);
}

TEST(PixelRegion, SetsOfTheSameSizeAndBoundsDiffer) {
    const PixelRegion a(std::vector<Pixel>{{0, 0}, {1, 1}, {2, 2}}), b(std::vector<Pixel>{{0, 0}, {2, 1}, {2, 2}});
    EXPECT_NE(a, b);
    EXPECT_EQ(a.text(), "3 pixels around (1, 1)");
    EXPECT_EQ(PixelRegion(std::vector<Pixel>{{9, 3}}).text(), "pixel (9, 3)");
    EXPECT_EQ(PixelRegion().text(), "");
}

}  // namespace
}  // namespace emca::client
