#include "emca/query/query.h"

#include <algorithm>

#include "check.h"
#include "evaluator.h"
#include "path_values.h"
#include "patterns.h"
#include "prepare.h"

namespace emca::query {

namespace detail {

namespace {

/// Adds the instructions of a regular expression to those of the whole query.
bool affordable(int size, int& total, SourceRange where, QueryError& error) {
    total += size;
    if (total <= kMaximumProgram) return true;
    error = {"The light path and regular expressions are too large together: use fewer or smaller repetitions", where};
    return false;
}

bool prepare(Node& node, int& programs, QueryError& error) {
    if (node.kind == Kind::lightPath) {
        // "lpe(" and blanks stand before the quote; the text's own place is good enough for its first character.
        node.lightPath = LightPathExpression::parse(node.text, node.where.begin + 4, error);
        if (!node.lightPath || !affordable(node.lightPath->programSize(), programs, node.where, error)) return false;
    }
    if (node.kind == Kind::operation && node.op == Op::matches && node.children[1].kind == Kind::text) {
        const re2::RE2 pattern(node.children[1].text, patternOptions());
        if (!pattern.ok()) {
            error = {"The regular expression is not valid: " + pattern.error(), node.children[1].where};
            return false;
        }
        if (!affordable(pattern.ProgramSize(), programs, node.children[1].where, error)) return false;
    }
    return std::all_of(node.children.begin(), node.children.end(), [&](Node& child) { return prepare(child, programs, error); });
}

}  // namespace

bool prepare(Node& root, QueryError& error) {
    int programs = 0;
    return prepare(root, programs, error);
}

namespace {

/// Bytes of one value of a node on all elements of its domain; of operands, which are brought to their parent's domain,
/// on that.
std::size_t bytesOf(const Node& node, Domain domain, const Chunk& chunk) {
    const std::size_t components = node.type == Type::text || node.type == Type::spectrum ? 1 : static_cast<std::size_t>(std::max(node.components, 1));
    return node.type == Type::boolean ? chunk.size(domain) : chunk.size(domain) * (8 * components + 1);
}

/// The most that is needed at once to evaluate a node: earlier operands wait for later ones, then all for the result.
std::size_t peakBytes(const Node& node, const Chunk& chunk) {
    const Domain domain = node.kind == Kind::reduction ? node.argument : node.domain;
    std::size_t waiting = 0, peak = 0;
    for (const Node& child : node.children) {
        // A value of a wider domain, and the same spread over the elements of this one.
        const std::size_t own = child.domain == Domain::constant ? 0 : bytesOf(child, domain, chunk);
        const std::size_t spread = child.domain == domain ? own : own + bytesOf(child, child.domain, chunk);
        peak = std::max(peak, waiting + std::max(peakBytes(child, chunk), spread));
        waiting += own;
    }
    return std::max(peak, waiting + bytesOf(node, node.domain, chunk));
}

}  // namespace

std::size_t temporaryBytes(const Node& root, const Chunk& chunk) {
    std::size_t owners = 0;  // who belongs to whom
    for (const Domain domain : {Domain::path, Domain::vertex, Domain::contribution, Domain::nextEvent}) owners += 2 * sizeof(Index) * chunk.size(domain);
    return owners + peakBytes(root, chunk);
}

}  // namespace detail

namespace {

using namespace detail;

/// Not the first byte of a character in UTF-8.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::string excerpt(std::string_view query, SourceRange where) {
    constexpr std::size_t kLongest = 40;
    if (where.begin >= query.size() || where.end <= where.begin) return {};
    std::size_t size = std::min<std::size_t>({where.end - where.begin, query.size() - where.begin, kLongest});
    while (where.begin + size < query.size() && continues(query[where.begin + size])) --size;
    std::string piece(query.substr(where.begin, size));
    if (where.begin + size < where.end) piece += "…";
    return piece.empty() ? piece : " (" + piece + ")";
}

/// A tree checked against the types of a set, and chunks over which it goes.
class Evaluation {
  public:
    Evaluation(const Node& root, const PathSet& paths, const EvaluationLimits& limits, bool wholePixels)
        : root_(root), paths_(paths), limits_(limits), wholePixels_(wholePixels) {}

    /// Calls `use(values, range)` with one value per path. Returns false with `error` set if types do not fit.
    template <typename Use>
    Result<void> run(std::string_view text, QueryError* where, bool condition, Use use, std::vector<std::string>& missing) {
        QueryError error;
        bool fits = check(root_, typesOf(paths_), error);
        if (fits && condition && root_.type != Type::boolean && root_.type != Type::missing) {
            error = {std::string("The query gives a ") + name(root_.type) + ": expected a condition, such as luminance > 10", root_.where};
            fits = false;
        }
        if (!fits) {
            if (where) *where = error;
            return toError(text, error);
        }
        Evaluator evaluator(paths_, root_);
        missing = evaluator.missing();
        for (Index first = 0; first < paths_.pathCount();) {
            if (limits_.cancelled && limits_.cancelled()) return Error{ErrorCode::cancelled, "The query was cancelled."};
            const IndexRange range = nextChunk(paths_, first, wholePixels_);
            Chunk chunk(paths_, range);
            if (temporaryBytes(root_, chunk) > limits_.temporaryBytes) return tooLarge(range);
            use(evaluator, evaluator.evaluateOn(root_, Domain::path, chunk), range);
            first = range.last;
        }
        return {};
    }

