// What queries mean, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "query_for_tests.h"

namespace emca::query {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Three paths. The first two belong to one pixel; the third has no vertices and no estimate.
PathSet threePaths() {
    return recorded([](Recording& r) {
        const auto first = r.path({0, 0}, 0);
        first.origin(Vec3f{0, 0, -5}).finalEstimate(Color(1, 2, 3)).add("left scene", false).add("yes", true).add("no", false).add("end", "roulette");
        first.vertex(1).position(Vec3f{0, 0, 0}).add("pdf", 0.1f).add("name", "table").add("n", std::int64_t{4}).event(Event::reflect, Lobe::diffuse, "wood").surface(2, 7);
        first.vertex(2).position(Vec3f{3, 4, 0}).add("pdf", 2.f).add("name", "window").event(Event::transmit, Lobe::specular, "glass").estimate(Color(5));
        first.vertex(2).contribution(Color(0.5f), "light sampling", 0.25f, LightEnd::connected).contribution(Color(4, 0, -1), "BSDF sampling");
        first.vertex(2).nextEvent(Vec3f{0, 9, 0}, true).nextEvent(Vec3f{0, 8, 0}, false);
        first.vertex(3).environment(Vec3f{100, 0, 0}).emission(Color(7)).contribution(Color(2), "BSDF sampling", 1.f, LightEnd::hit);
        const auto second = r.path({0, 0}, 1);
        second.finalEstimate(Color(kNan, 0, 0)).add("left scene", true).add("yes", true).add("no", false);
        second.vertex(1).position(Vec3f{1, 1, 1}).add("pdf", kNan).add("spectrum", std::vector<float>{1, 2, 3});
        second.vertex(2).add("pdf", kInf).add("pdf", 0.5f).nextEvent(Vec3f{0, 0, 0}, false);
        r.path({1, 0}, 7, 2).add("yes", true).add("no", false).add("end", "camera");
    });
}

TEST(QuerySemantics, LogicAfterKleene) {
    const PathSet one = recorded([](Recording& r) { r.path({0, 0}, 0).finalEstimate(Color(1)); });
    const std::string names[] = {"false", "true", "gone"};
    const std::string both[] = {"000", "01?", "0??"}, either[] = {"01?", "111", "?1?"}, equal[] = {"10?", "01?", "???"};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            const auto is = [&](const char* op, const std::string (&table)[3]) {
                EXPECT_EQ(truths(names[a] + " " + op + " " + names[b], one), table[a].substr(static_cast<std::size_t>(b), 1)) << names[a] << op << names[b];
            };
            is("and", both);
            is("&&", both);
            is("or", either);
            is("||", either);
            is("==", equal);
        }
    EXPECT_EQ(truths("not true", one), "0");
    EXPECT_EQ(truths("!false", one), "1");
    EXPECT_EQ(truths("not gone", one), "?");
}

TEST(QuerySemantics, WhatWasNotRecordedIsUnknown) {
    const PathSet paths = threePaths();
    EXPECT_EQ(truths("luminance > 1", paths), "10?");
    EXPECT_EQ(truths("not luminance > 1", paths), "01?");
    EXPECT_EQ(truths("luminance > 1 or yes", paths), "111");
    EXPECT_EQ(truths("luminance > 1 and no", paths), "000");
    EXPECT_EQ(truths("has(luminance)", paths), "110");
    EXPECT_EQ(truths("has(origin)", paths), "100");
    EXPECT_EQ(truths("has(gone)", paths), "000");
    EXPECT_EQ(truths("any(has(v.spectrum))", paths), "010");
    EXPECT_EQ(truths("gone + 1 > 0", paths), "???");
    EXPECT_EQ(truths("any(v.gone == 'x')", paths), "??0");
    EXPECT_EQ(truths("luminance(gone) > 1 or length(gone) > 1 or gone.x > 1 or normalize(gone).y > 1", paths), "???");
    EXPECT_EQ(parsed("gone > 1 and any(v.lost) and any(v.pdf > 1)").select(paths)->missing, (std::vector<std::string>{"gone", "lost"}));
}

