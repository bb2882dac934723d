#include "emca/query/vertex_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "query_for_tests.h"

namespace emca::query {
namespace {

PathSet twoPaths() {
    return recorded([](Recording& recording) {
        const PathHandle a = recording.path({3, 4}, 0);
        a.finalEstimate(Color(1, 2, 3));
        a.vertex(1).add("pdf", 0.5f);
        a.vertex(2).contribution(Color(2), "light", 0.25f);
        a.vertex(2).contribution(Color(3), "BSDF", 0.75f);
        const PathHandle b = recording.path({3, 4}, 1);
        b.finalEstimate(Color(7));
        b.vertex(1).add("pdf", std::nanf(""));
        b.vertex(1).add("kind", std::string_view("glass"));
    });
}

TEST(VertexValues, AreThoseOfTheVertexItsPathAndItsContributions) {
    const PathSet paths = twoPaths();
    ASSERT_EQ(paths.vertexCount(), 3u);
    const auto depth = vertexValues("v.depth", paths);
    ASSERT_TRUE(depth) << depth.error().message;
    EXPECT_EQ(depth->numbers, (std::vector<double>{1, 2, 1}));
    const auto pdf = vertexValues("v.pdf", paths);
    ASSERT_TRUE(pdf);
    EXPECT_EQ(pdf->known, (std::vector<std::uint8_t>{1, 0, 1}));
    EXPECT_EQ(pdf->numbers[0], 0.5);
    EXPECT_TRUE(std::isnan(pdf->numbers[2])) << "NaN is a value";
    const auto red = vertexValues("estimate.r", paths);
    ASSERT_TRUE(red) << red.error().message;
    EXPECT_EQ(red->numbers, (std::vector<double>{1, 1, 7}));
    const auto sum = vertexValues("sum(c.value.r)", paths);
    ASSERT_TRUE(sum) << sum.error().message;
    EXPECT_EQ(sum->numbers[1], 5);
    const auto color = vertexValues("estimate", paths);
    ASSERT_TRUE(color);
    EXPECT_EQ(color->components, 3);
    EXPECT_EQ(color->numbers.size(), 9u);
    const auto kind = vertexValues("v.kind", paths);
    ASSERT_TRUE(kind);
    EXPECT_EQ(kind->texts[2], "glass");
}

TEST(VertexValues, ErrorsNameTheCharacter) {
    const PathSet paths = twoPaths();
    QueryError where;
    const auto refused = vertexValues("v.depth +", paths, {}, &where);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::parseFailed);
    EXPECT_FALSE(vertexValues("c.value", paths)) << "several of a vertex";
    const auto missing = vertexValues("v.nothing", paths);
    ASSERT_TRUE(missing);
    EXPECT_EQ(missing->missing, (std::vector<std::string>{"nothing"}));
    EXPECT_EQ(missing->known, (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(VertexValues, ManyChunksAreInOrder) {
    const PathSet paths = recorded(RandomPaths(5, 3, 2000, 6));
    const auto depth = vertexValues("v.depth", paths);
    ASSERT_TRUE(depth);
    ASSERT_EQ(depth->numbers.size(), paths.vertexCount());
    for (Index v = 0; v < paths.vertexCount(); ++v) ASSERT_EQ(depth->numbers[v], paths.depthIndex(v)) << v;
}

}  // namespace
}  // namespace emca::query
