// Operations on values that belong together, element by element.
#include <algorithm>
#include <cmath>
#include <functional>

#include "evaluator.h"

namespace emca::query::detail {

namespace {

/// Applies f to arrays of which each may be one value for all. Separate loops, so that compilers vectorise them.
template <typename Out, typename In, typename F>
void apply(Out* out, std::size_t size, const In* a, bool aConstant, const In* b, bool bConstant, F f) {
    if (aConstant && bConstant) std::fill_n(out, size, f(a[0], b[0]));
    else if (aConstant) { const In x = a[0]; for (std::size_t i = 0; i < size; ++i) out[i] = f(x, b[i]); }
    else if (bConstant) { const In y = b[0]; for (std::size_t i = 0; i < size; ++i) out[i] = f(a[i], y); }
    else for (std::size_t i = 0; i < size; ++i) out[i] = f(a[i], b[i]);
}

constexpr auto both = [](std::uint8_t a, std::uint8_t b) -> std::uint8_t {
    return a == kFalse || b == kFalse ? kFalse : a == kTrue && b == kTrue ? kTrue : kUnknown;
};
constexpr auto either = [](std::uint8_t a, std::uint8_t b) -> std::uint8_t {
    return a == kTrue || b == kTrue ? kTrue : a == kFalse && b == kFalse ? kFalse : kUnknown;
};

/// Known where all operands are.
template <typename Operands>
Buffer<std::uint8_t> allKnown(const Operands& operands, std::size_t size) {
    Buffer<std::uint8_t> known;
    for (const Values& v : operands) {
        if (v.type == Type::missing || (v.constant && !v.isKnown(0))) return Buffer<std::uint8_t>(size, std::uint8_t{0});
        if (v.type == Type::boolean || v.known.empty() || v.constant) continue;
        if (known.empty()) known = v.known;
        else for (std::size_t i = 0; i < size; ++i) known[i] &= v.known[i];
    }
    return known;
}

Values result(const Node& node, std::size_t size) {
    Values out;
    out.type = node.type;
    out.components = node.components;
    out.size = size;
    if (node.type == Type::boolean) out.truth = Buffer<std::uint8_t>(size);
    else if (node.type != Type::missing)
        for (int c = 0; c < node.components; ++c) out.numbers[static_cast<std::size_t>(c)] = Buffer<double>(size);
    return out;
}

/// Where an operand is unknown, so is a condition.
void hideUnknown(Values& out, const Buffer<std::uint8_t>& known) {
    std::uint8_t* const truth = out.truth.data();
    const std::uint8_t* const from = known.data();
    for (std::size_t i = 0; i < known.size(); ++i) truth[i] = from[i] ? truth[i] : std::uint8_t{kUnknown};
}

/// Component c of an operand; numbers stand for all components.
const double* componentOf(const Values& v, int c) { return v.numbers[static_cast<std::size_t>(v.components == 1 ? 0 : c)].data(); }

template <typename F>
Values numbers1(const Node& node, std::vector<Values>& values, std::size_t size, F f) {
    Values out = result(node, size);
    for (int c = 0; c < node.components; ++c) {
        const double* a = componentOf(values[0], c);
        double* to = out.numbers[static_cast<std::size_t>(c)].data();
        const bool constant = values[0].constant;
        for (std::size_t i = 0; i < size; ++i) to[i] = f(a[constant ? 0 : i]);
    }
    out.known = allKnown(values, size);
    return out;
}

template <typename F>
Values numbers2(const Node& node, std::vector<Values>& values, std::size_t size, F f) {
    Values out = result(node, size);
    for (int c = 0; c < node.components; ++c) {
        apply(out.numbers[static_cast<std::size_t>(c)].data(), size, componentOf(values[0], c), values[0].constant,
              componentOf(values[1], c), values[1].constant, f);
    }
    out.known = allKnown(values, size);
    return out;
}

template <typename F>
Values comparison(const Node& node, std::vector<Values>& values, std::size_t size, F f) {
    Values out = result(node, size);
    apply(out.truth.data(), size, values[0].numbers[0].data(), values[0].constant, values[1].numbers[0].data(), values[1].constant,
          [f](double a, double b) { return static_cast<std::uint8_t>(f(a, b) ? kTrue : kFalse); });
    hideUnknown(out, allKnown(values, size));
    return out;
}

template <typename F>
Values logic(const Node& node, std::vector<Values>& values, std::size_t size, F f) {
    Values out = result(node, size);
    apply(out.truth.data(), size, values[0].truth.data(), values[0].constant, values[1].truth.data(), values[1].constant, f);
    return out;
}

/// Folds components of every element: `f(total, a, b)`, b being the second operand if there is one.
template <typename F, typename Finish>
Values folded(const Node& node, std::vector<Values>& values, std::size_t size, F f, Finish finish) {
    Values out = result(node, size);
    const Values &a = values[0], &b = values.back();
    double* to = out.numbers[0].data();
    std::fill_n(to, size, 0.0);
    for (int c = 0; c < a.components; ++c) {
        const double *x = componentOf(a, c), *y = componentOf(b, c);
        for (std::size_t i = 0; i < size; ++i) to[i] = f(to[i], x[a.constant ? 0 : i], y[b.constant ? 0 : i], c);
    }
    for (std::size_t i = 0; i < size; ++i) to[i] = finish(to[i]);
    out.known = allKnown(values, size);
    return out;
}

/// Any, or all, of the components fulfil `f`.
template <typename F>
Values tested(const Node& node, std::vector<Values>& values, std::size_t size, bool all, F f) {
    Values out = result(node, size);
    const Values& a = values[0];
    for (std::size_t i = 0; i < size; ++i) {
        bool truth = all;
        for (int c = 0; c < a.components; ++c) {
            const bool one = f(componentOf(a, c)[a.constant ? 0 : i]);
            truth = all ? truth && one : truth || one;
        }
        out.truth[i] = truth ? kTrue : kFalse;
    }
    hideUnknown(out, allKnown(values, size));
    return out;
}

/// `a == b`, or `a != b`.
Values equality(const Values& a, const Values& b, bool equal, std::size_t size) {
    Values out;
    out.type = Type::boolean;
    out.size = size;
    out.truth = Buffer<std::uint8_t>(size);
    const std::uint8_t same = equal ? kTrue : kFalse, other = equal ? kFalse : kTrue;
    if (a.type == Type::boolean && b.type == Type::boolean) {
        apply(out.truth.data(), size, a.truth.data(), a.constant, b.truth.data(), b.constant,
              [=](std::uint8_t x, std::uint8_t y) { return x == kUnknown || y == kUnknown ? std::uint8_t{kUnknown} : x == y ? same : other; });
        return out;
    }
    if (a.type == Type::text && b.type == Type::text) {
        apply(out.truth.data(), size, a.texts.data(), a.constant, b.texts.data(), b.constant,
              [=](std::uint32_t x, std::uint32_t y) { return x == y ? same : other; });
    } else if (a.type == Type::missing || b.type == Type::missing) {
        std::fill_n(out.truth.data(), size, std::uint8_t{kUnknown});
        return out;
    } else {
        std::fill_n(out.truth.data(), size, same);
        for (int c = 0; c < a.components; ++c) {
            const double *x = componentOf(a, c), *y = componentOf(b, c);
            for (std::size_t i = 0; i < size; ++i)
                if (x[a.constant ? 0 : i] != y[b.constant ? 0 : i]) out.truth[i] = other;
        }
    }
    hideUnknown(out, allKnown(std::initializer_list<std::reference_wrapper<const Values>>{a, b}, size));
    return out;
}

/// x in (a, b): x == a or x == b.
Values membership(const std::vector<Values>& values, std::size_t size) {
    Values out = equality(values[0], values[1], true, size);
    for (std::size_t k = 2; k < values.size(); ++k) {
        const Values one = equality(values[0], values[k], true, size);
        for (std::size_t i = 0; i < size; ++i) out.truth[i] = either(out.truth[i], one.truth[i]);
    }
    return out;
}

Values choice(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    if (node.type == Type::text) out.texts = Buffer<std::uint32_t>(size);
    const bool hasNumbers = node.type == Type::number || node.type == Type::color || node.type == Type::vector;
    if (node.type != Type::boolean) out.known = Buffer<std::uint8_t>(size);
    for (std::size_t i = 0; i < size; ++i) {
        const std::uint8_t truth = values[0].type == Type::missing ? std::uint8_t{kUnknown} : values[0].truth[values[0].constant ? 0 : i];
        const Values& taken = values[truth == kFalse ? 2 : 1];
        const bool known = truth != kUnknown && taken.isKnown(i);
        const std::size_t from = taken.constant ? 0 : i;
        if (node.type == Type::boolean) {
            out.truth[i] = known ? taken.truth[from] : std::uint8_t{kUnknown};
            continue;
        }
        out.known[i] = known;
        if (node.type == Type::text) out.texts[i] = known ? taken.texts[from] : kNoString;
        for (int c = 0; hasNumbers && c < node.components; ++c)
            out.numbers[static_cast<std::size_t>(c)][i] = known ? componentOf(taken, c)[from] : 0.0;
    }
    return out;
}

Values has(const Node& node, const Values& a, std::size_t size) {
    Values out = result(node, size);
    for (std::size_t i = 0; i < size; ++i) out.truth[i] = a.isKnown(i) ? kTrue : kFalse;
    return out;
}

Values constructed(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    for (int c = 0; c < node.components; ++c) {
        const Values& part = values[static_cast<std::size_t>(c)];
        for (std::size_t i = 0; i < size; ++i) out.numbers[static_cast<std::size_t>(c)][i] = part.numbers[0][part.constant ? 0 : i];
    }
    out.known = allKnown(values, size);
    return out;
}

Values crossed(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    const Values &a = values[0], &b = values[1];
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t k = a.constant ? 0 : i, l = b.constant ? 0 : i;
            out.numbers[c][i] = a.numbers[d][k] * b.numbers[e][l] - a.numbers[e][k] * b.numbers[d][l];
        }
    }
    out.known = allKnown(values, size);
    return out;
}

