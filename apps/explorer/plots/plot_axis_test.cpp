#include "plots/plot_axis.h"

#include <gtest/gtest.h>

namespace emca::explorer {
namespace {

TEST(PlotAxis, PowersOfTenAreWrittenAsPowers) {
    EXPECT_EQ(tickText("0.25"), QStringLiteral("0.25"));
    EXPECT_EQ(tickText("1e+00"), QStringLiteral("1"));
    EXPECT_EQ(tickText("1e+03"), QStringLiteral("1000"));
    EXPECT_EQ(tickText("2e-02"), QStringLiteral("0.02"));
    EXPECT_EQ(tickText("1e-05"), QStringLiteral("10⁻⁵"));
    EXPECT_EQ(tickText("-1e+12"), QStringLiteral("-10¹²"));
    EXPECT_EQ(tickText("2.5e+04"), QStringLiteral("2.5·10⁴"));
}

}  // namespace
}  // namespace emca::explorer