    const Node& root() const { return root_; }

  private:
    Error tooLarge(IndexRange range) const {
        const Index vertices = paths_.vertices(range.last - 1).last - paths_.vertices(range.first).first;
        return {ErrorCode::tooLarge, std::string("The query reads ") + (wholePixels_ ? "a whole pixel" : "a path") + " with " +
                                         std::to_string(vertices) + " vertices at once, which needs more than the " +
                                         std::to_string(limits_.temporaryBytes >> 20) + " MiB allowed: trace fewer samples, or use a simpler query."};
    }

    Node root_;
    const PathSet& paths_;
    const EvaluationLimits& limits_;
    bool wholePixels_;
};

}  // namespace

const char* name(ExpressionType type) {
    switch (type) {
        case ExpressionType::boolean: return "condition";
        case ExpressionType::number: return "number";
        case ExpressionType::color: return "colour";
        case ExpressionType::vector: return "vector";
        case ExpressionType::text: return "text";
        case ExpressionType::spectrum: return "spectrum";
        case ExpressionType::missing: break;
    }
    return "value that was not recorded";
}

Error toError(std::string_view query, const QueryError& error) {
    const std::string_view before = query.substr(0, std::min<std::size_t>(error.where.begin, query.size()));
    const auto characters = std::count_if(before.begin(), before.end(), [](char c) { return !continues(c); });
    return {ErrorCode::parseFailed, "At character " + std::to_string(characters + 1) + excerpt(query, error.where) + ": " + error.message + "."};
}

std::string pointAt(std::string_view query, SourceRange where) {
    std::string line(query), mark;
    std::replace_if(line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    for (std::size_t i = 0; i <= line.size(); ++i) {
        const bool inside = i >= where.begin && (i < where.end || i == where.begin);
        if (i < line.size() && continues(line[i])) continue;
        if (i == line.size() && !inside) break;
        mark += inside ? '^' : ' ';
    }
    mark.erase(mark.find_last_not_of(' ') + 1);
    return line + "\n" + mark;
}

Result<Query> Query::parse(std::string_view text, QueryError* where) {
    Query query;
    Node root;
    QueryError error;
    const auto failed = [&] {
        if (where) *where = error;
        return toError(text, error);
    };
    if (!parseExpression(text, root, error) || !prepare(root, error)) return failed();
    Node checked = root;  // as far as types are known before there is a set
    if (!check(checked, anyTypes(), error)) return failed();
    query.text_ = std::string(text);
    query.columns_ = columnsOf(root);
    if (query.columns_.empty()) query.columns_ = {"estimate"};  // an empty list would mean all
    query.wholePixels_ = detail::readsWholePixels(checked);
    query.root_ = std::make_shared<const Node>(std::move(root));
    return query;
}

Result<Matches> Query::select(const PathSet& paths, const EvaluationLimits& limits, QueryError* where) const {
    Matches matches;
    Evaluation evaluation(*root_, paths, limits, wholePixels_);
    const auto use = [&](Evaluator&, const Values& values, IndexRange range) {
        for (Index p = range.first; p < range.last; ++p) {
            const std::uint8_t truth = values.type == Type::missing ? std::uint8_t{kUnknown} : values.truth[values.constant ? 0 : p - range.first];
            if (truth == kTrue) matches.paths.push_back(p);
            matches.unknown += truth == kUnknown;
        }
    };
    if (auto done = evaluation.run(text_, where, true, use, matches.missing); !done) return done.error();
    return matches;
}

Result<PathValues> Query::evaluate(const PathSet& paths, const EvaluationLimits& limits, QueryError* where) const {
    PathValues out;
    Evaluation evaluation(*root_, paths, limits, wholePixels_);
    const auto use = [&](Evaluator& evaluator, const Values& values, IndexRange range) {
        append(values, range.size(), values.type == Type::text ? &evaluator.texts() : nullptr, out);
    };
    if (auto done = evaluation.run(text_, where, false, use, out.missing); !done) return done.error();
    setType(evaluation.root().type, evaluation.root().components, out);
    if (out.type == Type::spectrum) return Error{ErrorCode::parseFailed, "The expression gives a spectrum: take an entry of it, such as [0]."};
    return out;
}

std::string quotedText(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string quotedName(std::string_view text) {
    static const re2::RE2 plain("[A-Za-z_][A-Za-z0-9_]*");
    if (re2::RE2::FullMatch(re2::StringPiece(text.data(), text.size()), plain) && !hasMeaning(text)) return std::string(text);
    std::string out = "`";
    for (const char c : text) {
        if (c == '`' || c == '\\') out += '\\';
        out += c;
    }
    return out + "`";
}

}  // namespace emca::query