TEST(QuerySemantics, NotANumberIsAValue) {
    const PathSet paths = threePaths();
    EXPECT_EQ(truths("luminance == luminance", paths), "10?");
    EXPECT_EQ(truths("luminance != luminance", paths), "01?");
    EXPECT_EQ(truths("luminance < 1 or luminance >= 1", paths), "10?");
    EXPECT_EQ(truths("nan(luminance)", paths), "01?");
    EXPECT_EQ(truths("nan(estimate)", paths), "01?");
    EXPECT_EQ(truths("finite(estimate)", paths), "10?");
    EXPECT_EQ(truths("any(nan(v.pdf))", paths), "?10") << "one vertex has no pdf";
    EXPECT_EQ(truths("inf(1/0) and nan(0/0) and nan(nan) and inf(-inf)", paths), "111");
    EXPECT_EQ(truths("any(inf(v.pdf))", paths), "?00") << "the last value of a repeated key is read";
}

TEST(QuerySemantics, Quantifiers) {
    const PathSet paths = threePaths();
    EXPECT_EQ(truths("any(v.depth > 2)", paths), "100");
    EXPECT_EQ(truths("all(v.depth > 0)", paths), "111") << "of none, all are";
    EXPECT_EQ(truths("none(v.depth > 2)", paths), "011");
    EXPECT_EQ(truths("any(v.pdf > 1.5)", paths), "100");
    EXPECT_EQ(truths("all(v.pdf > 0.05)", paths), "?01") << "vertex 3 has none; NaN is not greater";
    EXPECT_EQ(truths("any(v.pdf > 3)", paths), "?00");
    EXPECT_EQ(truths("count(v.pdf > 0.05) == 2", paths), "100");
    EXPECT_EQ(truths("any(c.luminance > 1)", paths), "100");
    EXPECT_EQ(truths("count(c.technique == 'BSDF sampling') == 2", paths), "100");
    EXPECT_EQ(truths("any(c.weight < 0.5)", paths), "100");
    EXPECT_EQ(truths("all(c.weight <= 1)", paths), "?11") << "one weight was not said";
    EXPECT_EQ(truths("any(c.end == 'hit' and v.environment)", paths), "100");
    EXPECT_EQ(truths("any(c.value.b < 0 and c.depth == 2)", paths), "100");
    EXPECT_EQ(truths("any(n.visible)", paths), "100");
    EXPECT_EQ(truths("none(n.visible)", paths), "011");
    EXPECT_EQ(truths("any(not n.visible and distance(n.position, v.position) == 5)", paths), "1?0") << "from (3, 4, 0) to (0, 8, 0)";
    EXPECT_EQ(truths("any(v.depth > 1 and any(c.luminance > 1))", paths), "100");
    EXPECT_EQ(truths("any(v.depth == 1 and any(c.luminance > 1))", paths), "000");
    EXPECT_EQ(truths("all(count(n.visible) == count(not n.visible) or v.depth == 2)", paths), "111");
    EXPECT_EQ(truths("any(c.luminance > 1 and any(n.visible))", paths), "000");
    EXPECT_EQ(truths("any(c.luminance < 1 and any(n.visible))", paths), "100");
}

TEST(QuerySemantics, PathsOfAPixel) {
    const PathSet paths = recorded([](Recording& r) {
        for (int p = 0; p < 4; ++p) r.path({0, 0}, p).finalEstimate(Color(p == 2 ? 100.f : 1.f)).vertex(p).add("x", 1.f);
        for (int p = 0; p < 3; ++p) r.path({1, 0}, p).finalEstimate(Color(p == 1 ? kNan : 1.f));
        r.path({0, 1}, 0).finalEstimate(Color(3));
    });
    EXPECT_EQ(truths("luminance > 3 * mean(luminance)", paths), "00100000");
    EXPECT_EQ(truths("none(nan(estimate))", paths), "11110001");
    EXPECT_EQ(truths("count(true) == 3", paths), "00001110");
    EXPECT_EQ(truths("nan(sum(luminance))", paths), "00001110") << "NaN is passed on";
    EXPECT_EQ(truths("sample == last(sample)", paths), "00010011");
    EXPECT_EQ(truths("max(count(v.depth >= 0)) == 1", paths), "11110000") << "a reduction in one: over vertices, then over paths";
    EXPECT_EQ(truths("any(v.depth == max(depth) + 3)", paths), "00010000");
}

