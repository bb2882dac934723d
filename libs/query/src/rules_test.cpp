#include "emca/query/rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "emca/query/vocabulary.h"
#include "query_for_tests.h"

namespace emca::query {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Path 0: two vertices, dark; path 1: one vertex, bright, whose weight is NaN; path 2: none, and no estimate.
PathSet threePaths() {
    return recorded([](Recording& r) {
        const auto dark = r.path({0, 0}, 0).finalEstimate(Color(0.1f)).add("end", "absorbed").add("left scene", true);
        dark.vertex(1).position(Vec3f{}).event(Event::reflect, Lobe::diffuse, "white wall").add("BSDF pdf", 0.5f).add("depth", 7).add("normal", Vec3f{0, 0, 1});
        dark.vertex(2).position(Vec3f{1, 0, 0}).event(Event::transmit, Lobe::specular, "glass \"A\"").add("BSDF pdf", 1e-6f);
        const auto bright = r.path({0, 0}, 1).finalEstimate(Color(100)).add("end", "Russian roulette").add("left scene", false);
        bright.vertex(1).position(Vec3f{}).event(Event::reflect, Lobe::diffuse, "white wall").add("weight", Color(kNan, 1, 1)).contribution(Color(9), "light sampling", 0.5f, LightEnd::connected);
        r.path({0, 0}, 2).add("end", "Russian roulette");
    });
}

std::vector<Index> taken(const Rule& rule, const PathSet& paths) {
    const auto text = toQuery(rule, paths);
    EXPECT_TRUE(text.ok()) << (text ? "" : text.error().message);
    if (!text) return {};
    const auto matches = parsed(*text).select(paths);
    EXPECT_TRUE(matches.ok()) << *text << ": " << (matches ? "" : matches.error().message);
    return matches ? matches->paths : std::vector<Index>{};
}

TEST(Vocabulary, EveryCoreQuantityDescribesItself) {
    const PathSet paths = threePaths();
    const auto all = coreQuantities();
    EXPECT_GT(all.size(), 30u);
    for (const Quantity& quantity : all) {
        const auto described = describe(" " + quantity.expression + "\n", paths);
        ASSERT_TRUE(described.ok()) << described.error().message;
        EXPECT_EQ(described->expression, quantity.expression);
        EXPECT_EQ(described->owner, quantity.owner) << quantity.expression;
        EXPECT_EQ(described->type, quantity.type) << quantity.expression;
        EXPECT_EQ(described->components, quantity.components) << quantity.expression;
        EXPECT_FALSE(quantity.meaning.empty());
    }
}

TEST(Vocabulary, DataIsNamedAsAQueryReadsIt) {
    const PathSet paths = threePaths();
    const auto data = dataOf(paths);
    std::vector<std::string> names;
    for (const Quantity& quantity : data) {
        names.push_back(quantity.expression);
        const auto described = describe(quantity.expression, paths);
        ASSERT_TRUE(described.ok()) << described.error().message;
        EXPECT_EQ(described->type, quantity.type) << quantity.expression;
        EXPECT_EQ(described->owner, quantity.owner) << quantity.expression;
        EXPECT_EQ(described->components, quantity.components) << quantity.expression;
        EXPECT_TRUE(described->data);
        for (const Quantity& part : partsOf(quantity)) {
            const auto number = describe(part.expression, paths);
            ASSERT_TRUE(number.ok()) << number.error().message;
            EXPECT_EQ(number->type, ExpressionType::number) << part.expression;
            EXPECT_EQ(number->owner, quantity.owner);
        }
    }
    EXPECT_EQ(names, (std::vector<std::string>{"end", "`left scene`", "v.`BSDF pdf`", "v.data[\"depth\"]", "v.normal", "v.weight"}));
    EXPECT_EQ(partsOf(data[4]).size(), 4u);
    EXPECT_EQ(partsOf(data[5]).front().expression, "luminance(v.weight)");
    EXPECT_TRUE(partsOf(data[0]).empty());
}

TEST(Vocabulary, DescribeTellsOwnersAndErrors) {
    const PathSet paths = threePaths();
    EXPECT_EQ(describe("c.luminance + v.depth", paths)->owner, Owner::contribution);
    EXPECT_EQ(describe("count(v.depth > 1)", paths)->owner, Owner::path);
    EXPECT_EQ(describe("n.visible", paths)->owner, Owner::shadowTest);
    EXPECT_EQ(describe("v.nobody", paths)->type, ExpressionType::missing);
    QueryError where;
    const auto wrong = describe("v.label + 1", paths, &where);
    ASSERT_FALSE(wrong.ok());
    EXPECT_FALSE(where.message.empty());
    EXPECT_FALSE(describe("", paths).ok());
    EXPECT_FALSE(describe("c.luminance + n.depth", paths).ok());
}

TEST(Vocabulary, TextsAreThoseThatOccurMostFrequentFirst) {
    const PathSet paths = threePaths();
    EXPECT_EQ(textsOf("v.label", paths), (std::vector<std::string>{"white wall", "glass \"A\""}));
    EXPECT_EQ(textsOf("end", paths), (std::vector<std::string>{"Russian roulette", "absorbed"}));
    EXPECT_EQ(textsOf("c.technique", paths), (std::vector<std::string>{"light sampling"}));
    EXPECT_EQ(textsOf("end", paths, 1).size(), 1u);
    EXPECT_TRUE(textsOf("luminance", paths).empty());
    EXPECT_TRUE(textsOf("v.nobody", paths).empty());
    EXPECT_TRUE(textsOf("v.label", PathSet()).empty());
}

TEST(Vocabulary, FunctionsHaveNames) {
    const auto all = functionNames();
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const FunctionName& f) { return f.name == "quantile" && f.maximumArguments == 3; }));
}

