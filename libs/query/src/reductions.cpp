// From many values to one: quantifiers, counts, sums.
#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluator.h"

namespace emca::query::detail {

namespace {

Values empty(const Node& node, std::size_t size) {
    Values out;
    out.type = node.type;
    out.components = node.components;
    out.size = size;
    if (node.type == Type::boolean) {
        out.truth = Buffer<std::uint8_t>(size, std::uint8_t{kUnknown});
        return out;
    }
    out.known = Buffer<std::uint8_t>(size, std::uint8_t{0});
    if (node.type == Type::text || node.type == Type::spectrum) out.texts = Buffer<std::uint32_t>(size, 0u);
    else if (node.type != Type::missing)
        for (int c = 0; c < node.components; ++c) out.numbers[static_cast<std::size_t>(c)] = Buffer<double>(size, 0.0);
    return out;
}

std::uint8_t truthAt(const Values& v, std::size_t i) {
    return v.type == Type::missing ? std::uint8_t{kUnknown} : v.truth[v.constant ? 0 : i];
}

Values quantified(const Node& node, const Values& value, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        bool someTrue = false, someFalse = false, someUnknown = false;
        for (Index i = firsts[t]; i < firsts[t + 1]; ++i) {
            const std::uint8_t truth = truthAt(value, i);
            someTrue |= truth == kTrue;
            someFalse |= truth == kFalse;
            someUnknown |= truth == kUnknown;
        }
        // all and none are decided by a single counterexample, any by a single example.
        const bool decisive = node.op == Op::all ? someFalse : someTrue;
        const bool ifDecided = node.op == Op::any;
        out.truth[t] = decisive ? (ifDecided ? kTrue : kFalse) : someUnknown ? kUnknown : (ifDecided ? kFalse : kTrue);
    }
    return out;
}

Values counted(const Node& node, const Values& value, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        Index count = 0;
        for (Index i = firsts[t]; i < firsts[t + 1]; ++i) count += truthAt(value, i) == kTrue;
        out.numbers[0][t] = count;
        out.known[t] = 1;
    }
    return out;
}

bool taken(const Values& value, const Values* condition, std::size_t i) {
    return value.isKnown(i) && (!condition || truthAt(*condition, i) == kTrue);
}

/// First or last: copies one element.
Values picked(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    out.spectra = value.spectra;
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        for (Index n = 0; n < firsts[t + 1] - firsts[t]; ++n) {
            const std::size_t i = node.op == Op::first ? firsts[t] + n : firsts[t + 1] - 1 - n;
            if (!taken(value, condition, i)) continue;
            const std::size_t from = value.constant ? 0 : i;
            if (value.type == Type::boolean) {
                out.truth[t] = value.truth[from];
                break;
            }
            out.known[t] = 1;
            if (!value.texts.empty()) out.texts[t] = value.texts[from];
            else
                for (std::size_t c = 0; c < static_cast<std::size_t>(value.components); ++c) out.numbers[c][t] = value.numbers[c][from];
            break;
        }
    }
    return out;
}

double quantile(std::vector<double>& sorted, double fraction) {
    if (std::any_of(sorted.begin(), sorted.end(), [](double x) { return std::isnan(x); })) return std::numeric_limits<double>::quiet_NaN();
    std::sort(sorted.begin(), sorted.end());
    const double place = fraction * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto above = std::min(below + 1, sorted.size() - 1);
    const double part = place - static_cast<double>(below);
    return part == 0 ? sorted[below] : sorted[below] + part * (sorted[above] - sorted[below]);
}

/// Sample variance by two passes.
double variance(const std::vector<double>& values) {
    double mean = 0, sum = 0;
    for (const double x : values) mean += x;
    mean /= static_cast<double>(values.size());
    for (const double x : values) sum += (x - mean) * (x - mean);
    return sum / static_cast<double>(values.size() - 1);
}

/// What needs all values of an element at once.
Values gathered(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    std::vector<double> numbers;
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        numbers.clear();
        for (Index i = firsts[t]; i < firsts[t + 1]; ++i)
            if (taken(value, condition, i)) numbers.push_back(value.numbers[0][value.constant ? 0 : i]);
        out.known[t] = numbers.size() >= (node.op == Op::variance ? 2u : 1u);
        if (out.known[t]) out.numbers[0][t] = node.op == Op::variance ? variance(numbers) : quantile(numbers, node.children[1].number);
    }
    return out;
}

Values summed(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        Index count = 0;
        for (Index i = firsts[t]; i < firsts[t + 1]; ++i) {
            if (!taken(value, condition, i)) continue;
            ++count;
            for (std::size_t c = 0; c < static_cast<std::size_t>(value.components); ++c) out.numbers[c][t] += value.numbers[c][value.constant ? 0 : i];
        }
        out.known[t] = node.op == Op::sum || count > 0;
        for (std::size_t c = 0; node.op == Op::mean && count > 0 && c < static_cast<std::size_t>(value.components); ++c) out.numbers[c][t] /= count;
    }
    return out;
}

Values extreme(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts) {
    Values out = empty(node, firsts.size() - 1);
    for (std::size_t t = 0; t + 1 < firsts.size(); ++t) {
        for (Index i = firsts[t]; i < firsts[t + 1]; ++i) {
            if (!taken(value, condition, i)) continue;
            const double x = value.numbers[0][value.constant ? 0 : i], best = out.numbers[0][t];
            const bool better = node.op == Op::least ? x < best : x > best;
            if (!out.known[t] || (!std::isnan(best) && (std::isnan(x) || better))) out.numbers[0][t] = x;
            out.known[t] = 1;
        }
    }
    return out;
}

}  // namespace

Values reduce(const Node& node, const Values& value, const Values* condition, const std::vector<Index>& firsts) {
    switch (node.op) {
        case Op::any: case Op::all: case Op::none: return quantified(node, value, firsts);
        case Op::count: return counted(node, value, firsts);
        default: break;
    }
    if (value.type == Type::missing) {
        Values out = empty(node, firsts.size() - 1);
        if (node.op == Op::sum && node.type == Type::number) std::fill_n(out.known.data(), out.known.size(), std::uint8_t{1});
        return out;
    }
    switch (node.op) {
        case Op::first: case Op::last: return picked(node, value, condition, firsts);
        case Op::sum: case Op::mean: return summed(node, value, condition, firsts);
        case Op::least: case Op::greatest: return extreme(node, value, condition, firsts);
        default: return gathered(node, value, condition, firsts);
    }
}

}  // namespace emca::query::detail