Values normalized(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    const Values& a = values[0];
    for (std::size_t i = 0; i < size; ++i) {
        double square = 0;
        for (int c = 0; c < a.components; ++c) square += componentOf(a, c)[a.constant ? 0 : i] * componentOf(a, c)[a.constant ? 0 : i];
        for (int c = 0; c < a.components; ++c) out.numbers[static_cast<std::size_t>(c)][i] = componentOf(a, c)[a.constant ? 0 : i] / std::sqrt(square);
    }
    out.known = allKnown(values, size);
    return out;
}

/// The first three of clamp(value, lowest, highest), min(a, b, …), max(a, b, …).
Values extreme(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    double* to = out.numbers[0].data();
    for (std::size_t i = 0; i < size; ++i) to[i] = values[0].numbers[0][values[0].constant ? 0 : i];
    for (std::size_t k = 1; k < values.size(); ++k) {
        const Values& v = values[k];
        const bool smaller = node.op == Op::minimum || (node.op == Op::clamp && k == 2);
        for (std::size_t i = 0; i < size; ++i) {
            const double x = v.numbers[0][v.constant ? 0 : i];
            // NaN is passed on, whichever operand it is.
            if (!(to[i] != to[i]) && (x != x || (smaller ? x < to[i] : x > to[i]))) to[i] = x;
        }
    }
    out.known = allKnown(values, size);
    return out;
}