TEST(QuerySemantics, Reductions) {
    const PathSet paths = recorded([](Recording& r) {
        const auto a = r.path({0, 0}, 0);
        const float x[] = {4, 1, 3, 2, 5};
        for (int i = 0; i < 5; ++i) a.vertex(i + 1).add("x", x[i]).position(Vec3f{x[i], 0, 1});
        a.vertex(9).add("y", 1.f);
        r.path({0, 0}, 1).vertex(1).add("x", 8.f);
        r.path({0, 0}, 2).vertex(1).add("y", 1.f);
    });
    EXPECT_EQ(truths("sum(v.x) == 15 and mean(v.x) == 3 and min(v.x) == 1 and max(v.x) == 5", paths), "100") << "min and max of nothing are unknown, the rest false";
    EXPECT_EQ(truths("variance(v.x) == 2.5", paths), "1??") << "of one there is none";
    EXPECT_EQ(truths("first(v.x) == 4 and last(v.x) == 5", paths), "10?");
    EXPECT_EQ(truths("first(v.x, v.depth > 1) == 1 and last(v.x, v.x < 3) == 2", paths), "1??");
    EXPECT_EQ(truths("sum(v.x, v.x > 2) == 12 and mean(v.x, v.depth <= 2) == 2.5", paths), "100");
    EXPECT_EQ(truths("sum(v.x) == 0", paths), "001") << "the sum of nothing";
    EXPECT_EQ(truths("quantile(v.x, 0.5) == 3 and quantile(v.x, 0) == 1 and quantile(v.x, 1) == 5 and quantile(v.x, 0.125) == 1.5", paths), "10?");
    EXPECT_EQ(truths("quantile(v.x, 0.5, v.x != 5) == 2.5", paths), "10?");
    EXPECT_EQ(truths("mean(v.position) == vector(3, 0, 1)", paths), "1??");
    EXPECT_EQ(truths("first(v.position).x == 4", paths), "1??");
}

TEST(QuerySemantics, KeysWithSeveralValuesAndTypes) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        p.vertex(1).add("again", 1.f).add("again", 2.f).add("number", std::int64_t{3}).add("both", "text").add("position", 9.f).position(Vec3f{1, 2, 3}).add("depth", "deep");
        p.vertex(2).add("number", 0.5).add("both", 7.f);
    });
    EXPECT_EQ(truths("any(v.again == 1)", paths), "?");
    EXPECT_EQ(truths("any(v.again == 2)", paths), "1");
    EXPECT_EQ(truths("any(v.number == 3) and any(v.number == 0.5)", paths), "1");
    EXPECT_EQ(truths("any(v.both == 'text') and any(v.both == 7)", paths), "1");
    EXPECT_EQ(truths("count(has(v.both)) == 2", paths), "1") << "of whatever type";
    EXPECT_EQ(truths("any(starts_with(v.both, 'te'))", paths), "1");
    EXPECT_EQ(truths("any(v.position.z == 3) and any(v.data['position'] == 9)", paths), "1");
    EXPECT_EQ(truths("any(v.data['depth'] == 'deep') and any(v.depth == 2)", paths), "1");
}

TEST(QuerySemantics, FloatsAndLiterals) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({7, 9}, 0);
        p.finalEstimate(Color(0.1f));
        p.vertex(1).add("pdf", 0.1f).add("double", 0.1).add("big", kInf).add("zero", 0.f).position(Vec3f{0.1f, 0, 0}).contribution(Color(0.1f), "x", 0.1f);
    });
    for (const std::string yes : {"any(v.pdf == 0.1)", "any(0.1 == v.pdf)", "any(v.pdf in (0.3, 0.1))", "any(v.pdf <= 0.1)", "none(v.pdf > 0.1)", "any(v.double == 0.1)", "any(-v.pdf == -v.pdf)",
                                  "estimate.r == 0.1", "first(v.position).x == 0.1", "any(v.position.x == 0.1)", "any(c.weight == 0.1 and c.value.g == 0.1)", "min(v.pdf) == 0.1", "none(-v.pdf == -0.1)",
                                  // Beyond the range of float a literal stays what it is.
                                  "none(v.big == 1e300)", "any(v.big > 1e300)", "none(v.zero == 1e-300)", "any(v.zero < 1e-300)", "none(v.zero >= 1e-300)"})
        EXPECT_EQ(truths(yes, paths), "1") << yes;
    EXPECT_EQ(truths("pixel.x == 7 and pixel.y == 9 and pixel == vector(7, 9)", paths), "1");
}

