#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <re2/re2.h>

#include "emca/core/path_set.h"
#include "syntax.h"

namespace emca::query::detail {

/// One value, of any type.
struct Single {
    bool known = false;
    Type type = Type::missing;
    bool isFloat = false;            ///< recorded as float: literals beside it are rounded
    std::vector<double> numbers;     ///< booleans: 0 or 1; spectra: all entries
    std::string text;
};

/// The meaning of a query, as docs/queries.md tells it: element by element, by recursion, straight from the parsed text.
class BruteForce {
  public:
    explicit BruteForce(const PathSet& paths, long budget = 1L << 62) : paths_(paths), budget_(budget) {}

    /// Where an expression stands: a path and what was chosen inside it.
    struct Place {
        Domain domain = Domain::path;
        Index path = 0, vertex = 0, item = 0;
    };
    struct TooLong {};

    Single at(const Node& node, const Place& place) {
        if (--budget_ < 0) throw TooLong{};
        switch (node.kind) {
            case Kind::number: return number(node.number);
            case Kind::boolean: return truth(node.number != 0);
            case Kind::text: return text(node.text);
            case Kind::core: return core(node, place);
            case Kind::user: return user(node, place);
            case Kind::reduction: return reduction(node, place);
            case Kind::operation: return operation(node, place);
            case Kind::lightPath: break;
        }
        throw std::logic_error("no light paths here");
    }

    /// Nobody recorded anything that would say what type this has.
    bool isMissing(const Node& node) const {
        if (node.kind == Kind::user) return columns(node).empty();
        if (node.kind == Kind::reduction) return (node.op == Op::first || node.op == Op::last || node.op == Op::mean || node.op == Op::sum) && isMissing(node.children[0]);
        if (node.kind != Kind::operation) return false;
        switch (node.op) {
            case Op::negate: case Op::normalize: return isMissing(node.children[0]);
            case Op::add: case Op::subtract: case Op::multiply: case Op::divide: {
                const Node &a = node.children[0], &b = node.children[1];
                return (isMissing(a) && !isWide(b)) || (isMissing(b) && !isWide(a));
            }
            case Op::choose: return isMissing(node.children[1]) && isMissing(node.children[2]);
            default: return false;
        }
    }

    /// A colour or vector.
    bool isWide(const Node& node) const {
        if (node.kind == Kind::user) {
            const auto all = columns(node);
            return !all.empty() && (typeOfValue(all[0]->type) == Type::color || typeOfValue(all[0]->type) == Type::vector);
        }
        if (node.kind == Kind::core) {
            const Type type = findCore(node.scope, node.text)->type;
            return type == Type::color || type == Type::vector;
        }
        if (node.kind == Kind::reduction) return node.op != Op::count && isWide(node.children[0]);
        if (node.kind != Kind::operation) return false;
        switch (node.op) {
            case Op::makeColor: case Op::makeVector: case Op::cross: case Op::normalize: return true;
            case Op::add: case Op::subtract: case Op::multiply: case Op::divide: return isWide(node.children[0]) || isWide(node.children[1]);
            case Op::choose: return isWide(node.children[1]) || isWide(node.children[2]);
            case Op::negate: return isWide(node.children[0]);
            default: return false;
        }
    }

  private:
    static Single number(double x, bool isFloat = false) { return {true, Type::number, isFloat, {x}, {}}; }
    static Single truth(bool x) { return {true, Type::boolean, false, {x ? 1.0 : 0.0}, {}}; }
    static Single text(std::string_view x) { return {true, Type::text, false, {}, std::string(x)}; }
    static Single vector(Vec3f v) { return {true, Type::vector, true, {double(v.x), double(v.y), double(v.z)}, {}}; }
    static Single color(Color c) { return {true, Type::color, true, {double(c.r), double(c.g), double(c.b)}, {}}; }
    template <typename T, typename F>
    static Single ifThere(const std::optional<T>& value, F f) { return value ? f(*value) : Single{}; }

    // Quantities.

    Single core(const Node& node, const Place& at) const {
        const std::string& name = node.text;
        if (node.scope == Domain::path) return ofPath(name, at.path);
        if (node.scope == Domain::vertex) return ofVertex(name, at);
        if (name == "depth") return number(paths_.depthIndex(at.vertex));
        if (node.scope == Domain::nextEvent) {
            const NextEvent& n = paths_.nextEvent(at.item);
            return name == "visible" ? truth(n.visible != 0) : vector(n.position);
        }
        const Contribution& c = paths_.contribution(at.item);
        if (name == "value") return color(c.value);
        if (name == "luminance") return number(double(luminance(c.value)), true);
        if (name == "technique") return text(paths_.text(c.technique));
        if (name == "weight") return std::isnan(c.misWeight) ? Single{} : number(double(c.misWeight), true);
        return text(c.end == LightEnd::hit ? "hit" : c.end == LightEnd::connected ? "connected" : "automatic");
    }

