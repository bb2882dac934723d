#include "evaluator.h"

#include <algorithm>
#include <set>

#include "patterns.h"

namespace emca::query::detail {

namespace {

/// One value for all elements becomes one each; values of a wider domain go to all that belong to them.
Values spread(Values values, const std::vector<Index>& owners) {
    Values out;
    out.type = values.type;
    out.components = values.components;
    out.size = owners.size();
    out.spectra = values.spectra;
    const auto gather = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to = std::decay_t<decltype(from)>(owners.size());
        for (std::size_t i = 0; i < owners.size(); ++i) to[i] = from[owners[i]];
    };
    for (std::size_t c = 0; c < 4; ++c) gather(values.numbers[c], out.numbers[c]);
    gather(values.known, out.known);
    gather(values.truth, out.truth);
    gather(values.texts, out.texts);
    return out;
}

void collectMissing(const Node& node, const PathSet& paths, std::set<std::string>& missing) {
    if (node.kind == Kind::user && columnsOfType(paths, node).empty()) missing.insert(node.text);
    for (const Node& child : node.children) collectMissing(child, paths, missing);
}

/// Sets `truth` to true for the owners of values of a column.
void markRecorded(const Column& column, IndexRange owners, std::uint8_t* truth) {
    if (column.dense()) {
        if (owners.first < column.count) std::fill_n(truth, std::min(owners.last, column.count) - owners.first, std::uint8_t{kTrue});
        return;
    }
    const auto begin = std::lower_bound(column.owners.begin(), column.owners.end(), owners.first);
    for (auto owner = begin; owner != column.owners.end() && *owner < owners.last; ++owner) truth[*owner - owners.first] = kTrue;
}

}  // namespace

Evaluator::Evaluator(const PathSet& paths, const Node& root) : paths_(paths), root_(root) {}
Evaluator::~Evaluator() = default;

Texts& Evaluator::allTexts() {
    if (!texts_) texts_ = std::make_unique<Texts>(paths_);
    return *texts_;
}

const Texts& Evaluator::texts() { return allTexts(); }

std::vector<std::string> Evaluator::missing() const {
    std::set<std::string> names;
    collectMissing(root_, paths_, names);
    return {names.begin(), names.end()};
}

Values Evaluator::literalText(const std::string& text) {
    Values values;
    values.type = Type::text;
    values.components = 0;
    values.size = 1;
    values.constant = true;
    values.texts = Buffer<std::uint32_t>(1, allTexts().add(text));
    return values;
}

Values Evaluator::evaluate(const Node& node, Chunk& chunk) {
    switch (node.kind) {
        case Kind::number: case Kind::boolean: {
            Values values;
            values.type = node.type;
            values.size = 1;
            values.constant = true;
            if (node.kind == Kind::number) values.numbers[0] = Buffer<double>(1, node.number);
            else values.truth = Buffer<std::uint8_t>(1, static_cast<std::uint8_t>(node.number));
            return values;
        }
        case Kind::text: return literalText(node.text);
        case Kind::core: return core(node, chunk);
        case Kind::user: return user(node, chunk);
        case Kind::lightPath: return lightPath(node, chunk);
        case Kind::reduction: return reduction(node, chunk);
        case Kind::operation: break;
    }
    return operation(node, chunk);
}

Values Evaluator::evaluateOn(const Node& node, Domain domain, Chunk& chunk) {
    Values values = evaluate(node, chunk);
    if (values.constant || node.domain == domain) return values;
    return spread(std::move(values), chunk.ownersOf(domain, node.domain));
}

Values Evaluator::lightPath(const Node& node, Chunk& chunk) {
    std::unique_ptr<LightPathMatcher>& matcher = matchers_[&node];
    if (!matcher) matcher = std::make_unique<LightPathMatcher>(*node.lightPath, paths_);
    const IndexRange range = chunk.range(Domain::path);
    Values values;
    values.type = Type::boolean;
    values.size = range.size();
    values.truth = Buffer<std::uint8_t>(values.size);
    for (Index p = range.first; p < range.last; ++p) values.truth[p - range.first] = matcher->matches(p);
    return values;
}