TEST(QuerySemantics, SpectraColoursVectorsTexts) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        p.finalEstimate(Color(1, 2, 3)).add("t", "rough glass").add("rgba", ColorA{1, 2, 3, 0.5f}).add("uv", Vec2f{3, 4}).add("s", std::vector<float>{5, 6});
        p.vertex(1).add("s", std::vector<float>{1, 2, 3});
        p.vertex(2).add("s", std::vector<float>{});
    });
    for (const std::string yes : {"s[0] == 5 and s[1] == 6", "any(v.s[2] == 3)", "count(has(v.s[0])) == 1", "count(has(v.s)) == 2", "first(v.s)[1] == 2", "not has(s[2])",
                                  "estimate == color(1, 2, 3)", "estimate * 2 == color(2, 4, 6)", "2 * estimate - estimate == estimate", "estimate * estimate == color(1, 4, 9)", "estimate / 2 == color(0.5, 1, 1.5)",
                                  "rgba.a == 0.5 and rgba[3] == 0.5 and rgba.g == 2", "length(uv) == 5 and uv.y == 4 and uv[0] == 3", "abs(luminance(color(1, 1, 1)) - 1) < 1e-9",
                                  "cross(vector(1, 0, 0), vector(0, 1, 0)) == vector(0, 0, 1)", "dot(vector(1, 2), vector(3, 4)) == 11", "normalize(vector(0, 0, 2)).z == 1",
                                  "contains(t, 'gh g') and starts_with(t, 'rough') and not starts_with(t, 'glass')", "matches(t, '^r.*s$') and matches(t, \"g[a-z]\\w+\") and not matches(t, '^glass')",
                                  "t in ('x', 'rough glass')", "if(luminance > 1, 'bright', 'dark') == 'bright'", "if(luminance < 1, rgba, rgba * 2).r == 2", "if(true, 1, gone) == 1",
                                  "min(3, 1, 2) == 1 and max(1, 3, 2) == 3 and clamp(5, 0, 2) == 2 and clamp(-1, 0, 2) == 0", "nan(max(nan, 1)) and nan(min(1, nan))",
                                  "round(2.5) == 3 and floor(-0.5) == -1 and ceil(0.2) == 1 and -7 % 3 == -1 and 2 ^ 0.5 == sqrt(2) and pow(2, 3) == 8", "log2(8) == 3 and log10(1000) == 3 and log(exp(2)) == 2",
                                  "atan2(1, 0) == pi / 2 and cos(0) == 1", "1 in (gone, 1)", "not (1 in (2, 3))"})
        EXPECT_EQ(truths(yes, paths), "1") << yes;
    EXPECT_EQ(truths("1 in (2, gone)", paths), "?");
    EXPECT_EQ(truths("if(gone, true, true)", paths), "?");
    EXPECT_NE(truths("if(true, estimate, rgba) == rgba", paths).find("if gives a colour or a colour with opacity"), std::string::npos);
    EXPECT_EQ(truths("t == 5", paths), "At character 6 (5): A text is compared with a number.");
    EXPECT_NE(truths("s == s", paths).find("Spectra cannot be compared"), std::string::npos);
    EXPECT_NE(truths("if(true, s, s)[0] == 1", paths).find("Spectra cannot be chosen"), std::string::npos);
    EXPECT_NE(truths("uv + estimate == uv", paths).find("“+” does not go between a vector of 2 and a colour"), std::string::npos);
    EXPECT_NE(truths("nan(t)", paths).find("nan expects a number, colour or vector, found a text"), std::string::npos);
    EXPECT_FALSE(parsed("s").evaluate(paths).ok());
    EXPECT_NE(parsed("luminance").select(paths).error().message.find("expected a condition"), std::string::npos);
}

