#include "parallel/parallel_axes.h"

#include <gtest/gtest.h>

#include "paths/test_paths.h"

namespace emca::explorer {
namespace {

TEST(ParallelAxes, TheUsualOnesFitAnyPaths) {
    ParallelAxes axes;
    axes.setWishes(ParallelAxes::defaults());
    EXPECT_EQ(axes.size(), ParallelAxes::defaults().size()) << "without a path";
    axes.setPaths(test::pathsWithEstimates({Color(1), Color(2)}));
    for (const ParallelAxis& axis : axes.all()) EXPECT_TRUE(axis.error.isEmpty()) << axis.wish.expression.toStdString();
    EXPECT_EQ(axes[3].valueText(1), "2.000");
    EXPECT_EQ(axes[4].valueText(1), "not recorded") << "one vertex has no segment";
    EXPECT_TRUE(axes[4].isEmpty()) << "no path has one";
}

TEST(ParallelAxes, MovingKeepsTheOthersInOrder) {
    ParallelAxes axes;
    axes.setWishes({{"sample"}, {"depth"}, {"luminance"}, {"vertices"}});
    const auto order = [&] {
        QString all;
        for (const ParallelAxis& axis : axes.all()) all += axis.wish.expression[0];
        return all;
    };
    axes.move(0, 3);
    EXPECT_EQ(order(), "dlvs");
    axes.move(3, 1);
    EXPECT_EQ(order(), "dslv");
    axes.remove(0);
    EXPECT_EQ(order(), "slv");
}

TEST(ParallelAxes, AsManyAsAnybodyCanRead) {
    ParallelAxes axes;
    for (std::size_t i = 0; i < ParallelAxes::kMost; ++i) EXPECT_TRUE(axes.add({QStringLiteral("depth + %1").arg(i)}).ok());
    EXPECT_FALSE(axes.add({"depth"}).ok());
}

TEST(ParallelAxes, UnitsBelongToRadianceAndLengths) {
    ParallelAxes axes;
    axes.setWishes({{"luminance"}, {"max(c.luminance)"}, {"luminance(estimate)"}, {"estimate.r"}, {"min(v.segment)"}, {"depth"}, {"max(v.emission.g)"}});
    const auto unit = [&](std::size_t i) { return axes[i].unit; };
    for (const std::size_t i : {0u, 1u, 2u, 3u, 6u}) EXPECT_EQ(unit(i), QString::fromUtf8("W/(sr m²)")) << axes[i].wish.expression.toStdString();
    EXPECT_EQ(unit(4), "scene units");
    EXPECT_EQ(unit(5), "");
}

TEST(ParallelAxes, CsvHasAllValuesInFull) {
    ParallelAxes axes;
    axes.setPaths(test::pathsWithEstimates({Color(0.1f), Color(2)}, {1}, {7, 8}));
    axes.setWishes({{"estimate.r"}, {"min(v.segment)"}, {"max(1, 2)"}});
    EXPECT_EQ(axes.csv(), "pixel x,pixel y,sample,part,estimate.r,min(v.segment),\"max(1, 2)\"\n"
                          "7,8,0,0,0.10000000149011612,,2\n7,8,1,0,2,,2\n");
}

TEST(ParallelAxes, WishesSurviveText) {
    const std::vector<AxisWish> wishes{{"a \"b\"", true, false}, {"v.`x`", false, true}};
    EXPECT_EQ(wishesFrom(toText(wishes)), wishes);
    EXPECT_TRUE(wishesFrom("[1, {\"log\": true}, null]").empty());
}

}  // namespace
}  // namespace emca::explorer