    Single ofPath(const std::string& name, Index p) const {
        const auto isNumber = [](Index n) { return number(n); };
        Index contributions = 0;
        for (Index v = paths_.vertices(p).first; v < paths_.vertices(p).last; ++v) contributions += paths_.contributions(v).size();
        if (name == "pixel") return {true, Type::vector, false, {double(paths_.pixel(p).x), double(paths_.pixel(p).y)}, {}};
        if (name == "sample") return number(static_cast<double>(paths_.sample(p)));
        if (name == "part") return number(paths_.part(p));
        if (name == "origin") return ifThere(paths_.origin(p), vector);
        if (name == "estimate") return ifThere(paths_.estimate(p), color);
        if (name == "luminance") return ifThere(paths_.estimate(p), [](Color c) { return number(double(luminance(c)), true); });
        if (name == "depth") return number(paths_.depth(p));
        if (name == "vertices") return isNumber(paths_.vertices(p).size());
        if (name == "contributions") return isNumber(contributions);
        if (name == "splats") return isNumber(paths_.splats(p).size());
        throw std::logic_error(name);
    }

    Single ofVertex(const std::string& name, const Place& at) const {
        const Index v = at.vertex;
        const IndexRange all = paths_.vertices(at.path);
        const auto scattering = paths_.scattering(v);
        const auto surface = paths_.surface(v);
        if (name == "depth") return number(paths_.depthIndex(v));
        if (name == "index") return number(v - all.first);
        if (name == "position") return ifThere(paths_.position(v), vector);
        if (name == "segment") {
            if (v == all.first || paths_.subpath(v) != paths_.subpath(v - 1) || !paths_.position(v) || !paths_.position(v - 1)) return {};
            const Vec3f a = *paths_.position(v - 1), b = *paths_.position(v);
            const double x = double(b.x) - double(a.x), y = double(b.y) - double(a.y), z = double(b.z) - double(a.z);
            return number(std::sqrt(x * x + y * y + z * z));
        }
        if (name == "estimate") return ifThere(paths_.vertexEstimate(v), color);
        if (name == "luminance") return ifThere(paths_.vertexEstimate(v), [](Color c) { return number(double(luminance(c)), true); });
        if (name == "emission") return ifThere(paths_.emission(v), color);
        if (name == "mesh") return surface ? number(surface->mesh) : Single{};
        if (name == "face") return surface ? number(surface->face) : Single{};
        if (name == "event") return scattering ? text(emca::name(scattering->event)) : Single{};
        if (name == "lobe") return scattering ? text(emca::name(scattering->lobe)) : Single{};
        if (name == "label") return scattering && paths_.columns().labels[v] != kNoString ? text(scattering->label) : Single{};
        if (name == "environment") return truth(paths_.isEnvironment(v));
        if (name == "subpath") return text(emca::name(paths_.subpath(v)));
        if (name == "last") return truth(v + 1 == all.last);
        throw std::logic_error(name);
    }

    std::vector<const Column*> columns(const Node& node) const {
        std::vector<const Column*> found = paths_.find(node.scope == Domain::path ? Scope::path : Scope::vertex, node.text);
        std::erase_if(found, [](const Column* c) { return c->count == 0; });
        return found;
    }

    /// Of several columns the last one counts, of several values of one owner the last one.
    Single user(const Node& node, const Place& at) const {
        Single out;
        const auto all = columns(node);
        const bool isFloat = std::none_of(all.begin(), all.end(), [](const Column* c) { return c->type == ValueType::integer || c->type == ValueType::double1 || c->type == ValueType::double3; });
        for (const Column* column : all) {
            const auto value = paths_.last(*column, node.scope == Domain::path ? at.path : at.vertex);
            if (!value) continue;
            out = {true, typeOfValue(column->type), isFloat, {}, {}};
            if (const auto* t = std::get_if<std::string>(&*value)) out.text = *t;
            else if (const auto* s = std::get_if<std::vector<float>>(&*value)) out.numbers.assign(s->begin(), s->end());
            else for (int c = 0; c < componentCount(column->type); ++c) out.numbers.push_back(component(*value, static_cast<std::size_t>(c)));
        }
        return out;
    }

