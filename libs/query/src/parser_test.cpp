#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "prepare.h"
#include "query_for_tests.h"
#include "syntax.h"

namespace emca::query {
namespace {

using detail::Kind;
using detail::Node;
using detail::Op;

/// The tree with all parentheses written.
std::string shape(const Node& node) {
    switch (node.kind) {
        case Kind::number: return std::abs(node.number) < 1e6 && node.number == static_cast<int>(node.number) ? std::to_string(static_cast<int>(node.number)) : std::to_string(node.number);
        case Kind::boolean: return node.number != 0 ? "true" : "false";
        case Kind::text: return "'" + node.text + "'";
        case Kind::lightPath: return "lpe'" + node.text + "'";
        case Kind::core: return std::string(detail::prefix(node.scope)) + (node.scope == detail::Domain::path ? "" : ".") + node.text;
        case Kind::user: return std::string(detail::prefix(node.scope)) + "[" + node.text + "]";
        default: break;
    }
    if (node.op == Op::member) return shape(node.children[0]) + "." + node.text;
    if (node.op == Op::subscript) return shape(node.children[0]) + "[" + std::to_string(static_cast<int>(node.number)) + "]";
    std::string out = "(" + node.text;
    for (const Node& child : node.children) out += " " + shape(child);
    return out + ")";
}

std::string shapeOf(std::string_view text) {
    Node root;
    QueryError error;
    return detail::parseExpression(text, root, error) ? shape(root) : "error: " + error.message;
}

TEST(QueryParser, Precedence) {
    EXPECT_EQ(shapeOf("1 + 2 * 3 - 4"), "(- (+ 1 (* 2 3)) 4)");
    EXPECT_EQ(shapeOf("8 / 4 / 2"), "(/ (/ 8 4) 2)");
    EXPECT_EQ(shapeOf("2 ^ 3 ^ 2"), "(^ 2 (^ 3 2))");
    EXPECT_EQ(shapeOf("-2 ^ 2"), "(- (^ 2 2))");
    EXPECT_EQ(shapeOf("2 ^ -1 * 3"), "(* (^ 2 (- 1)) 3)");
    EXPECT_EQ(shapeOf("-a * b"), "(* (- [a]) [b])");
    EXPECT_EQ(shapeOf("+a - -b"), "(- [a] (- [b]))");
    EXPECT_EQ(shapeOf("a < 1 and b > 2 or not c_ == 3"), "(or (and (< [a] 1) (> [b] 2)) (not (== [c_] 3)))");
    EXPECT_EQ(shapeOf("a || b && !d"), "(|| [a] (&& [b] (! [d])))");
    EXPECT_EQ(shapeOf("a or b and d or e"), "(or (or [a] (and [b] [d])) [e])");
    EXPECT_EQ(shapeOf("not not a"), "(not (not [a]))");
    EXPECT_EQ(shapeOf("(1 + 2) * 3 % 4"), "(% (* (+ 1 2) 3) 4)");
    EXPECT_EQ(shapeOf("a + 1 in (1, 2 * 3) and b"), "(and (in (+ [a] 1) 1 (* 2 3)) [b])");
    EXPECT_EQ(shapeOf("estimate.r + pixel[1]"), "(+ estimate.r pixel[1])");
    EXPECT_EQ(shapeOf("(estimate + estimate).g"), "(+ estimate estimate).g");
    EXPECT_EQ(shapeOf("-v.position.x"), "(- v.position.x)");
}

TEST(QueryParser, NamesAndQuotes) {
    EXPECT_EQ(shapeOf("v.pdf"), "v[pdf]");
    EXPECT_EQ(shapeOf("v.`BSDF pdf`"), "v[BSDF pdf]");
    EXPECT_EQ(shapeOf("v.'BSDF pdf'"), "v[BSDF pdf]");
    EXPECT_EQ(shapeOf("v.\"a \\\" b\""), "v[a \" b]");
    EXPECT_EQ(shapeOf("`left scene`"), "[left scene]");
    EXPECT_EQ(shapeOf("data['left scene']"), "[left scene]");
    EXPECT_EQ(shapeOf("v.data['position']"), "v[position]");
    EXPECT_EQ(shapeOf("v.position"), "v.position");
    EXPECT_EQ(shapeOf("v.`position`"), "v.position");
    EXPECT_EQ(shapeOf("`depth`"), "depth");
    EXPECT_EQ(shapeOf("v.and"), "v[and]");
    EXPECT_EQ(shapeOf("größe"), "[größe]");
    EXPECT_EQ(shapeOf("c.value.r"), "c.value.r");
    EXPECT_EQ(shapeOf("n.visible"), "n.visible");
    EXPECT_EQ(shapeOf("luminance(estimate) > luminance"), "(> (luminance estimate) luminance)");
    EXPECT_EQ(shapeOf("'\\d+\\\\ \\''"), "'\\d+\\ ''");
    EXPECT_EQ(shapeOf("nan"), shapeOf("nan()"));
    EXPECT_EQ(shapeOf("min(1, 2, 3)"), "(min 1 2 3)");
    EXPECT_EQ(shapeOf(".5e1"), "5");
    EXPECT_EQ(shapeOf("\tpi()\n>\r3"), "(> " + std::to_string(3.14159265358979) + " 3)");
}

TEST(QueryParser, QuotedNamesComeBack) {
    for (const std::string name : {"pdf", "BSDF pdf", "and", "true", "v", "c", "n", "data", "pi", "a`b", "a\\b", "", "5", "größe", "as"}) {
        EXPECT_EQ(shapeOf("v." + quotedName(name)), "v[" + name + "]") << quotedName(name);
        EXPECT_EQ(shapeOf(quotedName(name)), "[" + name + "]") << quotedName(name);
        EXPECT_EQ(shapeOf(quotedText(name)), "'" + name + "'") << quotedText(name);
    }
}

/// The error's sentence, and below the query where it points to.
std::string errorOf(std::string_view text) {
    QueryError error;
    const auto query = Query::parse(text, &error);
    if (query) return "no error";
    EXPECT_EQ(query.error().code, ErrorCode::parseFailed);
    EXPECT_LE(error.where.begin, error.where.end);
    EXPECT_LE(error.where.end, text.size());
    EXPECT_EQ(query.error().message, toError(text, error).message);
    return pointAt(text, error.where) + "\n" + query.error().message;
}

TEST(QueryParser, ErrorsNameTheCharacterAndWhatWasExpected) {
    EXPECT_EQ(errorOf(""), "\n^\nAt character 1: Expected a value, found the end of the query.");
    EXPECT_EQ(errorOf("1 +"), "1 +\n   ^\nAt character 4: Expected a value, found the end of the query.");
    EXPECT_EQ(errorOf("(1 + 2"), "(1 + 2\n      ^\nAt character 7: Expected ) to close the parenthesis, found the end of the query.");
    EXPECT_EQ(errorOf("luminance > 1)"), "luminance > 1)\n             ^\nAt character 14 ()): Expected an operator such as and, <, +, or the end, found the sign ).");
    EXPECT_EQ(errorOf("depth = 3"), "depth = 3\n      ^\nAt character 7 (=): A single = means nothing here: expected ==.");
    EXPECT_EQ(errorOf("depth > \"a"), "depth > \"a\n        ^^\nAt character 9 (\"a): This text is not closed: expected \" at its end.");
    EXPECT_EQ(errorOf("1 < depth < 3"), "1 < depth < 3\n  ^^^^^^^^^\nAt character 3 (< depth <): Two comparisons in a row: write a < b and b < c.");
    EXPECT_EQ(errorOf("anyy(v.depth > 1)"), "anyy(v.depth > 1)\n^^^^\nAt character 1 (anyy): There is no function anyy: did you mean any.");
    EXPECT_EQ(errorOf("sqrt(1, 2)"), "sqrt(1, 2)\n^^^^^^^^^^\nAt character 1 (sqrt(1, 2)): sqrt expects 1 argument, found 2.");
    EXPECT_EQ(errorOf("sqrt(1 2)"), "sqrt(1 2)\n       ^\nAt character 8 (2): Expected , or ) after an argument, found the number 2.");
    EXPECT_EQ(errorOf("v.depth > 1"), "v.depth > 1\n^^^^^^^\nAt character 1 (v.depth): vertices (v.) are many: say which by any(), all(), none(), count(), first(), mean() or the like.");
    EXPECT_EQ(errorOf("any(c.pdf > 1)"), "any(c.pdf > 1)\n      ^^^\nAt character 7 (pdf): c. has no pdf: expected one of value, luminance, technique, weight, end, depth.");
    EXPECT_EQ(errorOf("any(c.luminance > 1 and n.visible)"),
              "any(c.luminance > 1 and n.visible)\n                        ^^^^^^^^^\nAt character 25 (n.visible): Contributions (c.) and shadow tests (n.) are mixed: they have nothing to do with each other.");
    EXPECT_EQ(errorOf("any(v.lobe == 3)"), "any(v.lobe == 3)\n              ^\nAt character 15 (3): A text is compared with a number.");
    EXPECT_EQ(errorOf("estimate > 3"), "estimate > 3\n^^^^^^^^\nAt character 1 (estimate): “>” expects a number here, found a colour: luminance() makes a number of a colour.");
    EXPECT_EQ(errorOf("estimate.x > 3"), "estimate.x > 3\n^^^^^^^^^^\nAt character 1 (estimate.x): .x is a part of a vector, found a colour.");
    EXPECT_EQ(errorOf("estimate[3] > 3"), "estimate[3] > 3\n^^^^^^^^^^^\nAt character 1 (estimate[3]): There are only 3 components.");
    EXPECT_EQ(errorOf("estimate.q"), "estimate.q\n         ^\nAt character 10 (q): Expected x, y, z, r, g, b or a after the dot, found the name q.");
    EXPECT_EQ(errorOf("depth and true"), "depth and true\n^^^^^\nAt character 1 (depth): “and” expects a condition here, found a number: compare it with something.");
    EXPECT_EQ(errorOf("depth in 3"), "depth in 3\n         ^\nAt character 10 (3): Expected ( after in: a list of values in parentheses, found the number 3.");
    EXPECT_EQ(errorOf("depth in (3"), "depth in (3\n           ^\nAt character 12: Expected ) at the end of the list, found the end of the query.");
    EXPECT_EQ(errorOf("3x"), "3x\n^\nAt character 1 (3): A number is followed by a letter: put an operator or a blank between them.");
    EXPECT_EQ(errorOf("1e999 > 1"), "1e999 > 1\n^^^^^\nAt character 1 (1e999): This number is beyond what double precision holds.");
    EXPECT_EQ(errorOf("a ? b"), "a ? b\n  ^\nAt character 3 (?): The character ? has no meaning here.");
    EXPECT_EQ(errorOf("a and where"), "a and where\n      ^^^^^\nAt character 7 (where): Expected a value, found the name where.");
    EXPECT_EQ(errorOf("quantile(luminance, 2) > 1"), "quantile(luminance, 2) > 1\n                    ^\nAt character 21 (2): quantile expects a number in [0, 1] after the value.");
    EXPECT_EQ(errorOf("count() > 1"), "count() > 1\n^^^^^^^\nAt character 1 (count()): count() without an argument counts rows of a table: expected a condition, or use vertices or contributions.");
    EXPECT_EQ(errorOf("matches(t, t)"), "matches(t, t)\n           ^\nAt character 12 (t): matches expects a regular expression in quotes after the text.");
    EXPECT_EQ(errorOf("matches(t, '(a')").substr(0, 80), "matches(t, '(a')\n           ^^^^\nAt character 12 ('(a'): The regular expression ");
    EXPECT_EQ(errorOf("lpe(3)"), "lpe(3)\n^^^^^^\nAt character 1 (lpe(3)): lpe expects one light path expression in quotes, such as lpe(\"C<RD>L\").");
    EXPECT_EQ(errorOf("lpe('C<XD>L')"), "lpe('C<XD>L')\n       ^\nAt character 8 (X): In the light path expression: expected R, T, V or . after <, found X.");
    EXPECT_EQ(errorOf("lpe('C[DL')").substr(0, 25), "lpe('C[DL')\n         ^\nAt");
    EXPECT_EQ(errorOf("if(true, 1, 'a') == 1").substr(22), "            ^^^\nAt character 13 ('a'): if gives a number or a text: both must be of one type.");
    EXPECT_EQ(errorOf("v").substr(2), " ^\nAt character 2: Expected a name after v, such as v.depth, found the end of the query.");
    EXPECT_EQ(errorOf("v > 1"), "v > 1\n^\nAt character 1 (v): Expected a name after v, such as v.depth.");
}

TEST(QueryParser, PlacesAreCountedInCharacters) {
    EXPECT_EQ(errorOf("'grün' = 1"), "'grün' = 1\n       ^\nAt character 8 (=): A single = means nothing here: expected ==.");
    EXPECT_EQ(errorOf("lpe('Cü')"), "lpe('Cü')\n      ^\nAt character 7 (ü): In the light path expression: expected an event such as D, <RS>, [DG] or L, found ü.");
    // An excerpt ends between characters.
    const std::string text = "sqrt('" + std::string(33, 'a') + "üüüüü', 1)";
    QueryError error;
    EXPECT_NE(Query::parse(text, &error).error().message.find(std::string(33, 'a') + "…)"), std::string::npos) << errorOf(text);
}

TEST(QueryParser, WhatIsNoTextIsRefused) {
    for (const std::string& bad : {std::string("\xff"), std::string("a == '\xc3'"), std::string("\xed\xa0\x80"), std::string("\xf5\x80\x80\x80"), std::string("\xe0\x80\x80"), std::string("a\0b", 3)}) {
        QueryError error;
        const auto query = Query::parse(bad, &error);
        ASSERT_FALSE(query.ok());
        EXPECT_NE(query.error().message.find("This byte is no text in UTF-8"), std::string::npos);
    }
    EXPECT_TRUE(Query::parse("a == '\xf0\x9f\x92\xa1'").ok());
}

std::string repeated(const std::string& piece, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) out += piece;
    return out;
}

TEST(QueryParser, TooLongTooManyTooDeep) {
    EXPECT_NE(errorOf(repeated(" ", Query::kMaximumLength + 1)).find("at most 65536 are allowed"), std::string::npos);
    EXPECT_NE(errorOf("1" + repeated("+1", Query::kMaximumNodes)).find("more than 4096 parts"), std::string::npos);
    EXPECT_NE(errorOf("foo" + repeated(".x", Query::kMaximumNodes)).find("more than 4096 parts"), std::string::npos);
    for (const std::string open : {"(", "-", "not ", "abs(", "1^", "1 + (", "any("}) {
        EXPECT_NE(errorOf(repeated(open, 300)).find("nested deeper than 200 levels"), std::string::npos) << open;
        EXPECT_NE(errorOf(repeated(open, 10'000)).find("nested deeper than 200 levels"), std::string::npos) << open;
    }
    EXPECT_EQ(errorOf(repeated("(", 150) + "true" + repeated(")", 150)), "no error");
    EXPECT_EQ(errorOf(repeated("not ", 150) + "true"), "no error");
}

TEST(QueryParser, LongChainsAreEvaluated) {
    const PathSet paths = recorded([](Recording& r) { r.path({0, 0}, 0).finalEstimate(Color(1)).vertex(1).add("x", 1.f); });
    EXPECT_EQ(truths("1" + repeated("+1", 2040) + " == 2041", paths), "1");
    EXPECT_EQ(truths("any(v.x" + repeated("+v.x", 2040) + " == 2041)", paths), "1");
    EXPECT_EQ(truths("true" + repeated(" and true", 2040), paths), "1");
    EXPECT_EQ(truths("2041 in (0" + repeated(", 1", 2030) + ", 2041)", paths), "1");
    EXPECT_EQ(truths("max(0" + repeated(", 1", 4000) + ") == 1", paths), "1");
    EXPECT_EQ(truths(repeated("(1 + ", 90) + "1" + repeated(")", 90) + " == 91", paths), "1");
}

TEST(QueryParser, ColumnsAreWhatIsRead) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(parsed("true").columns(), Names{"estimate"});  // an empty list would mean all
    EXPECT_EQ(parsed("any(v.`BSDF pdf` < 1) and luminance > depth").columns(), (Names{"BSDF pdf", "estimate", "position"}));
    EXPECT_EQ(parsed("lpe('CL')").columns(), (Names{"contribution", "emission", "event"}));
    EXPECT_EQ(parsed("any(n.visible) and sum(c.weight) > first(v.mesh) and any(v.luminance > 1)").columns(), (Names{"contribution", "intersection estimate", "nee", "surface"}));
    EXPECT_FALSE(parsed("any(v.depth > 3)").readsWholePixels());
    EXPECT_TRUE(parsed("luminance > 10 * mean(luminance)").readsWholePixels());
    EXPECT_TRUE(parsed("any(v.depth > max(luminance))").readsWholePixels());
    EXPECT_TRUE(parsed("none(nan(estimate))").readsWholePixels());
}

TEST(QueryParser, RegularExpressionsAreBounded) {
    EXPECT_NE(errorOf("matches(t, '" + repeated("(", 50) + "a" + repeated("{100})", 50) + "')"), "no error");
    EXPECT_NE(errorOf("matches(t, '((a{1000}){1000}){1000}')"), "no error");
    EXPECT_NE(errorOf("lpe('C(((D{1000}){1000}){1000})L')"), "no error");
    EXPECT_NE(errorOf("lpe('C" + repeated("D{999}", 600) + "L')"), "no error");
    EXPECT_NE(errorOf("lpe('" + repeated("D", 5000) + "')"), "no error");
    EXPECT_NE(errorOf("lpe('" + repeated("(", 1000) + "')"), "no error");
    std::string many = "false";
    for (int i = 0; i < 200; ++i) many += " or lpe('C.{900}L')";
    EXPECT_NE(errorOf(many).find("too large together"), std::string::npos);
    EXPECT_EQ(errorOf("lpe('CD{0,10}L') or lpe('C<.S\"glass\">L')").substr(0, 3), "lpe");
    EXPECT_EQ(errorOf("lpe('CD{0,10}L') or lpe(\"C<.S'glass'>{1,20}L\")"), "no error");
}

}  // namespace
}  // namespace emca::query
