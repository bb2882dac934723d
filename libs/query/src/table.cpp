#include "emca/query/table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <unordered_map>

#include "check.h"
#include "evaluator.h"
#include "path_values.h"
#include "prepare.h"

namespace emca::query {

using namespace detail;

namespace {

/// Values of rows, appended chunk by chunk.
struct RowValues {
    Type type = Type::missing;
    std::size_t components = 0;
    std::array<std::vector<double>, 4> numbers;
    std::vector<std::uint8_t> known, truth;
    std::vector<std::uint32_t> texts;

    void append(const Values& from, std::size_t row) {
        type = from.type;
        components = type == Type::number || type == Type::color || type == Type::vector ? static_cast<std::size_t>(from.components) : 0;
        const std::size_t i = from.constant ? 0 : row;
        const bool isKnown = from.isKnown(row);
        known.push_back(isKnown);
        if (type == Type::boolean) truth.push_back(from.truth[i]);
        if (type == Type::text) texts.push_back(isKnown ? from.texts[i] : Texts::kNone);
        for (std::size_t c = 0; c < components; ++c) numbers[c].push_back(isKnown ? from.numbers[c][i] : 0.0);
    }
    std::size_t bytes() const { return known.size() * (2 + 8 * components + 4 * !texts.empty()); }

    /// The values of rows order[0], order[1], …
    Values ordered(const std::vector<Index>& order) const {
        Values out;
        out.type = type;
        out.components = static_cast<int>(components);
        out.size = order.size();
        const auto take = [&](const auto& from, auto& to) {
            if (from.empty()) return;
            to = std::decay_t<decltype(to)>(order.size());
            for (std::size_t i = 0; i < order.size(); ++i) to[i] = from[order[i]];
        };
        for (std::size_t c = 0; c < 4; ++c) take(numbers[c], out.numbers[c]);
        if (type == Type::boolean) take(truth, out.truth);
        else take(known, out.known);
        take(texts, out.texts);
        return out;
    }
};

/// An aggregate of a column and the values that it goes over.
struct Aggregate {
    const Node* node;
    RowValues value, condition;
    bool hasCondition() const { return node->op != Op::count && node->children.size() > conditionPlace(); }
    std::size_t conditionPlace() const { return node->op == Op::quantile ? 2 : 1; }
};

void collectAggregates(const Node& node, std::vector<Aggregate>& aggregates) {
    if (node.kind == Kind::reduction) {
        aggregates.push_back({&node, {}, {}});
        return;
    }
    for (const Node& child : node.children) collectAggregates(child, aggregates);
}

/// Orders by value, what is unknown last; NaN before that.
bool before(const RowValues& key, const Texts& texts, Index a, Index b, bool& same) {
    same = false;
    if (key.known[a] != key.known[b]) return key.known[a] > key.known[b];
    if (!key.known[a]) { same = true; return false; }
    if (key.type == Type::boolean && key.truth[a] != key.truth[b]) return key.truth[a] < key.truth[b];
    if (key.type == Type::text && key.texts[a] != key.texts[b]) return texts.text(key.texts[a]) < texts.text(key.texts[b]);
    for (std::size_t c = 0; c < key.components; ++c) {
        const double x = key.numbers[c][a], y = key.numbers[c][b];
        if (std::isnan(x) != std::isnan(y)) return std::isnan(y);
        if (x != y && !std::isnan(x)) return x < y;
    }
    same = true;
    return false;
}

PathValues toColumn(const Values& values, const Texts& texts, std::size_t size) {
    PathValues out;
    setType(values.type, values.components, out);
    append(values, size, &texts, out);
    return out;
}

/// One evaluation of a table.
class Tabulation {
  public:
    Tabulation(const TableSyntax& syntax, const PathSet& paths, const EvaluationLimits& limits)
        : syntax_(syntax), paths_(paths), limits_(limits) {}