TEST(QuerySemantics, Quantities) {
    const PathSet paths = threePaths();
    EXPECT_EQ(truths("vertices == 3 and depth == 3 and contributions == 3 and splats == 0 and sample == 0 and part == 0", paths), "100");
    EXPECT_EQ(truths("sample == 7 and part == 2 and pixel.x == 1 and vertices == 0 and depth == 0", paths), "001");
    EXPECT_EQ(truths("depth == 1 and vertices == 2", paths), "010") << "vertex 2 has no position";
    EXPECT_EQ(truths("any(v.segment == 5) and count(has(v.segment)) == 2", paths), "100") << "from (0, 0, 0) to (3, 4, 0)";
    EXPECT_EQ(truths("origin.z == -5", paths), "1??");
    EXPECT_EQ(truths("any(v.mesh == 2 and v.face == 7 and v.label == 'wood' and v.lobe == 'diffuse' and v.event == 'reflect' and v.index == 0 and not v.last)", paths), "1?0");
    EXPECT_EQ(truths("any(v.last and v.environment and v.emission == color(7, 7, 7) and v.subpath == 'camera')", paths), "100");
    EXPECT_EQ(truths("any(v.luminance > 4.9 and v.luminance < 5.1 and v.estimate.g == 5)", paths), "1?0");
    EXPECT_EQ(truths("any(c.end == 'automatic' and not has(c.weight))", paths), "100");
    EXPECT_EQ(truths("any(n.position.y == 8 and n.depth == 2)", paths), "100");
    EXPECT_EQ(truths("`left scene`", paths), "01?");
    EXPECT_EQ(truths("end == 'roulette'", paths), "1?0");
}

TEST(QuerySemantics, SetsWithNothingInThem) {
    EXPECT_EQ(truths("any(v.label == 'x') or luminance > mean(luminance)", PathSet{}), "");
    const PathSet bare = recorded([](Recording& r) { r.path({0, 0}, 0).finalEstimate(Color(1)); });
    EXPECT_EQ(truths("any(contains(v.label, 'x')) or any(matches(v.t, 'x')) or any(1 in (v.pdf, 1)) or any(v.label in ('a', 'b'))", bare), "0");
    EXPECT_EQ(truths("any(c.technique == 'x') or any(n.visible) or any(if(n.visible, 'a', 'b') == 'a')", bare), "0");
    EXPECT_EQ(truths("true and 1 < 2 and 'a' == 'a' and contains('abc', 'b') and 1 in (1, 2)", bare), "1");
}

TEST(QuerySemantics, EvaluateGivesOneValuePerPath) {
    const PathSet paths = threePaths();
    const auto estimate = parsed("estimate * 2").evaluate(paths);
    ASSERT_TRUE(estimate.ok());
    EXPECT_EQ(estimate->type, ExpressionType::color);
    EXPECT_EQ(estimate->components, 3);
    EXPECT_EQ(estimate->known, (std::vector<std::uint8_t>{1, 1, 0}));
    EXPECT_EQ(std::vector<double>(estimate->numbers.begin(), estimate->numbers.begin() + 3), (std::vector<double>{2, 4, 6}));
    ASSERT_EQ(estimate->numbers.size(), 9u);
    EXPECT_TRUE(std::isnan(estimate->numbers[8]));
    const auto label = parsed("first(v.label)").evaluate(paths);
    EXPECT_EQ(label->texts, (std::vector<std::string>{"wood", "", ""}));
    EXPECT_EQ(label->components, 0);
    const auto gone = parsed("gone").evaluate(paths);
    EXPECT_EQ(gone->type, ExpressionType::missing);
    EXPECT_EQ(gone->known, (std::vector<std::uint8_t>{0, 0, 0}));
    EXPECT_EQ(gone->missing, std::vector<std::string>{"gone"});
}

TEST(QuerySemantics, LimitsAndCancelling) {
    const PathSet paths = recorded([](Recording& r) {
        for (int p = 0; p < 9000; ++p) r.path({0, 0}, p).finalEstimate(Color(1)).vertex(1).add("x", 1.f);
    });
    EvaluationLimits limits;
    int asked = 0;
    limits.cancelled = [&] { return ++asked == 2; };
    EXPECT_EQ(parsed("luminance > 0").select(paths, limits).error().code, ErrorCode::cancelled);
    EXPECT_EQ(asked, 2);
    limits = {};
    limits.temporaryBytes = 300'000;
    EXPECT_TRUE(parsed("luminance > 0").select(paths, limits).ok());
    const auto whole = parsed("luminance > mean(luminance) + variance(luminance)").select(paths, limits);
    ASSERT_FALSE(whole.ok());
    EXPECT_EQ(whole.error().code, ErrorCode::tooLarge);
    EXPECT_NE(whole.error().message.find("a whole pixel with 9000 vertices"), std::string::npos) << whole.error().message;
    std::string wide = "any(max(0";
    for (int i = 0; i < 1000; ++i) wide += ", v.x";
    EXPECT_EQ(parsed(wide + ") > 0)").select(paths, limits).error().code, ErrorCode::tooLarge) << "a thousand arguments at once";
}

}  // namespace
}  // namespace emca::query