Values component(const Node& node, std::vector<Values>& values, std::size_t size) {
    Values out = result(node, size);
    const Values& a = values[0];
    const auto place = static_cast<std::size_t>(node.number);
    out.known = Buffer<std::uint8_t>(size);
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t from = a.constant ? 0 : i;
        out.known[i] = a.isKnown(i);
        out.numbers[0][i] = 0;
        if (!out.known[i]) continue;
        if (a.type != Type::spectrum) {
            out.numbers[0][i] = a.numbers[place][from];
            continue;
        }
        const std::uint32_t first = a.spectra->spectrumOffsets[a.texts[from]], last = a.spectra->spectrumOffsets[a.texts[from] + 1];
        out.known[i] = place < last - first;
        if (out.known[i]) out.numbers[0][i] = static_cast<double>(a.spectra->values<float>()[first + place]);
    }
    return out;
}

Values unknownResult(const Node& node, std::size_t size) {
    Values out = result(node, size);
    if (node.type == Type::boolean) {
        std::fill_n(out.truth.data(), size, std::uint8_t{kUnknown});
        return out;
    }
    for (auto& numbers : out.numbers) std::fill_n(numbers.data(), numbers.size(), 0.0);
    if (node.type == Type::text) out.texts = Buffer<std::uint32_t>(size, kNoString);
    out.known = Buffer<std::uint8_t>(size, std::uint8_t{0});
    return out;
}

/// A condition that nobody recorded is unknown.
void makeConditions(std::vector<Values>& values) {
    for (Values& v : values) {
        if (v.type != Type::missing) continue;
        v.type = Type::boolean;
        v.constant = true;
        v.truth = Buffer<std::uint8_t>(1, std::uint8_t{kUnknown});
    }
}