    bool check(const UserTypes& types, QueryError& error) {
        if (!findRows(error)) return false;
        for (TableSyntax::Item& group : syntax_.groups) {
            if (!checkWithin(group.value, rows_, types, error)) return false;
            if (group.value.type == Type::spectrum) return fail(group.value, "Spectra make no groups: take an entry, such as [0]", error);
        }
        for (TableSyntax::Item& column : syntax_.columns) {
            if (isKey(column)) continue;
            if (!checkAggregate(column.value, rows_, types, error)) return false;
            if (column.value.kind == Kind::text || hasText(column.value)) return fail(column.value, "Texts can be aggregated by first() and last() alone", error);
        }
        if (!syntax_.where) return true;
        if (!checkWithin(*syntax_.where, rows_, types, error)) return false;
        if (syntax_.where->type == Type::boolean || syntax_.where->type == Type::missing) return true;
        return fail(*syntax_.where, std::string("where expects a condition, found a ") + name(syntax_.where->type), error);
    }

    Result<TableRows> run() {
        Node all;  // what the evaluator reports missing names of
        for (const auto* items : {&syntax_.columns, &syntax_.groups})
            for (const TableSyntax::Item& item : *items) all.children.push_back(item.value);
        if (syntax_.where) all.children.push_back(*syntax_.where);
        Evaluator evaluator(paths_, all);
        if (auto done = collect(evaluator); !done) return done.error();
        const std::vector<Index> firsts = orderRows(evaluator.texts());
        TableRows rows = columnsOf(evaluator, firsts);
        rows.missing = evaluator.missing();
        return rows;
    }

  private:
    static bool fail(const Node& node, std::string message, QueryError& error) {
        error = {std::move(message), node.where};
        return false;
    }

    bool isKey(const TableSyntax::Item& column) const { return keyOf(column) < syntax_.groups.size(); }
    std::size_t keyOf(const TableSyntax::Item& column) const {
        std::size_t i = 0;
        while (i < syntax_.groups.size() && syntax_.groups[i].label != column.label) ++i;
        return i;
    }

    static bool hasText(const Node& node) {
        return node.kind == Kind::operation && std::any_of(node.children.begin(), node.children.end(), [](const Node& c) { return c.type == Type::text || c.type == Type::spectrum || hasText(c); });
    }

    bool widen(const Node& node, QueryError& error) {
        Domain direct = Domain::constant;
        if (!directDomain(node, direct, error)) return false;
        if (!encloses(direct, rows_) && !encloses(rows_, direct)) return fail(node, "Contributions (c.) and shadow tests (n.) are mixed in one table", error);
        rows_ = std::max(rows_, direct);
        return true;
    }

    /// What a row is: the narrowest thing that is named.
    bool findRows(QueryError& error) {
        rows_ = Domain::path;
        for (const TableSyntax::Item& group : syntax_.groups)
            if (!widen(group.value, error)) return false;
        if (syntax_.where && !widen(*syntax_.where, error)) return false;
        for (const TableSyntax::Item& column : syntax_.columns) {
            std::vector<Aggregate> aggregates;
            collectAggregates(column.value, aggregates);
            for (const Aggregate& aggregate : aggregates)
                for (const Node& child : aggregate.node->children)
                    if (!widen(child, error)) return false;
        }
        return true;
    }

    bool wholePixels() const {
        const auto reads = [](const TableSyntax::Item& item) { return readsWholePixels(item.value); };
        const bool inColumns = std::any_of(syntax_.columns.begin(), syntax_.columns.end(), [](const TableSyntax::Item& item) {
            std::vector<Aggregate> aggregates;
            collectAggregates(item.value, aggregates);
            return std::any_of(aggregates.begin(), aggregates.end(), [](const Aggregate& a) {
                return std::any_of(a.node->children.begin(), a.node->children.end(), readsWholePixels);
            });
        });
        return inColumns || std::any_of(syntax_.groups.begin(), syntax_.groups.end(), reads) || (syntax_.where && readsWholePixels(*syntax_.where));
    }