    static Type typeOfValue(ValueType type) {
        switch (type) {
            case ValueType::boolean: return Type::boolean;
            case ValueType::integer: case ValueType::float1: case ValueType::double1: return Type::number;
            case ValueType::color: case ValueType::colorA: return Type::color;
            case ValueType::text: return Type::text;
            case ValueType::spectrum: return Type::spectrum;
            default: return Type::vector;
        }
    }

    // Reductions.

    static Domain up(Domain d) { return d == Domain::contribution || d == Domain::nextEvent ? Domain::vertex : d == Domain::vertex ? Domain::path : Domain::pixel; }
    static bool contains(Domain outer, Domain inner) {
        for (Domain d = inner; ; d = up(d)) {
            if (d == outer) return true;
            if (d == Domain::pixel) return false;
        }
    }

    /// The innermost thing that is named outside of further reductions.
    static void innermost(const Node& node, Domain& domain) {
        if (node.kind == Kind::reduction) return;
        if ((node.kind == Kind::core || node.kind == Kind::user) && node.scope > domain) domain = node.scope;
        for (const Node& child : node.children) innermost(child, domain);
    }

    /// Everything of `wanted` that belongs to the `owner` that `at` is in.
    std::vector<Place> elements(Domain wanted, Domain owner, const Place& at) const {
        std::vector<Place> out;
        Index first = at.path, last = at.path + 1;
        if (owner == Domain::pixel) {
            while (first > 0 && paths_.pixel(first - 1) == paths_.pixel(at.path)) --first;
            while (last < paths_.pathCount() && paths_.pixel(last) == paths_.pixel(at.path)) ++last;
        }
        for (Index p = first; p < last; ++p) {
            if (wanted == Domain::path) { out.push_back({wanted, p, 0, 0}); continue; }
            const IndexRange vertices = paths_.vertices(p);
            for (Index v = vertices.first; v < vertices.last; ++v) {
                if (owner == Domain::vertex && v != at.vertex) continue;
                if (wanted == Domain::vertex) { out.push_back({wanted, p, v, 0}); continue; }
                const IndexRange items = wanted == Domain::contribution ? paths_.contributions(v) : paths_.nextEvents(v);
                for (Index i = items.first; i < items.last; ++i) out.push_back({wanted, p, v, i});
            }
        }
        return out;
    }

    Single reduction(const Node& node, const Place& at) {
        Domain argument = Domain::path;
        for (const Node& child : node.children) innermost(child, argument);
        Domain target = at.domain == argument ? up(argument) : at.domain;
        while (target == argument || !contains(target, argument)) target = up(target);
        std::vector<Single> values;
        const std::size_t conditionAt = node.op == Op::quantile ? 2 : 1;
        for (const Place& place : elements(argument, target, at)) {
            if (node.children.size() > conditionAt && truthOf(this->at(node.children[conditionAt], place)) != 1) continue;
            values.push_back(this->at(node.children[0], place));
        }
        return reduced(node, values);
    }

    /// 1 true, 0 false, -1 unknown.
    static int truthOf(const Single& s) { return !s.known ? -1 : s.numbers[0] != 0; }

    Single reduced(const Node& node, std::vector<Single>& values) {
        const auto how = [&](int t) { return std::count_if(values.begin(), values.end(), [=](const Single& s) { return truthOf(s) == t; }); };
        switch (node.op) {
            case Op::any: return how(1) ? truth(true) : how(-1) ? Single{} : truth(false);
            case Op::all: return how(0) ? truth(false) : how(-1) ? Single{} : truth(true);
            case Op::none: return how(1) ? truth(false) : how(-1) ? Single{} : truth(true);
            case Op::count: return number(static_cast<double>(how(1)));
            default: break;
        }
        std::erase_if(values, [](const Single& s) { return !s.known; });
        if (node.op == Op::sum && isMissing(node.children[0])) return {};
        if (node.op == Op::sum && values.empty()) return {true, Type::number, false, std::vector<double>(isWide(node.children[0]) ? 3 : 1, 0.0), {}};
        if (values.empty()) return {};
        if (node.op == Op::first) return values.front();
        if (node.op == Op::last) return values.back();
        if (node.op == Op::sum || node.op == Op::mean) return total(node, values);
        std::vector<double> x;
        for (const Single& s : values) x.push_back(s.numbers[0]);
        const bool hasNan = std::any_of(x.begin(), x.end(), [](double a) { return std::isnan(a); });
        const double nan = std::numeric_limits<double>::quiet_NaN();
        if (node.op == Op::least) return number(hasNan ? nan : *std::min_element(x.begin(), x.end()), values[0].isFloat);
        if (node.op == Op::greatest) return number(hasNan ? nan : *std::max_element(x.begin(), x.end()), values[0].isFloat);
        if (node.op == Op::variance) return x.size() < 2 ? Single{} : number(variance(x));
        if (hasNan) return number(nan);
        std::sort(x.begin(), x.end());
        const double place = node.children[1].number * static_cast<double>(x.size() - 1), below = std::floor(place);
        const double a = x[static_cast<std::size_t>(below)];
        return number(place == below ? a : a + (place - below) * (x[static_cast<std::size_t>(below) + 1] - a));
    }

