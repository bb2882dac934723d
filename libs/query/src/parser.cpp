// Text to syntax tree, by precedence climbing.
#include <algorithm>
#include <limits>
#include <utility>

#include "syntax.h"
#include "token.h"

namespace emca::query::detail {

namespace {

struct BinaryOperator {
    const char* sign;
    Op op;
    int precedence;
};
constexpr int kOr = 1, kAnd = 2, kNot = 3, kComparison = 4, kSum = 5, kProduct = 6, kSign = 7, kPower = 8;
constexpr BinaryOperator kOperators[] = {
    {"or", Op::either, kOr}, {"||", Op::either, kOr}, {"and", Op::both, kAnd}, {"&&", Op::both, kAnd},
    {"==", Op::equal, kComparison}, {"!=", Op::notEqual, kComparison}, {"<=", Op::lessEqual, kComparison},
    {">=", Op::greaterEqual, kComparison}, {"<", Op::less, kComparison}, {">", Op::greater, kComparison},
    {"in", Op::in, kComparison}, {"+", Op::add, kSum}, {"-", Op::subtract, kSum}, {"*", Op::multiply, kProduct},
    {"/", Op::divide, kProduct}, {"%", Op::modulo, kProduct}, {"^", Op::power, kPower},
};
constexpr const char* kReserved[] = {"and", "or", "not", "in", "group", "by", "where", "as"};

bool isReserved(const Token& token) {
    return token.kind == TokenKind::name &&
           std::any_of(std::begin(kReserved), std::end(kReserved), [&](const char* word) { return token.text == word; });
}

class Parser {
  public:
    Parser(std::vector<Token> tokens, QueryError& error) : tokens_(std::move(tokens)), error_(error) {}

    bool whole(Node& root) { return expression(root, 0) && expectEnd("an operator such as and, <, +, or the end"); }

    bool table(std::string_view text, TableSyntax& table) {
        if (!items(text, table.columns)) return false;
        bool grouped = false;
        while (token().kind != TokenKind::end) {
            if (token().isWord("group") && !grouped) {
                advance();
                if (!token().isWord("by")) return fail("Expected by after group");
                advance();
                if (!items(text, table.groups)) return false;
                grouped = true;
            } else if (token().isWord("where") && !table.where) {
                advance();
                if (!expression(table.where.emplace(), 0)) return false;
            } else {
                return fail("Expected a comma, group by, where, or the end");
            }
        }
        return true;
    }