    Result<void> collect(Evaluator& evaluator) {
        for (const TableSyntax::Item& column : syntax_.columns)
            if (!isKey(column)) collectAggregates(column.value, aggregates_);
        keys_.resize(syntax_.groups.size());
        const bool pixels = wholePixels();
        for (Index first = 0; first < paths_.pathCount();) {
            if (limits_.cancelled && limits_.cancelled()) return Error{ErrorCode::cancelled, "The query was cancelled."};
            const IndexRange range = nextChunk(paths_, first, pixels);
            Chunk chunk(paths_, range);
            collect(evaluator, chunk);
            std::size_t bytes = 0;
            for (const RowValues& key : keys_) bytes += key.bytes();
            for (const Aggregate& aggregate : aggregates_) bytes += aggregate.value.bytes() + aggregate.condition.bytes();
            if (2 * bytes > limits_.temporaryBytes) {  // they are copied once, into the order of their groups
                return Error{ErrorCode::tooLarge, "The table needs more than the " + std::to_string(limits_.temporaryBytes >> 20) +
                                                      " MiB allowed for its " + std::to_string(rowCount_) + " rows so far: take fewer by where, or fewer pixels."};
            }
            first = range.last;
        }
        return {};
    }

    void collect(Evaluator& evaluator, Chunk& chunk) {
        const std::size_t size = chunk.size(rows_);
        std::vector<Index> taken;
        if (syntax_.where) {
            const Values where = evaluator.evaluateOn(*syntax_.where, rows_, chunk);
            for (Index i = 0; i < size; ++i)
                if (where.type == Type::boolean && where.truth[where.constant ? 0 : i] == kTrue) taken.push_back(i);
        } else {
            taken.resize(size);
            std::iota(taken.begin(), taken.end(), 0u);
        }
        rowCount_ += taken.size();
        const auto append = [&](const Node& node, RowValues& to) {
            const Values values = evaluator.evaluateOn(node, rows_, chunk);
            to.type = values.type;
            for (const Index i : taken) to.append(values, i);
        };
        for (std::size_t i = 0; i < keys_.size(); ++i) append(syntax_.groups[i].value, keys_[i]);
        for (Aggregate& aggregate : aggregates_) {
            if (!aggregate.node->children.empty()) append(aggregate.node->children[0], aggregate.value);
            if (aggregate.hasCondition()) append(aggregate.node->children[aggregate.conditionPlace()], aggregate.condition);
        }
    }

    /// Sorts rows by their keys, those of one group as they came. Returns where each group begins, and the end.
    std::vector<Index> orderRows(const Texts& texts) {
        order_.resize(rowCount_);
        std::iota(order_.begin(), order_.end(), 0u);
        if (keys_.empty()) return {0, static_cast<Index>(rowCount_)};
        const auto less = [&](Index a, Index b) {
            for (const RowValues& key : keys_) {
                bool same = false;
                const bool isBefore = before(key, texts, a, b, same);
                if (!same) return isBefore;
            }
            return false;
        };
        std::stable_sort(order_.begin(), order_.end(), less);
        std::vector<Index> firsts;
        for (Index i = 0; i < rowCount_; ++i)
            if (i == 0 || less(order_[i - 1], order_[i])) firsts.push_back(i);
        firsts.push_back(static_cast<Index>(rowCount_));
        return firsts;
    }

    Values aggregated(const Aggregate& aggregate, const std::vector<Index>& firsts) const {
        if (!aggregate.node->children.empty()) {
            const Values value = aggregate.value.ordered(order_);
            if (!aggregate.hasCondition()) return reduce(*aggregate.node, value, nullptr, firsts);
            const Values condition = aggregate.condition.ordered(order_);
            return reduce(*aggregate.node, value, &condition, firsts);
        }
        Values counts;
        counts.type = Type::number;
        counts.size = firsts.size() - 1;
        counts.numbers[0] = Buffer<double>(counts.size);
        for (std::size_t i = 0; i < counts.size; ++i) counts.numbers[0][i] = firsts[i + 1] - firsts[i];
        return counts;
    }