Values Evaluator::operation(const Node& node, Chunk& chunk) {
    if (node.op == Op::has && node.children[0].kind == Kind::user) return recorded(node.children[0], chunk);
    const std::size_t size = chunk.size(node.domain);
    std::vector<Values> values;
    values.reserve(node.children.size());
    for (const Node& child : node.children) {
        values.push_back(evaluateOn(child, node.domain, chunk));
        // What the first operand decides alone needs no second one.
        if (values.size() == 1 && (node.op == Op::both || node.op == Op::either) && values[0].type == Type::boolean && !values[0].constant) {
            const std::uint8_t decided = node.op == Op::both ? kFalse : kTrue;
            const Buffer<std::uint8_t>& truth = values[0].truth;
            if (std::all_of(truth.data(), truth.data() + truth.size(), [=](std::uint8_t t) { return t == decided; })) return std::move(values[0]);
        }
    }
    Values out;
    if (node.op == Op::contains || node.op == Op::startsWith || node.op == Op::matches) out = textOperation(node, values, size);
    else out = combine(node, values, size);
    out.constant = node.domain == Domain::constant;
    return out;
}

/// has(name): of whatever type.
Values Evaluator::recorded(const Node& node, Chunk& chunk) {
    const IndexRange owners = chunk.range(node.scope);
    Values out;
    out.type = Type::boolean;
    out.size = owners.size();
    out.truth = Buffer<std::uint8_t>(out.size, std::uint8_t{kFalse});
    for (const Column* column : paths_.find(node.scope == Domain::path ? Scope::path : Scope::vertex, node.text)) markRecorded(*column, owners, out.truth.data());
    return out;
}

Values Evaluator::textOperation(const Node& node, const std::vector<Values>& values, std::size_t size) {
    Values out;
    out.type = Type::boolean;
    const Values &a = values[0], &b = values[1];
    out.size = size;
    if (a.type == Type::missing || b.type == Type::missing) {
        out.truth = Buffer<std::uint8_t>(out.size, std::uint8_t{kUnknown});
        return out;
    }
    out.truth = Buffer<std::uint8_t>(out.size);
    std::unique_ptr<re2::RE2>* pattern = nullptr;
    if (node.op == Op::matches) {
        pattern = &patterns_[&node];
        if (!*pattern) *pattern = std::make_unique<re2::RE2>(node.children[1].text, patternOptions());
    }
    std::vector<std::uint8_t>& tested = textTests_[&node];
    const Texts& texts = allTexts();
    const auto test = [&](std::uint32_t x, std::uint32_t y) {
        const std::string_view text = texts.text(x), part = texts.text(y);
        if (pattern) return re2::RE2::PartialMatch(re2::StringPiece(text.data(), text.size()), **pattern);
        return node.op == Op::contains ? text.find(part) != text.npos : text.starts_with(part);
    };
    for (std::size_t i = 0; i < out.size; ++i) {
        const std::uint32_t x = a.texts[a.constant ? 0 : i], y = b.texts[b.constant ? 0 : i];
        if (!a.isKnown(i) || !b.isKnown(i)) {
            out.truth[i] = kUnknown;
            continue;
        }
        if (!b.constant) {
            out.truth[i] = test(x, y) ? kTrue : kFalse;
            continue;
        }
        if (tested.size() <= x) tested.resize(texts.size(), kUnknown);
        if (tested[x] == kUnknown) tested[x] = test(x, y) ? kTrue : kFalse;
        out.truth[i] = tested[x];
    }
    return out;
}

Values Evaluator::reduction(const Node& node, Chunk& chunk) {
    const Values value = evaluateOn(node.children[0], node.argument, chunk);
    const std::size_t place = node.op == Op::quantile ? 2 : 1;
    const std::vector<Index>& firsts = chunk.firstOf(node.domain, node.argument);
    if (node.children.size() <= place) return reduce(node, value, nullptr, firsts);
    const Values condition = evaluateOn(node.children[place], node.argument, chunk);
    return reduce(node, value, &condition, firsts);
}

}  // namespace emca::query::detail
