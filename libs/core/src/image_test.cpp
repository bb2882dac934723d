#include "emca/core/image.h"

#include <gtest/gtest.h>

namespace emca {
namespace {

TEST(Image, StoresRowsFromTheTop) {
    Image image(3, 2);
    image.setColor({2, 1}, {1, 2, 3});
    EXPECT_EQ(image.data()[(1 * 3 + 2) * 3 + 1], 2.f);
    EXPECT_EQ(image.color({2, 1}), Color(1, 2, 3));
    EXPECT_TRUE(image.contains({2, 1}));
    EXPECT_FALSE(image.contains({3, 1}));
    EXPECT_FALSE(image.contains({0, 2}));
}

TEST(Image, OneChannelReadsAsGrey) {
    Image image(1, 1, {"Y"});
    image.data()[0] = 0.25f;
    EXPECT_EQ(image.color({0, 0}), Color(0.25f));
    EXPECT_EQ(image.channelIndex("Y"), 0);
    EXPECT_EQ(image.channelIndex("Z"), -1);
}

}  // namespace
}  // namespace emca
