#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "syntax.h"

namespace emca::query::detail {

/// Random queries whose types fit RandomPaths.
class RandomQueries {
  public:
    explicit RandomQueries(unsigned seed) : random_(seed) {}

    std::string condition(int depth = 4) { return boolean(Domain::path, depth); }
    std::string value(int depth = 4) {
        switch (upTo(5)) {
            case 0: return color(Domain::path, depth);
            case 1: return vector(Domain::path, depth);
            case 2: return text(Domain::path, depth);
            default: return number(Domain::path, depth);
        }
    }

  private:
    using Names = std::initializer_list<const char*>;
    int upTo(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    const char* one(Names names) { return names.begin()[upTo(static_cast<int>(names.size()))]; }

    /// A name of the domain that the expression is in, or of one around it.
    std::string leaf(Domain domain, Names path, Names vertex, Names contribution, Names nextEvent) {
        while (true) {
            const bool own = upTo(3) != 0;
            const Names names = domain == Domain::contribution ? contribution : domain == Domain::nextEvent ? nextEvent : domain == Domain::vertex ? vertex : path;
            if (names.size() > 0 && (own || domain == Domain::path)) return one(names);
            domain = domain == Domain::vertex ? Domain::path : Domain::vertex;
        }
    }

    std::string literal() { return one({"0", "1", "2", "0.1", "0.5", "-1", "1e-4", "3", "10", "pi", "inf", "nan", "1e300", "-1e-60"}); }

    std::string numberName(Domain domain) {
        return leaf(domain,
                    {"sample", "part", "luminance", "depth", "vertices", "contributions", "splats", "pixel.x", "estimate.g", "estimate[1]", "origin.z", "f", "d", "i",
                     "dense", "again", "mixed", "`rare key`", "s[1]", "col.r", "ca.a", "vd.y", "v2[0]", "data['position']", "never"},
                    {"v.depth", "v.index", "v.segment", "v.luminance", "v.mesh", "v.face", "v.position.y", "v.estimate.r", "v.emission.g", "v.f", "v.d", "v.i", "v.dense", "v.again",
                     "v.mixed", "v.'rare key'", "v.s[0]", "v.s[2]", "v.col.b", "v.ca[3]", "v.vd.z", "v.v2.y", "v.data[\"position\"]", "v.`dense vector`.x", "v.never"},
                    {"c.luminance", "c.weight", "c.depth", "c.value.b"}, {"n.depth", "n.position.x", "n.position[2]"});
    }
    std::string colorName(Domain domain) {
        return leaf(domain, {"estimate", "col", "color(1, 0, 2)"}, {"v.estimate", "v.emission", "v.col", "color(v.f, 0.5, dense)"}, {"c.value"}, {});
    }
    std::string vectorName(Domain domain) {
        return leaf(domain, {"origin", "`dense vector`", "vd", "vector(1, 2, 3)"}, {"v.position", "v.'dense vector'", "v.vd", "vector(v.f, 1, v.depth)"}, {}, {"n.position"});
    }
    std::string textName(Domain domain) {
        return leaf(domain, {"t", "'glass'", "neverText"}, {"v.t", "v.event", "v.lobe", "v.label", "v.subpath", "v.neverText"}, {"c.technique", "c.end"}, {});
    }
    std::string booleanName(Domain domain) {
        return leaf(domain, {"b", "true", "false", "neverBool"}, {"v.b", "v.environment", "v.last", "v.neverBool"}, {}, {"n.visible"});
    }
    std::string textLiteral() { return one({"''", "\"a\"", "'ab'", "'glass'", "'diffuse'", "'reflect'", "'hit'", "'camera'", "'grün'"}); }
    Domain anyDomain() {
        constexpr Domain kDomains[] = {Domain::path, Domain::vertex, Domain::vertex, Domain::vertex, Domain::contribution, Domain::nextEvent};
        return kDomains[upTo(6)];
    }

    /// Arguments of a reduction over what is innermost in them.
    template <typename Value>
    std::string reduced(const std::string& function, Value value, int depth, const char* between = "") {
        const Domain inside = anyDomain();
        const std::string argument = value(inside, depth - 1);
        const std::string condition = upTo(3) == 0 ? ", " + boolean(inside, depth - 1) : "";
        return function + "(" + argument + between + condition + ")";
    }

    std::string number(Domain domain, int depth) {
        const auto operand = [&] { return number(domain, depth - 1); };
        const auto recurse = [&](Domain d, int n) { return number(d, n); };
        if (depth <= 0) return upTo(4) == 0 ? literal() : numberName(domain);
        switch (upTo(16)) {
            case 0: case 1: return literal();
            case 2: case 3: return numberName(domain);
            case 4: case 5: case 6: return "(" + operand() + " " + one({"+", "-", "*", "/", "%", "^"}) + " " + operand() + ")";
            case 7: return one({"-", "+"}) + operand();
            case 8: return std::string(one({"abs", "sqrt", "exp", "log", "log2", "log10", "floor", "ceil", "round", "sin", "cos", "tan", "asin", "acos", "atan"})) + "(" + operand() + ")";
            case 9: return std::string(one({"pow", "atan2", "min", "max"})) + "(" + operand() + ", " + operand() + ")";
            case 10: return std::string(one({"clamp", "min", "max"})) + "(" + operand() + ", " + operand() + ", " + operand() + ")";
            case 11: return "if(" + boolean(domain, depth - 1) + ", " + operand() + ", " + operand() + ")";
            case 12: return upTo(2) ? "luminance(" + color(domain, depth - 1) + ")" : "length(" + vector(domain, depth - 1) + ")";
            case 13: return std::string(one({"dot", "distance"})) + "(" + vector(domain, depth - 1) + ", " + vector(domain, depth - 1) + ")";
            case 14: {
                if (upTo(3) == 0) return "count(" + boolean(anyDomain(), depth - 1) + ")";
                if (upTo(4) == 0) return reduced("quantile", recurse, depth, one({", 0", ", 0.5", ", 0.9", ", 1"}));
                if (upTo(3) == 0) return std::string(one({"min", "max"})) + "(" + number(anyDomain(), depth - 1) + ")";
                return reduced(one({"sum", "mean", "variance", "first", "last"}), recurse, depth);
            }
            default: return color(domain, depth - 1) + one({".r", "[2]"});
        }
    }

    std::string color(Domain domain, int depth) {
        if (depth <= 0) return colorName(domain);
        switch (upTo(6)) {
            case 0: return "(" + color(domain, depth - 1) + one({" + ", " - ", " * ", " / "}) + color(domain, depth - 1) + ")";
            case 1: return "(" + number(domain, depth - 1) + " * " + color(domain, depth - 1) + ")";
            case 2: return reduced(one({"sum", "mean", "first", "last"}), [&](Domain d, int n) { return color(d, n); }, depth);
            case 3: return "if(" + boolean(domain, depth - 1) + ", " + color(domain, depth - 1) + ", " + colorName(domain) + ")";
            default: return colorName(domain);
        }
    }

    std::string vector(Domain domain, int depth) {
        if (depth <= 0) return vectorName(domain);
        switch (upTo(7)) {
            case 0: return "(" + vector(domain, depth - 1) + one({" + ", " - "}) + vector(domain, depth - 1) + ")";
            case 1: return "(" + vector(domain, depth - 1) + one({" * ", " / "}) + number(domain, depth - 1) + ")";
            case 2: return reduced(one({"sum", "mean", "first", "last"}), [&](Domain d, int n) { return vector(d, n); }, depth);
            case 3: return "cross(" + vector(domain, depth - 1) + ", " + vectorName(domain) + ")";
            case 4: return "normalize(" + vector(domain, depth - 1) + ")";
            default: return vectorName(domain);
        }
    }

    std::string text(Domain domain, int depth) {
        if (depth > 0 && upTo(4) == 0) return reduced(one({"first", "last"}), [&](Domain d, int n) { return text(d, n); }, depth);
        if (depth > 0 && upTo(6) == 0) return "if(" + boolean(domain, depth - 1) + ", " + textName(domain) + ", " + textLiteral() + ")";
        return textName(domain);
    }

    std::string boolean(Domain domain, int depth) {
        if (depth <= 0) return booleanName(domain);
        const auto operand = [&] { return boolean(domain, depth - 1); };
        switch (upTo(14)) {
            case 0: return booleanName(domain);
            case 1: return "(not " + operand() + ")";
            case 2: case 3: return "(" + operand() + one({" and ", " or ", " && ", " || ", " == ", " != "}) + operand() + ")";
            case 4: return upTo(2) ? "(" + color(domain, depth - 1) + one({" == ", " != "}) + color(domain, depth - 1) + ")"
                                   : "(" + vector(domain, depth - 1) + one({" == ", " != "}) + vector(domain, depth - 1) + ")";
            case 5: return "(" + text(domain, depth - 1) + one({" == ", " != "}) + (upTo(3) ? textLiteral() : text(domain, depth - 1)) + ")";
            case 6: return std::string(one({"contains", "starts_with", "matches"})) + "(" + text(domain, depth - 1) + ", " + textLiteral() + ")";
            case 7: return upTo(2) ? "(" + number(domain, depth - 1) + " in (" + literal() + ", " + literal() + "))" : "(" + text(domain, 1) + " in (" + textLiteral() + ", " + textLiteral() + ", 'camera'))";
            case 8: return std::string(one({"nan", "inf", "finite"})) + "(" + (upTo(3) == 0 ? color(domain, depth - 1) : number(domain, depth - 1)) + ")";
            case 9: return "has(" + (upTo(2) ? numberName(domain) : upTo(2) ? textName(domain) : booleanName(domain)) + ")";
            case 10: case 11: return std::string(one({"any", "all", "none"})) + "(" + boolean(anyDomain(), depth - 1) + ")";
            default: return "(" + number(domain, depth - 1) + " " + one({"<", "<=", ">", ">=", "==", "!="}) + " " + number(domain, depth - 1) + ")";
        }
    }

    std::mt19937 random_;
};

}  // namespace emca::query::detail