    static Single total(const Node& node, const std::vector<Single>& values) {
        Single out = values[0];
        out.isFloat = false;
        std::fill(out.numbers.begin(), out.numbers.end(), 0.0);
        for (const Single& s : values)
            for (std::size_t c = 0; c < out.numbers.size(); ++c) out.numbers[c] += s.numbers[c];
        if (node.op == Op::mean) for (double& x : out.numbers) x /= static_cast<double>(values.size());
        return out;
    }

    static double variance(const std::vector<double>& x) {
        double mean = 0, squares = 0;
        for (const double a : x) mean += a;
        mean /= static_cast<double>(x.size());
        for (const double a : x) squares += (a - mean) * (a - mean);
        return squares / static_cast<double>(x.size() - 1);
    }

    // Operations.

    Single operation(const Node& node, const Place& place) {
        std::vector<Single> x;
        for (const Node& child : node.children) x.push_back(at(child, place));
        switch (node.op) {
            case Op::both: return truthOf(x[0]) == 0 || truthOf(x[1]) == 0 ? truth(false) : x[0].known && x[1].known ? truth(true) : Single{};
            case Op::either: return truthOf(x[0]) == 1 || truthOf(x[1]) == 1 ? truth(true) : x[0].known && x[1].known ? truth(false) : Single{};
            case Op::has: return truth(x[0].known);
            case Op::choose: {
                Single chosen = !x[0].known ? Single{} : x[0].numbers[0] != 0 ? x[1] : x[2];
                chosen.isFloat = false;
                return chosen;
            }
            case Op::in: return membership(node, x);
            case Op::less: case Op::lessEqual: case Op::greater: case Op::greaterEqual: case Op::equal: case Op::notEqual: return compared(node, x[0], x[1]);
            default: break;
        }
        if (std::any_of(x.begin(), x.end(), [](const Single& s) { return !s.known; })) return {};
        return computed(node, x);
    }

    Single membership(const Node& node, const std::vector<Single>& x) {
        bool unknown = false;
        for (std::size_t i = 1; i < x.size(); ++i) {
            Node pair = node;
            pair.op = Op::equal;
            pair.children = {node.children[0], node.children[i]};
            const int one = truthOf(compared(pair, x[0], x[i]));
            if (one == 1) return truth(true);
            unknown |= one == -1;
        }
        return unknown ? Single{} : truth(false);
    }

    static double roundedLiteral(const Node& node, double x, bool beside) {
        const bool literal = node.kind == Kind::number || (node.kind == Kind::operation && node.op == Op::negate && node.children[0].kind == Kind::number);
        const float rounded = static_cast<float>(x);
        return literal && beside && std::isfinite(rounded) && rounded != 0 ? double(rounded) : x;
    }

    static Single compared(const Node& node, Single a, Single b) {
        if (!a.known || !b.known) return {};
        if (a.type == Type::number) {
            const bool aFloat = a.isFloat, bFloat = b.isFloat;
            a.numbers[0] = roundedLiteral(node.children[0], a.numbers[0], bFloat);
            b.numbers[0] = roundedLiteral(node.children[1], b.numbers[0], aFloat);
        }
        bool equal = a.text == b.text;
        for (std::size_t c = 0; c < a.numbers.size(); ++c) equal = equal && a.numbers[c] == b.numbers[c];
        switch (node.op) {
            case Op::equal: return truth(equal);
            case Op::notEqual: return truth(!equal);
            case Op::less: return truth(a.numbers[0] < b.numbers[0]);
            case Op::lessEqual: return truth(a.numbers[0] <= b.numbers[0]);
            case Op::greater: return truth(a.numbers[0] > b.numbers[0]);
            default: return truth(a.numbers[0] >= b.numbers[0]);
        }
    }