TEST(Rules, SayWhatTheQueriesSay) {
    using enum RuleOperator;
    using Found = std::vector<Index>;
    const PathSet paths = threePaths();
    EXPECT_EQ(taken({"luminance", {}, greater, "10"}, paths), Found{1});
    EXPECT_EQ(taken({"luminance", {}, less, "mean(luminance)"}, paths), Found{0});
    EXPECT_EQ(taken({"v.`BSDF pdf`", Quantifier::any, less, "1e-4"}, paths), Found{0});
    EXPECT_EQ(taken({"v.`BSDF pdf`", Quantifier::first, less, "1e-4"}, paths), Found{});
    EXPECT_EQ(taken({"v.`BSDF pdf`", Quantifier::last, less, "1e-4"}, paths), Found{0});
    EXPECT_EQ(taken({"v.depth", Quantifier::every, lessEqual, "1"}, paths), (Found{1, 2}));
    EXPECT_EQ(taken({"v.label", Quantifier::none, contains, "glass \"A"}, paths), (Found{1, 2}));
    EXPECT_EQ(taken({"v.label", Quantifier::last, startsWith, "glass"}, paths), Found{0});
    EXPECT_EQ(taken({"v.label", Quantifier::any, matches, "^white.*l$"}, paths), (Found{0, 1}));
    EXPECT_EQ(taken({"end", {}, equal, "absorbed"}, paths), Found{0});
    EXPECT_EQ(taken({"end", {}, notEqual, "absorbed"}, paths), (Found{1, 2}));
    EXPECT_EQ(taken({"end", {}, oneOf, "absorbed, escaped"}, paths), Found{0});
    EXPECT_EQ(taken({"depth", {}, oneOf, "1,2"}, paths), (Found{0, 1}));
    EXPECT_EQ(taken({"`left scene`", {}, isTrue, ""}, paths), Found{0});
    EXPECT_EQ(taken({"`left scene`", {}, isFalse, ""}, paths), Found{1});
    EXPECT_EQ(taken({"v.weight", Quantifier::any, isNan, ""}, paths), Found{1});
    EXPECT_EQ(taken({"`left scene`", {}, notRecorded, ""}, paths), Found{2});
    EXPECT_EQ(taken({"v.`BSDF pdf`", Quantifier::last, recorded, ""}, paths), Found{0});
    EXPECT_EQ(taken({"c.technique", Quantifier::any, equal, "light sampling"}, paths), Found{1});
}

TEST(Rules, ReadAsAPersonWouldWriteThem) {
    using enum RuleOperator;
    const PathSet paths = threePaths();
    EXPECT_EQ(*toQuery(Rule{"v.`BSDF pdf`", Quantifier::any, less, "1e-4"}, paths), "any(v.`BSDF pdf` < 1e-4)");
    const std::vector<Rule> rules{{"luminance", {}, greater, " 20 * mean(luminance) "}, {"", {}, less, "1"}, {"depth", {}, less, ""}, {"end", {}, equal, "absorbed"}};
    EXPECT_EQ(*toQuery(rules, paths), "luminance > 20 * mean(luminance) and end == \"absorbed\"");
    EXPECT_EQ(*toQuery(std::vector<Rule>{}, paths), "");
    // An expression that binds weakly stays one: rules are joined by `and`, whatever they say.
    const std::vector<Rule> weak{{"luminance > 1 or depth > 1", {}, isTrue, ""}, {"depth", {}, less, "9"}};
    EXPECT_EQ(*toQuery(weak, paths), "(luminance > 1 or depth > 1) and depth < 9");
}

TEST(Rules, WhatIsNoExpressionIsRefused) {
    using enum RuleOperator;
    const PathSet paths = threePaths();
    EXPECT_FALSE(toQuery(Rule{"luminance", {}, greater, "1) or (true"}, paths).ok());
    EXPECT_FALSE(toQuery(Rule{"luminance)", {}, greater, "1"}, paths).ok());
    EXPECT_FALSE(toQuery(Rule{"luminance", {}, greater, " "}, paths).ok());
    EXPECT_FALSE(toQuery(Rule{"depth", {}, oneOf, ", ,"}, paths).ok());
    // Texts are texts, whatever they look like.
    EXPECT_TRUE(taken({"end", {}, equal, "\") or (true"}, paths).empty());
    EXPECT_TRUE(taken({"v.nobody", Quantifier::any, equal, "no number"}, paths).empty());
}

TEST(Rules, EveryOperatorFitsTheTypesThatOfferIt) {
    const PathSet paths = threePaths();
    std::vector<Quantity> all = coreQuantities();
    for (const Quantity& quantity : dataOf(paths)) all.push_back(quantity);
    for (const Quantity& quantity : all) {
        for (const RuleOperator op : operatorsOf(quantity.type)) {
            EXPECT_STRNE(label(op), "");
            std::string value = "1";
            if (quantity.type == ExpressionType::color) value = "color(1, 1, 1)";
            if (quantity.type == ExpressionType::vector) value = quantity.components == 2 ? "vector(1, 1)" : "vector(1, 1, 1)";
            for (const Quantifier over : {Quantifier::any, Quantifier::every, Quantifier::none, Quantifier::first, Quantifier::last}) {
                const Rule rule{quantity.expression, over, op, needsValue(op) ? value : ""};
                taken(rule, paths);
                if (HasFailure()) FAIL() << quantity.expression << " " << label(op);
            }
        }
    }
}

}  // namespace
}  // namespace emca::query
