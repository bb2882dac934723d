#include "emca/query/axis.h"

#include <cmath>

#include "query_for_tests.h"

namespace emca::query {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PathSet someValues() {
    return recorded([](Recording& recording) {
        const double values[] = {1.5, 2, std::nan(""), kInfinity, -4, 8};
        const char* words[] = {"wall", "glass", "wall", "", "a, b", "wall"};
        for (int i = 0; i < 7; ++i) {
            auto path = recording.path({0, 0}, i);
            path.vertex(1).position(Vec3f{0, 0, 1});
            if (i == 6) continue;   // nothing recorded
            path.add("x", values[i]);
            path.add("word", words[i]);
            path.add("flag", i % 2 == 0);
        }
    });
}

AxisValues axisOf(std::string_view text, const PathSet& paths) {
    auto axis = axisValues(parsed(text), paths);
    EXPECT_TRUE(axis.ok()) << text;
    return axis.ok() ? *axis : AxisValues{};
}

TEST(Axis, NumbersTextsAndConditionsAreOneNumberPerPath) {
    const PathSet paths = someValues();
    const AxisValues x = axisOf("x", paths);
    EXPECT_EQ(x.type, ExpressionType::number);
    EXPECT_EQ(x.known, (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0}));
    EXPECT_EQ(x.numbers[3], kInfinity);
    EXPECT_TRUE(std::isnan(x.numbers[2]));
    EXPECT_FALSE(x.integral) << "1.5 has a fraction";
    EXPECT_TRUE(axisOf("vertices", paths).integral);
    EXPECT_TRUE(axisOf("floor(x)", paths).integral) << "NaN and infinity are no fractions";

    const AxisValues word = axisOf("word", paths);
    EXPECT_EQ(word.categories, (std::vector<std::string>{"", "a, b", "glass", "wall"}));
    for (std::size_t i : {0u, 2u, 5u}) EXPECT_EQ(word.categories[std::size_t(word.numbers[i])], "wall");
    const AxisValues flag = axisOf("flag", paths);
    EXPECT_EQ(flag.categories, (std::vector<std::string>{"false", "true"}));
    EXPECT_EQ(flag.numbers[0], 1);

    const AxisValues absent = axisOf("max(v.roughness)", paths);
    EXPECT_EQ(absent.size(), 7u);
    EXPECT_EQ(absent.known, std::vector<std::uint8_t>(7, 0));
    const auto color = axisValues(parsed("estimate"), paths);
    ASSERT_FALSE(color.ok());
    EXPECT_NE(color.error().message.find("luminance(estimate)"), std::string::npos) << color.error().message;
}

TEST(Axis, BrushesOfOneAxisAddUpAndThoseOfSeveralIntersect) {
    const PathSet paths = someValues();
    const AxisValues x = axisOf("x", paths), flag = axisOf("flag", paths);
    const std::vector<Brush> two{{-5, 0}, {1.5, 2}};
    const std::vector<Brush> yes{{1, 1}};
    EXPECT_EQ(brushedPaths(std::vector<BrushedAxis>{{&x, two}}, 7), (std::vector<Index>{0, 1, 4}));
    EXPECT_EQ(brushedPaths(std::vector<BrushedAxis>{{&x, two}, {&flag, yes}}, 7), (std::vector<Index>{0, 4}));
    EXPECT_EQ(brushedPaths(std::vector<BrushedAxis>{{&x, {}}, {&flag, {}}}, 7).size(), 7u) << "no brush takes all";
    const std::vector<Brush> beside{{1, 0, true, true}};
    EXPECT_EQ(brushedPaths(std::vector<BrushedAxis>{{&x, beside}}, 7), (std::vector<Index>{2, 6}));
}

/// Whatever is brushed: the query (and the rules, where there are any) take exactly these paths.
TEST(Axis, QueriesAndRulesOfBrushesTakeTheSamePaths) {
    const PathSet random = recorded(RandomPaths(7, 3, 40, 5));
    const PathSet some = someValues();
    const std::vector<Brush> marks[] = {
        {{0, 2}}, {{0.5, 0.5}}, {{-kInfinity, 1}}, {{2, kInfinity}}, {{-kInfinity, kInfinity}}, {{1, 0, true, false}},
        {{1, 0, false, true}}, {{0, 1, true, false}}, {{0, 1, true, true}}, {{-1, 0}, {2, 8}}, {{0.6, 3.2}}, {{0.2, 0.8}}, {{1, 0}}, {{3, 3}},
    };
    int rules = 0, checked = 0;
    for (const PathSet* paths : {&random, &some})
        for (const char* expression : {"x", "word", "flag", "f", "t", "b", "mixed", "luminance", "depth", "max(v.depth)", "count(v.depth > 1)", "first(v.event)", "any(v.last)",
                                       "depth - 1", "vertices * 2", "last(v.label)", "min(v.segment)", "depth > 1"}) {
            const AxisValues values = axisOf(expression, *paths);
            for (const auto& brushes : marks) {
                const auto expected = brushedPaths(std::vector<BrushedAxis>{{&values, brushes}}, paths->pathCount());
                const std::string text = brushQuery(expression, values, brushes);
                const auto matches = parsed(text).select(*paths);
                ASSERT_TRUE(matches.ok()) << text << ": " << matches.error().message;
                // What no path has is of no type: nothing but its absence can be asked.
                EXPECT_EQ(matches->paths, expected) << text;
                ++checked;
                const auto asRules = brushRules(expression, values, brushes);
                if (!asRules) continue;
                ++rules;
                const auto ruleText = toQuery(*asRules, *paths);
                ASSERT_TRUE(ruleText.ok()) << text << ": " << ruleText.error().message;
                const auto same = parsed(*ruleText).select(*paths);
                ASSERT_TRUE(same.ok()) << *ruleText;
                EXPECT_EQ(same->paths, expected) << *ruleText;
            }
        }
    EXPECT_GT(rules, checked / 4);
}

TEST(Axis, AnIntervalIsTwoRulesThatAPersonCanRead) {
    const PathSet paths = someValues();
    const AxisValues x = axisOf("x", paths), depth = axisOf("depth", paths), word = axisOf("word", paths);
    const auto text = [&](const char* expression, const AxisValues& values, std::vector<Brush> brushes) {
        const auto rules = brushRules(expression, values, brushes);
        return rules ? *toQuery(*rules, paths) : std::string("none");
    };
    EXPECT_EQ(text("x", x, {{0.25, 3}}), "x >= 0.25 and x <= 3");
    EXPECT_EQ(text("depth", depth, {{0.7, 2.2}}), "depth >= 1 and depth <= 2");
    EXPECT_EQ(text("word", word, {{2, 3}}), "word in (\"glass\", \"wall\")");
    EXPECT_EQ(text("word", word, {{1, 2}}), "none") << "a text with a comma cannot stand in a list";
    EXPECT_EQ(text("word", word, {{1, 1}}), "word == \"a, b\"");
    EXPECT_EQ(text("x", x, {{1, 0, true, false}}), "nan(x)");
    EXPECT_EQ(text("x", x, {{1, 2}, {3, 4}}), "none");
    EXPECT_EQ(brushQuery("x", x, std::vector<Brush>{{1, 2}, {3, 4}}), "((x >= 1 and x <= 2) or (x >= 3 and x <= 4))");
}

}  // namespace
}  // namespace emca::query