  private:
    const Token& token(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
    void advance() { ++at_; }

    bool failAt(SourceRange where, std::string message) {
        error_ = {std::move(message), where};
        return false;
    }
    bool fail(const std::string& expected) { return failAt(token().where, expected + ", found " + describe(token())); }
    bool expectEnd(const char* expected) {
        return token().kind == TokenKind::end ? true : fail(std::string("Expected ") + expected);
    }
    bool expect(const char* sign, const char* why) {
        if (!token().is(sign)) return fail(std::string("Expected ") + sign + why);
        advance();
        return true;
    }

    bool items(std::string_view text, std::vector<TableSyntax::Item>& out) {
        while (true) {
            TableSyntax::Item& item = out.emplace_back();
            if (!expression(item.value, 0)) return false;
            item.label = std::string(text.substr(item.value.where.begin, item.value.where.end - item.value.where.begin));
            if (token().isWord("as")) {
                advance();
                if (token().kind == TokenKind::end || token().kind == TokenKind::symbol) return fail("Expected a name after as");
                item.label = token().text;
                advance();
            }
            if (!token().is(",")) return true;
            advance();
        }
    }

    const BinaryOperator* binary() const {
        if (token().kind != TokenKind::symbol && token().kind != TokenKind::name) return nullptr;
        for (const BinaryOperator& o : kOperators)
            if (token().text == o.sign) return &o;
        return nullptr;
    }

    /// An operand and all operators after it that bind at least as strongly as `precedence`.
    bool expression(Node& out, int precedence) {
        if (++depth_ > Query::kMaximumDepth) return failAt(token().where, "The query is nested deeper than 200 levels: make it simpler");
        const bool ok = operand(out) && operators(out, precedence);
        --depth_;
        return ok;
    }

    bool operators(Node& left, int precedence) {
        while (const BinaryOperator* o = binary()) {
            if (o->precedence < precedence) return true;
            const SourceRange sign = token().where;
            advance();
            if (o->op == Op::in) {
                if (!list(left)) return false;
            } else {
                Node right;
                if (!expression(right, o->op == Op::power ? o->precedence : o->precedence + 1)) return false;
                Node node = operation(o->op, {left.where.begin, right.where.end});
                node.text = o->sign;
                node.children.push_back(std::move(left));
                node.children.push_back(std::move(right));
                left = std::move(node);
            }
            if (!counted()) return false;
            const BinaryOperator* next = binary();
            if (o->precedence == kComparison && next && next->precedence == kComparison) {
                return failAt({sign.begin, token().where.end}, "Two comparisons in a row: write a < b and b < c");
            }
        }
        return true;
    }

    /// The rest of `x in (a, b, c)`.
    bool list(Node& left) {
        if (!expect("(", " after in: a list of values in parentheses")) return false;
        Node node = operation(Op::in, left.where);
        node.text = "in";
        node.children.push_back(std::move(left));
        do {
            if (node.children.size() > 1) advance();
            if (!expression(node.children.emplace_back(), 0)) return false;
        } while (token().is(","));
        node.where.end = token().where.end;
        if (!expect(")", " at the end of the list")) return false;
        left = std::move(node);
        return true;
    }

    bool counted() {
        return ++nodes_ <= Query::kMaximumNodes ? true : failAt(token().where, "The query has more than 4096 parts: make it shorter");
    }

    Node operation(Op op, SourceRange where) const {
        Node node;
        node.kind = isReduction(op) ? Kind::reduction : Kind::operation;
        node.op = op;
        node.where = where;
        return node;
    }

    bool prefixed(Node& out, Op op, int precedence) {
        out = operation(op, token().where);
        out.text = token().text;
        advance();
        if (!expression(out.children.emplace_back(), precedence)) return false;
        out.where.end = out.children.back().where.end;
        return true;
    }

    bool operand(Node& out) {
        if (!counted()) return false;
        const Token& t = token();
        if (t.is("-")) return prefixed(out, Op::negate, kSign);
        if (t.isWord("not") || t.is("!")) return prefixed(out, Op::invert, kNot);
        if (t.is("+")) {
            advance();
            return expression(out, kSign);
        }
        if (!primary(out)) return false;
        return suffixes(out);
    }

    bool primary(Node& out) {
        const Token t = token();
        out.where = t.where;
        if (t.is("(")) {
            advance();
            if (!expression(out, 0) || !closing("parenthesis")) return false;
            out.where = {t.where.begin, tokens_[at_ - 1].where.end};
            return true;
        }
        if (t.kind == TokenKind::number) {
            out.number = t.number;
        } else if (t.kind == TokenKind::text) {
            out.kind = Kind::text;
            out.text = t.text;
        } else if (t.kind == TokenKind::quotedName) {
            return reference(out, Domain::path, t);
        } else if (t.kind == TokenKind::name && !isReserved(t)) {
            return named(out);
        } else {
            return fail("Expected a value");
        }
        advance();
        return true;
    }

    bool closing(const char* what) {
        if (token().is(")")) {
            advance();
            return true;
        }
        return fail(std::string("Expected ) to close the ") + what);
    }

    bool named(Node& out) {
        const Token t = token();
        if (token(1).is("(")) return call(out);
        if ((t.text == "v" || t.text == "c" || t.text == "n") && token(1).is(".")) {
            advance();
            advance();
            const Domain domain = t.text == "v" ? Domain::vertex : t.text == "c" ? Domain::contribution : Domain::nextEvent;
            return property(out, domain, t.where);
        }
        if (t.text == "v" || t.text == "c" || t.text == "n") {
            advance();
            if (token().kind != TokenKind::end && !token().is(".")) return failAt(t.where, "Expected a name after " + t.text + ", such as " + t.text + ".depth");
            return fail("Expected a name after " + t.text + ", such as " + t.text + ".depth");
        }
        if (t.text == "data" && token(1).is("[")) {
            advance();
            return dataIndex(out, Domain::path);
        }
        if (constant(out, t)) {
            advance();
            return true;
        }
        return reference(out, Domain::path, t);
    }

    static bool constant(Node& out, const Token& t) {
        if (t.text == "true" || t.text == "false") {
            out.kind = Kind::boolean;
            out.number = t.text == "true";
            return true;
        }
        if (t.text == "pi") out.number = 3.14159265358979323846;
        else if (t.text == "inf") out.number = std::numeric_limits<double>::infinity();
        else if (t.text == "nan") out.number = std::numeric_limits<double>::quiet_NaN();
        else return false;
        return true;
    }

    /// What follows `v.`.
    bool property(Node& out, Domain domain, SourceRange begin) {
        const Token t = token();
        bool ok = false;
        if (t.isWord("data") && token(1).is("[")) {
            advance();
            ok = dataIndex(out, domain);
        } else if (t.kind == TokenKind::text || t.kind == TokenKind::quotedName) {
            ok = reference(out, domain, t);
        } else if (t.kind == TokenKind::name) {
            ok = reference(out, domain, t);
        } else {
            return fail(std::string("Expected a name after ") + prefix(domain) + ".");
        }
        out.where.begin = begin.begin;
        return ok;
    }

    /// A core quantity, or else user data of this name.
    bool reference(Node& out, Domain domain, const Token& t) {
        const CoreName* core = findCore(domain, t.text);
        if (!core) return userData(out, domain);
        out.kind = Kind::core;
        out.core = core->core;
        out.scope = domain;
        out.where = t.where;
        out.text = t.text;
        advance();
        return true;
    }

    bool userData(Node& out, Domain domain) {
        if (domain != Domain::path && domain != Domain::vertex) {
            std::string known;
            for (const CoreName& core : coreNames())
                if (core.domain == domain) known += (known.empty() ? "" : ", ") + std::string(core.name);
            return failAt(token().where, std::string(prefix(domain)) + ". has no " + token().text + ": expected one of " + known);
        }
        out.kind = Kind::user;
        out.scope = domain;
        out.text = token().text;
        out.where = token().where;
        advance();
        return true;
    }

    /// The ["name"] after data.
    bool dataIndex(Node& out, Domain domain) {
        advance();
        if (token().kind != TokenKind::text) return fail("Expected a name in quotes after data[");
        if (domain != Domain::path && domain != Domain::vertex) return fail("Only paths and vertices have data");
        if (!userData(out, domain)) return false;
        out.where.end = token().where.end;
        return expect("]", " after the name");
    }

    bool call(Node& out) {
        const Token name = token();
        advance();
        advance();
        std::vector<Node> arguments;
        while (!token().is(")")) {
            if (!arguments.empty() && !expect(",", " or ) after an argument")) return false;
            if (token().kind == TokenKind::end) return fail("Expected ) to close " + name.text + "(");
            if (!expression(arguments.emplace_back(), 0)) return false;
        }
        const SourceRange where{name.where.begin, token().where.end};
        advance();
        return function(out, name, where, std::move(arguments));
    }

    bool function(Node& out, const Token& name, SourceRange where, std::vector<Node> arguments) {
        if (name.text == "lpe") {
            if (arguments.size() != 1 || arguments[0].kind != Kind::text) {
                return failAt(where, "lpe expects one light path expression in quotes, such as lpe(\"C<RD>L\")");
            }
            out.kind = Kind::lightPath;
            out.text = arguments[0].text;
            out.where = where;
            return true;
        }
        if (arguments.empty() && constant(out, name)) {
            out.where = where;
            return true;
        }
        const bool countsRows = name.text == "count" && arguments.empty();
        const Function* f = findFunction(name.text, countsRows ? 1 : arguments.size());
        if (!f) return failAt(name.where, "There is no function " + name.text + suggestion(name.text));
        const auto count = static_cast<int>(arguments.size());
        if (!countsRows && (count < f->minimumArguments || (f->maximumArguments >= 0 && count > f->maximumArguments))) {
            return failAt(where, wrongCount(*f, count));
        }
        out = operation(f->op, where);
        out.text = f->name;
        out.children = std::move(arguments);
        return true;
    }

    static std::string wrongCount(const Function& f, int count) {
        std::string expected = std::to_string(f.minimumArguments);
        if (f.maximumArguments < 0) expected += " or more";
        else if (f.maximumArguments != f.minimumArguments) expected += " or " + std::to_string(f.maximumArguments);
        return std::string(f.name) + " expects " + expected + (expected == "1" ? " argument" : " arguments") + ", found " +
               std::to_string(count);
    }

    static std::string suggestion(const std::string& name) {
        for (const Function& f : functions())
            if (std::string_view(f.name).substr(0, 3) == std::string_view(name).substr(0, 3)) return std::string(": did you mean ") + f.name;
        return ": docs/queries.md lists them";
    }

    /// .x and [2] after a value.
    bool suffixes(Node& out) {
        while (token().is(".") || token().is("[")) {
            if (!counted()) return false;
            const bool dot = token().is(".");
            Node node = operation(dot ? Op::member : Op::subscript, out.where);
            advance();
            if (dot ? !member(node) : !subscript(node)) return false;
            node.children.push_back(std::move(out));
            out = std::move(node);
        }
        return true;
    }

    bool member(Node& node) {
        static constexpr std::string_view kLetters = "xyzrgba";
        const Token& t = token();
        if (t.kind != TokenKind::name || t.text.size() != 1 || kLetters.find(t.text[0]) == kLetters.npos) {
            return fail("Expected x, y, z, r, g, b or a after the dot");
        }
        const std::size_t place = kLetters.find(t.text[0]);
        node.text = t.text;
        node.number = static_cast<double>(place < 3 ? place : place - 3);
        node.where.end = t.where.end;
        advance();
        return true;
    }

    bool subscript(Node& node) {
        const Token& t = token();
        if (t.kind != TokenKind::number || t.number > 1e6 || t.number != static_cast<double>(static_cast<std::uint32_t>(t.number))) {
            return fail("Expected a whole number in [ ]");
        }
        node.number = t.number;
        advance();
        node.where.end = token().where.end;
        return expect("]", " after the number");
    }

    std::vector<Token> tokens_;
    QueryError& error_;
    std::size_t at_ = 0, depth_ = 0, nodes_ = 0;
};

bool shortEnough(std::string_view text, QueryError& error) {
    if (text.size() <= Query::kMaximumLength) return true;
    error = {"The query has " + std::to_string(text.size()) + " characters, at most " +
                 std::to_string(Query::kMaximumLength) + " are allowed", {}};
    return false;
}

}  // namespace

bool hasMeaning(std::string_view word) {
    static constexpr std::string_view kOthers[] = {"true", "false", "pi", "inf", "nan", "v", "c", "n", "data"};
    return std::find(std::begin(kReserved), std::end(kReserved), word) != std::end(kReserved) ||
           std::find(std::begin(kOthers), std::end(kOthers), word) != std::end(kOthers);
}

bool parseExpression(std::string_view text, Node& root, QueryError& error) {
    std::vector<Token> tokens;
    return shortEnough(text, error) && tokenize(text, tokens, error) && Parser(std::move(tokens), error).whole(root);
}

bool parseTable(std::string_view text, TableSyntax& table, QueryError& error) {
    std::vector<Token> tokens;
    return shortEnough(text, error) && tokenize(text, tokens, error) && Parser(std::move(tokens), error).table(text, table);
}

}  // namespace emca::query::detail