    template <typename F>
    static Single each(const Single& a, const Single& b, F f) {
        const Single& wide = a.numbers.size() >= b.numbers.size() ? a : b;
        Single out{true, wide.type, false, {}, {}};
        for (std::size_t c = 0; c < wide.numbers.size(); ++c) out.numbers.push_back(f(a.numbers[a.numbers.size() == 1 ? 0 : c], b.numbers[b.numbers.size() == 1 ? 0 : c]));
        return out;
    }

    Single computed(const Node& node, const std::vector<Single>& x) const {
        const Single& a = x[0];
        const Single& b = x.back();
        const auto of = [&](double (*f)(double)) { return number(f(a.numbers[0])); };
        const auto some = [&](auto f) { return truth(std::any_of(a.numbers.begin(), a.numbers.end(), f)); };
        switch (node.op) {
            case Op::invert: return truth(a.numbers[0] == 0);
            case Op::negate: return each(a, a, [](double p, double) { return -p; });
            case Op::add: return each(a, b, [](double p, double q) { return p + q; });
            case Op::subtract: return each(a, b, [](double p, double q) { return p - q; });
            case Op::multiply: return each(a, b, [](double p, double q) { return p * q; });
            case Op::divide: return each(a, b, [](double p, double q) { return p / q; });
            case Op::modulo: return number(std::fmod(a.numbers[0], b.numbers[0]));
            case Op::power: return number(std::pow(a.numbers[0], b.numbers[0]));
            case Op::atan2: return number(std::atan2(a.numbers[0], b.numbers[0]));
            case Op::abs: return of(std::fabs); case Op::sqrt: return of(std::sqrt); case Op::exp: return of(std::exp);
            case Op::log: return of(std::log); case Op::log2: return of(std::log2); case Op::log10: return of(std::log10);
            case Op::floor: return of(std::floor); case Op::ceil: return of(std::ceil); case Op::round: return of(std::round);
            case Op::sin: return of(std::sin); case Op::cos: return of(std::cos); case Op::tan: return of(std::tan);
            case Op::asin: return of(std::asin); case Op::acos: return of(std::acos); case Op::atan: return of(std::atan);
            case Op::minimum: case Op::maximum: return extreme(x, node.op == Op::minimum);
            case Op::clamp: return extreme({extreme({x[0], x[1]}, false), x[2]}, true);
            case Op::luminance: return number(0.2126 * a.numbers[0] + 0.7152 * a.numbers[1] + 0.0722 * a.numbers[2]);
            case Op::length: return number(std::sqrt(inner(a, a)));
            case Op::distance: { const Single d = each(a, b, [](double p, double q) { return p - q; }); return number(std::sqrt(inner(d, d))); }
            case Op::dot: return number(inner(a, b));
            case Op::cross: return cross(a.numbers, b.numbers);
            case Op::normalize: { const double l = std::sqrt(inner(a, a)); return each(a, a, [l](double p, double) { return p / l; }); }
            case Op::makeVector: case Op::makeColor: {
                Single out{true, node.op == Op::makeColor ? Type::color : Type::vector, false, {}, {}};
                for (const Single& s : x) out.numbers.push_back(s.numbers[0]);
                return out;
            }
            case Op::isNan: return some([](double p) { return std::isnan(p); });
            case Op::isInf: return some([](double p) { return std::isinf(p); });
            case Op::isFinite: return truth(std::all_of(a.numbers.begin(), a.numbers.end(), [](double p) { return std::isfinite(p); }));
            case Op::contains: return truth(a.text.find(b.text) != std::string::npos);
            case Op::startsWith: return truth(a.text.rfind(b.text, 0) == 0);
            case Op::matches: return truth(RE2::PartialMatch(a.text, b.text));
            case Op::member: case Op::subscript: {
                const auto place = static_cast<std::size_t>(node.number);
                return place < a.numbers.size() ? number(a.numbers[place], a.isFloat) : Single{};
            }
            default: throw std::logic_error("no such operation");
        }
    }

    static double inner(const Single& a, const Single& b) {
        double sum = 0;
        for (std::size_t c = 0; c < a.numbers.size(); ++c) sum += a.numbers[c] * b.numbers[c];
        return sum;
    }
    static Single cross(const std::vector<double>& a, const std::vector<double>& b) {
        return {true, Type::vector, false, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}, {}};
    }
    static Single extreme(const std::vector<Single>& x, bool smallest) {
        double best = x[0].numbers[0];
        for (const Single& s : x) {
            if (std::isnan(s.numbers[0])) return number(s.numbers[0]);
            best = smallest ? std::min(best, s.numbers[0]) : std::max(best, s.numbers[0]);
        }
        return number(best);
    }

    const PathSet& paths_;
    long budget_;
};

}  // namespace emca::query::detail