double square(double total, double a, double, int) { return total + a * a; }

}  // namespace

Values combine(const Node& node, std::vector<Values>& values, std::size_t size) {
    const bool ofConditions = node.op == Op::both || node.op == Op::either || node.op == Op::invert;
    if (ofConditions) makeConditions(values);
    const bool anyMissing = std::any_of(values.begin(), values.end(), [](const Values& v) { return v.type == Type::missing; });
    if (anyMissing && node.op != Op::has && node.op != Op::choose && node.op != Op::in) return unknownResult(node, size);
    const auto one = [&](double (*f)(double)) { return numbers1(node, values, size, f); };
    switch (node.op) {
        case Op::both:
            return logic(node, values, size, both);
        case Op::either:
            return logic(node, values, size, either);
        case Op::invert: {
            Values out = result(node, size);
            for (std::size_t i = 0; i < size; ++i) {
                const std::uint8_t a = values[0].truth[values[0].constant ? 0 : i];
                out.truth[i] = a == kUnknown ? kUnknown : a == kTrue ? kFalse : kTrue;
            }
            return out;
        }
        case Op::less: return comparison(node, values, size, [](double a, double b) { return a < b; });
        case Op::lessEqual: return comparison(node, values, size, [](double a, double b) { return a <= b; });
        case Op::greater: return comparison(node, values, size, [](double a, double b) { return a > b; });
        case Op::greaterEqual: return comparison(node, values, size, [](double a, double b) { return a >= b; });
        case Op::equal: case Op::notEqual: return equality(values[0], values[1], node.op == Op::equal, size);
        case Op::in: return membership(values, size);
        case Op::negate: return numbers1(node, values, size, [](double a) { return -a; });
        case Op::add: return numbers2(node, values, size, [](double a, double b) { return a + b; });
        case Op::subtract: return numbers2(node, values, size, [](double a, double b) { return a - b; });
        case Op::multiply: return numbers2(node, values, size, [](double a, double b) { return a * b; });
        case Op::divide: return numbers2(node, values, size, [](double a, double b) { return a / b; });
        case Op::modulo: return numbers2(node, values, size, [](double a, double b) { return std::fmod(a, b); });
        case Op::power: return numbers2(node, values, size, [](double a, double b) { return std::pow(a, b); });
        case Op::atan2: return numbers2(node, values, size, [](double a, double b) { return std::atan2(a, b); });
        case Op::abs: return one(std::fabs);
        case Op::sqrt: return one(std::sqrt);
        case Op::exp: return one(std::exp);
        case Op::log: return one(std::log);
        case Op::log2: return one(std::log2);
        case Op::log10: return one(std::log10);
        case Op::floor: return one(std::floor);
        case Op::ceil: return one(std::ceil);
        case Op::round: return one(std::round);
        case Op::sin: return one(std::sin);
        case Op::cos: return one(std::cos);
        case Op::tan: return one(std::tan);
        case Op::asin: return one(std::asin);
        case Op::acos: return one(std::acos);
        case Op::atan: return one(std::atan);
        case Op::minimum: case Op::maximum: case Op::clamp: return extreme(node, values, size);
        case Op::luminance:
            return folded(node, values, size, [](double total, double a, double, int c) { return total + (c == 0 ? 0.2126 : c == 1 ? 0.7152 : c == 2 ? 0.0722 : 0.0) * a; },
                          [](double total) { return total; });
        case Op::length: return folded(node, values, size, square, [](double total) { return std::sqrt(total); });
        case Op::distance:
            return folded(node, values, size, [](double total, double a, double b, int) { return total + (a - b) * (a - b); }, [](double total) { return std::sqrt(total); });
        case Op::dot: return folded(node, values, size, [](double total, double a, double b, int) { return total + a * b; }, [](double total) { return total; });
        case Op::cross: return crossed(node, values, size);
        case Op::normalize: return normalized(node, values, size);
        case Op::makeVector: case Op::makeColor: return constructed(node, values, size);
        case Op::isNan: return tested(node, values, size, false, [](double a) { return std::isnan(a); });
        case Op::isInf: return tested(node, values, size, false, [](double a) { return std::isinf(a); });
        case Op::isFinite: return tested(node, values, size, true, [](double a) { return std::isfinite(a); });
        case Op::has: return has(node, values[0], size);
        case Op::choose: return choice(node, values, size);
        case Op::member: case Op::subscript: return component(node, values, size);
        default: return unknownResult(node, size);
    }
}

}  // namespace emca::query::detail