    /// The value of an expression over aggregates, one per group.
    Values ofGroups(const Node& node, const std::vector<Index>& firsts, std::size_t& next, Evaluator& evaluator) const {
        if (node.kind == Kind::reduction) return aggregated(aggregates_[next++], firsts);
        if (node.kind != Kind::operation) {
            Chunk none(paths_, {0, 0});
            return evaluator.evaluate(node, none);
        }
        std::vector<Values> values;
        for (const Node& child : node.children) values.push_back(ofGroups(child, firsts, next, evaluator));
        const bool constant = std::all_of(values.begin(), values.end(), [](const Values& v) { return v.constant; });
        Values out = combine(node, values, constant ? 1 : firsts.size() - 1);
        out.constant = constant;
        return out;
    }

    TableRows columnsOf(Evaluator& evaluator, const std::vector<Index>& firsts) const {
        TableRows rows;
        rows.rowCount = firsts.size() - 1;
        std::vector<Index> firstRows;
        for (std::size_t i = 0; i < rows.rowCount && !keys_.empty(); ++i) firstRows.push_back(order_[firsts[i]]);
        const auto addKey = [&](std::size_t i) {
            rows.columns.push_back({syntax_.groups[i].label, true, toColumn(keys_[i].ordered(firstRows), evaluator.texts(), rows.rowCount)});
        };
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            const auto lists = [&](const TableSyntax::Item& column) { return keyOf(column) == i; };
            if (std::none_of(syntax_.columns.begin(), syntax_.columns.end(), lists)) addKey(i);
        }
        std::size_t next = 0;
        for (const TableSyntax::Item& column : syntax_.columns) {
            if (isKey(column)) {
                addKey(keyOf(column));
                continue;
            }
            const Values values = ofGroups(column.value, firsts, next, evaluator);
            rows.columns.push_back({column.label, false, toColumn(values, evaluator.texts(), rows.rowCount)});
        }
        return rows;
    }

    TableSyntax syntax_;
    const PathSet& paths_;
    const EvaluationLimits& limits_;
    Domain rows_ = Domain::path;
    std::vector<RowValues> keys_;
    std::vector<Aggregate> aggregates_;
    std::size_t rowCount_ = 0;
    std::vector<Index> order_;
};

bool prepareAll(TableSyntax& syntax, QueryError& error) {
    for (auto* items : {&syntax.columns, &syntax.groups})
        for (TableSyntax::Item& item : *items)
            if (!prepare(item.value, error)) return false;
    return !syntax.where || prepare(*syntax.where, error);
}

}  // namespace

Result<Table> Table::parse(std::string_view text, QueryError* where) {
    QueryError error;
    TableSyntax syntax;
    const auto failed = [&] {
        if (where) *where = error;
        return toError(text, error);
    };
    if (!parseTable(text, syntax, error) || !prepareAll(syntax, error)) return failed();
    const PathSet nothing;
    const EvaluationLimits limits;
    if (!Tabulation(syntax, nothing, limits).check(anyTypes(), error)) return failed();
    Table table;
    table.text_ = std::string(text);
    std::set<std::string> columns;
    const auto add = [&](const Node& node) {
        const std::vector<std::string> names = detail::columnsOf(node);
        columns.insert(names.begin(), names.end());
    };
    for (const auto* items : {&syntax.columns, &syntax.groups})
        for (const TableSyntax::Item& item : *items) add(item.value);
    if (syntax.where) add(*syntax.where);
    table.columns_.assign(columns.begin(), columns.end());
    if (table.columns_.empty()) table.columns_ = {"estimate"};
    table.syntax_ = std::make_shared<const TableSyntax>(std::move(syntax));
    return table;
}

Result<TableRows> Table::evaluate(const PathSet& paths, const EvaluationLimits& limits, QueryError* where) const {
    QueryError error;
    Tabulation tabulation(*syntax_, paths, limits);
    if (!tabulation.check(typesOf(paths), error)) {
        if (where) *where = error;
        return toError(text_, error);
    }
    return tabulation.run();
}

}  // namespace emca::query
