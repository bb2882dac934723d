// Types and domains of a syntax tree.
#include "check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace emca::query::detail {

namespace {

const char* plural(Domain domain) {
    switch (domain) {
        case Domain::vertex: return "vertices (v.)";
        case Domain::contribution: return "contributions (c.)";
        case Domain::nextEvent: return "shadow tests (n.)";
        case Domain::path: return "paths";
        default: return "pixels";
    }
}

std::string typeName(const Node& node) {
    std::string text = name(node.type);
    if (node.type == Type::vector) text += " of " + std::to_string(node.components);
    if (node.type == Type::color && node.components == 4) text += " with opacity";
    return text;
}

/// The narrowest domain to which one value per `argument` is reduced inside an expression over `current`.
Domain reductionTarget(Domain argument, Domain current) {
    Domain target = current == argument ? parent(argument) : current;
    while (!(encloses(target, argument) && target != argument)) target = parent(target);
    return target;
}

class Checker {
  public:
    Checker(const UserTypes& types, QueryError& error) : types_(types), error_(error) {}

    bool check(Node& node, Domain current) {
        if (aggregates_ && !belongsToGroup(node.kind)) return aggregate(node);
        switch (node.kind) {
            case Kind::number: return set(node, Type::number, 1, Domain::constant);
            case Kind::boolean: return set(node, Type::boolean, 1, Domain::constant);
            case Kind::text: return set(node, Type::text, 0, Domain::constant);
            case Kind::lightPath: return set(node, Type::boolean, 1, Domain::path);
            case Kind::core: return core(node, current);
            case Kind::user: return user(node, current, false);
            case Kind::reduction: return reduction(node, current);
            case Kind::operation: break;
        }
        if (comparesText(node)) {
            for (Node& child : node.children) {
                if (child.kind == Kind::user ? !user(child, current, true) : !check(child, current)) return false;
            }
        } else {
            for (Node& child : node.children)
                if (!check(child, current)) return false;
        }
        node.domain = Domain::constant;
        for (const Node& child : node.children) node.domain = std::max(node.domain, child.domain);
        return operation(node);
    }

    /// From now on outermost reductions are aggregates over elements of `rows`.
    void aggregateOver(Domain rows) {
        aggregates_ = true;
        rows_ = rows;
    }

  private:
    bool fail(const Node& node, std::string message) {
        error_ = {std::move(message), node.where};
        return false;
    }

    /// True of what has one value for a whole group, if its children have.
    static bool belongsToGroup(Kind kind) {
        return kind == Kind::number || kind == Kind::boolean || kind == Kind::text || kind == Kind::operation;
    }

    bool aggregate(Node& node) {
        if (node.kind != Kind::reduction) {
            return fail(node, "Rows of one group may differ in this: aggregate it, as in mean(), or group by it");
        }
        aggregates_ = false;
        const bool fits = std::all_of(node.children.begin(), node.children.end(), [&](Node& child) { return check(child, rows_); });
        aggregates_ = true;
        node.argument = rows_;
        node.domain = Domain::constant;
        if (fits && node.children.empty()) return set(node, Type::number, 1, Domain::constant);  // count()
        return fits && reductionType(node);
    }

    bool set(Node& node, Type type, int components, Domain domain) {
        node.type = type;
        node.components = components;
        node.domain = domain;
        return true;
    }

    bool visible(const Node& node, Domain current) {
        if (encloses(node.scope, current)) return true;
        return fail(node, std::string(plural(node.scope)) + " are many: say which by any(), all(), none(), count(), first(), mean() or the like");
    }

    bool core(Node& node, Domain current) {
        const CoreName& found = *findCore(node.scope, node.text);
        node.single = found.columns[0] != '\0' && found.core != Core::depth &&
                      found.core != Core::contributions && found.core != Core::splats && found.core != Core::mesh &&
                      found.core != Core::face && found.core != Core::segment && found.core != Core::contributionDepth && found.core != Core::nextEventDepth;
        return visible(node, current) && set(node, found.type, found.components, node.scope);
    }

    bool user(Node& node, Domain current, bool wantsText) {
        const UserType type = types_(node.scope, node.text, wantsText);
        node.single = type.single;
        return visible(node, current) && set(node, type.type, type.components, node.scope);
    }

    static bool comparesText(const Node& node) {
        if (node.op == Op::contains || node.op == Op::startsWith || node.op == Op::matches) return true;
        if (node.op != Op::equal && node.op != Op::notEqual && node.op != Op::in) return false;
        return std::any_of(node.children.begin(), node.children.end(), [](const Node& c) {
            return c.kind == Kind::text || (c.kind == Kind::core && findCore(c.scope, c.text)->type == Type::text);
        });
    }

    bool reduction(Node& node, Domain current) {
        if (node.children.empty()) return fail(node, "count() without an argument counts rows of a table: expected a condition, or use vertices or contributions");
        node.argument = Domain::path;
        for (const Node& child : node.children) {
            Domain direct = Domain::constant;
            if (!directDomain(child, direct, error_)) return false;
            if (!encloses(direct, node.argument) && !encloses(node.argument, direct)) {
                return fail(child, "Contributions (c.) and shadow tests (n.) are mixed: they have nothing to do with each other");
            }
            node.argument = std::max(node.argument, direct);
        }
        for (Node& child : node.children)
            if (!check(child, node.argument)) return false;
        node.domain = reductionTarget(node.argument, current);
        return reductionType(node);
    }

    /// The type of a reduction whose arguments are checked; for aggregates of tables, too.
    bool reductionType(Node& node) {
        const Node& value = node.children[0];
        switch (node.op) {
            case Op::any: case Op::all: case Op::none:
                node.type = Type::boolean;
                return wants(value, Type::boolean, node);
            case Op::count:
                node.type = Type::number;
                return wants(value, Type::boolean, node);
            case Op::quantile:
                if (node.children[1].kind != Kind::number || !(node.children[1].number >= 0 && node.children[1].number <= 1)) {
                    return fail(node.children[1], "quantile expects a number in [0, 1] after the value");
                }
                [[fallthrough]];
            case Op::variance: case Op::least: case Op::greatest:
                node.type = Type::number;
                if (!wants(value, Type::number, node)) return false;
                break;
            case Op::sum: case Op::mean:
                if (value.type == Type::boolean || value.type == Type::text || value.type == Type::spectrum) {
                    return fail(value, node.text + " expects numbers, colours or vectors, found " + name(value.type));
                }
                [[fallthrough]];
            default:
                node.type = value.type;
                node.components = value.components;
                break;
        }
        node.single = (node.op == Op::first || node.op == Op::last || node.op == Op::least || node.op == Op::greatest) && value.single;
        const std::size_t condition = node.op == Op::quantile ? 2 : 1;
        return node.op == Op::count || node.children.size() <= condition || wants(node.children[condition], Type::boolean, node);
    }

    bool wants(const Node& child, Type type, const Node& parentNode) {
        if (child.type == type || child.type == Type::missing) return true;
        return fail(child, "“" + parentNode.text + "” expects a " + name(type) + " here, found a " + typeName(child) + hint(child, type));
    }

    static std::string hint(const Node& child, Type wanted) {
        if (wanted == Type::number && child.type == Type::color) return ": luminance() makes a number of a colour";
        if (wanted == Type::number && child.type == Type::vector) return ": take a component, such as .x, or length()";
        if (wanted == Type::boolean && child.type == Type::number) return ": compare it with something";
        if (child.kind == Kind::text) return ": data of that name is v.\"" + child.text + "\" or data[\"" + child.text + "\"]";
        return "";
    }

    bool allWant(Node& node, Type argument, Type result) {
        for (const Node& child : node.children)
            if (!wants(child, argument, node)) return false;
        node.type = result;
        return true;
    }

    bool operation(Node& node) {
        switch (node.op) {
            case Op::both: case Op::either: case Op::invert: return allWant(node, Type::boolean, Type::boolean);
            case Op::less: case Op::lessEqual: case Op::greater: case Op::greaterEqual:
                return allWant(node, Type::number, Type::boolean) && rounded(node);
            case Op::equal: case Op::notEqual: case Op::in: return comparable(node) && rounded(node);
            case Op::negate: case Op::add: case Op::subtract: case Op::multiply: case Op::divide: return arithmetic(node);
            case Op::luminance:
                node.type = Type::number;
                return wants(node.children[0], Type::color, node);
            case Op::length: case Op::distance: case Op::dot: return sameVectors(node) && set(node, Type::number, 1, node.domain);
            case Op::normalize: return sameVectors(node) && set(node, node.children[0].type, node.children[0].components, node.domain);
            case Op::cross: return sameVectors(node, 3) && set(node, Type::vector, 3, node.domain);
            case Op::makeVector:
                node.components = static_cast<int>(node.children.size());
                return allWant(node, Type::number, Type::vector);
            case Op::makeColor:
                node.components = 3;
                return allWant(node, Type::number, Type::color);
            case Op::isNan: case Op::isInf: case Op::isFinite: return numeric(node);
            case Op::has:
                node.type = Type::boolean;
                return true;
            case Op::contains: case Op::startsWith: return allWant(node, Type::text, Type::boolean);
            case Op::matches: return pattern(node);
            case Op::choose: return choice(node);
            case Op::member: case Op::subscript: return part(node);
            default: return allWant(node, Type::number, Type::number);
        }
    }

    bool numeric(Node& node) {
        const Node& child = node.children[0];
        node.type = Type::boolean;
        if (child.type == Type::boolean || child.type == Type::text || child.type == Type::spectrum) {
            return fail(child, node.text + " expects a number, colour or vector, found a " + name(child.type));
        }
        return true;
    }

    bool pattern(Node& node) {
        if (node.children[1].kind != Kind::text) return fail(node.children[1], "matches expects a regular expression in quotes after the text");
        return allWant(node, Type::text, Type::boolean);
    }

    static bool same(const Node& a, const Node& b) {
        return a.type == Type::missing || b.type == Type::missing ||
               (a.type == b.type && (a.type == Type::text || a.type == Type::boolean || a.components == b.components));
    }

    bool comparable(Node& node) {
        node.type = Type::boolean;
        for (std::size_t i = 1; i < node.children.size(); ++i) {
            if (!same(node.children[0], node.children[i])) {
                return fail(node.children[i], "A " + typeName(node.children[0]) + " is compared with a " + typeName(node.children[i]) + hint(node.children[i], node.children[0].type));
            }
            if (node.children[i].type == Type::spectrum) return fail(node.children[i], "Spectra cannot be compared: take an entry, such as [0]");
        }
        return true;
    }

    /// Numbers that the renderer recorded as float are compared with literals as float, so that == 0.1 finds 0.1f.
    bool rounded(Node& node) {
        const auto isSingle = [](const Node& child) { return child.single; };
        if (std::none_of(node.children.begin(), node.children.end(), isSingle)) return true;
        for (Node& child : node.children) {
            Node* literal = child.kind == Kind::operation && child.op == Op::negate ? &child.children[0] : &child;
            if (literal->kind != Kind::number) continue;
            // Beyond the range of float there is nothing to be rounded to: infinity and 0 are other numbers.
            const double size = std::fabs(literal->number);
            if (size <= static_cast<double>(std::numeric_limits<float>::max()) && size >= static_cast<double>(std::numeric_limits<float>::denorm_min()))
                literal->number = static_cast<double>(static_cast<float>(literal->number));
        }
        return true;
    }

    bool arithmetic(Node& node) {
        Node& a = node.children[0];
        for (const Node& child : node.children) {
            if (child.type == Type::boolean || child.type == Type::text || child.type == Type::spectrum) {
                return fail(child, "“" + node.text + "” expects numbers, colours or vectors, found a " + std::string(name(child.type)) + hint(child, Type::number));
            }
        }
        if (node.op == Op::negate) return set(node, a.type, a.components, node.domain);
        const Node& b = node.children[1];
        if (a.type == Type::missing || b.type == Type::missing) {
            const Node& known = a.type == Type::missing ? b : a;
            return set(node, known.type == Type::number ? Type::missing : known.type, known.components, node.domain);
        }
        if (a.type == Type::number && b.type == Type::number) return set(node, Type::number, 1, node.domain);
        const bool scales = node.op == Op::multiply || (node.op == Op::divide && b.type == Type::number);
        if (scales && (a.type == Type::number || b.type == Type::number)) {
            const Node& wide = a.type == Type::number ? b : a;
            return set(node, wide.type, wide.components, node.domain);
        }
        const bool byComponent = node.op == Op::add || node.op == Op::subtract || a.type == Type::color;
        if (same(a, b) && byComponent) return set(node, a.type, a.components, node.domain);
        return fail(node, "“" + node.text + "” does not go between a " + typeName(a) + " and a " + typeName(b));
    }

    bool sameVectors(Node& node, int components = 0) {
        for (const Node& child : node.children) {
            if (!wants(child, Type::vector, node)) return false;
            if (!same(node.children[0], child) || (components && child.type == Type::vector && child.components != components)) {
                return fail(child, node.text + " expects vectors of " + (components ? std::to_string(components) + " components" : std::string("the same size")));
            }
        }
        return true;
    }

    bool choice(Node& node) {
        const Node &a = node.children[1], &b = node.children[2];
        if (!wants(node.children[0], Type::boolean, node)) return false;
        if (!same(a, b)) return fail(b, "if gives a " + typeName(a) + " or a " + typeName(b) + ": both must be of one type");
        const Node& known = a.type == Type::missing ? b : a;
        if (known.type == Type::spectrum) return fail(known, "Spectra cannot be chosen by if: take an entry, such as [0]");
        return set(node, known.type, known.components, node.domain);
    }

    bool part(Node& node) {
        const Node& child = node.children[0];
        node.type = Type::number;
        node.single = child.single;
        const bool letters = node.op == Op::member;
        const bool ofColor = letters && std::string_view("rgba").find(node.text) != std::string_view::npos;
        if (child.type == Type::missing) return true;
        if (child.type == Type::spectrum && !letters) return true;
        const bool fits = letters ? child.type == (ofColor ? Type::color : Type::vector)
                                  : child.type == Type::color || child.type == Type::vector;
        if (!fits) {
            return fail(node, letters ? "." + node.text + " is a part of a " + (ofColor ? "colour" : "vector") + ", found a " + typeName(child)
                                      : "[ ] expects a vector, colour or spectrum, found a " + typeName(child));
        }
        if (node.number >= child.components) return fail(node, "There are only " + std::to_string(child.components) + " components");
        return true;
    }

    const UserTypes& types_;
    QueryError& error_;
    bool aggregates_ = false;
    Domain rows_ = Domain::path;
};

/// True for names by which a recording is asked for core quantities.
bool isCoreColumn(const std::string& name) {
    return std::any_of(coreNames().begin(), coreNames().end(), [&](const CoreName& core) { return name == core.columns; }) || name == "splat";
}

void collectColumns(const Node& node, std::set<std::string>& columns) {
    if (node.kind == Kind::user) columns.insert(isCoreColumn(node.text) ? "data[\"" + node.text + "\"]" : node.text);
    if (node.kind == Kind::core) {
        if (const std::string recorded = findCore(node.scope, node.text)->columns; !recorded.empty()) columns.insert(recorded);
    }
    if (node.kind == Kind::lightPath) columns.insert({"event", "contribution", "emission"});
    for (const Node& child : node.children) collectColumns(child, columns);
}

}  // namespace

bool check(Node& root, const UserTypes& types, QueryError& error) { return checkWithin(root, Domain::path, types, error); }

bool checkWithin(Node& root, Domain domain, const UserTypes& types, QueryError& error) {
    return Checker(types, error).check(root, domain);
}

bool checkAggregate(Node& root, Domain rows, const UserTypes& types, QueryError& error) {
    Checker checker(types, error);
    checker.aggregateOver(rows);
    return checker.check(root, rows);
}

bool directDomain(const Node& node, Domain& domain, QueryError& error) {
    if (node.kind == Kind::reduction) return true;
    Domain own = Domain::constant;
    if (node.kind == Kind::core || node.kind == Kind::user) own = node.scope;
    if (node.kind == Kind::lightPath) own = Domain::path;
    if (!encloses(own, domain) && !encloses(domain, own)) {
        error = {"Contributions (c.) and shadow tests (n.) are mixed: they have nothing to do with each other", node.where};
        return false;
    }
    domain = std::max(domain, own);
    return std::all_of(node.children.begin(), node.children.end(), [&](const Node& child) { return directDomain(child, domain, error); });
}

std::vector<std::string> columnsOf(const Node& root) {
    std::set<std::string> columns;
    collectColumns(root, columns);
    return {columns.begin(), columns.end()};
}

bool readsWholePixels(const Node& root) {
    if (root.kind == Kind::reduction && root.argument == Domain::path) return true;
    return std::any_of(root.children.begin(), root.children.end(), readsWholePixels);
}

UserType userTypeOf(ValueType type) {
    switch (type) {
        case ValueType::boolean: return {Type::boolean, 1, false};
        case ValueType::integer: case ValueType::double1: return {Type::number, 1, false};
        case ValueType::float1: return {Type::number, 1, true};
        case ValueType::float2: return {Type::vector, 2, true};
        case ValueType::float3: return {Type::vector, 3, true};
        case ValueType::integer2: case ValueType::double2: return {Type::vector, 2, false};
        case ValueType::integer3: case ValueType::double3: return {Type::vector, 3, false};
        case ValueType::color: return {Type::color, 3, true};
        case ValueType::colorA: return {Type::color, 4, true};
        case ValueType::text: return {Type::text, 0, false};
        case ValueType::spectrum: return {Type::spectrum, 0, true};
    }
    return {};
}

UserTypes typesOf(const PathSet& paths) {
    return [&paths](Domain scope, const std::string& name, bool wantsText) {
        UserType best;
        for (const Column* column : paths.find(scope == Domain::path ? Scope::path : Scope::vertex, name)) {
            if (column->count == 0) continue;
            const UserType type = userTypeOf(column->type);
            if (best.type == type.type && best.components == type.components) {
                best.single = best.single && type.single;
                continue;
            }
            // Of several types numbers are read, unless a text is asked for; else the first one.
            const Type wanted = wantsText ? Type::text : Type::number;
            if (best.type == Type::missing || (best.type != wanted && type.type == wanted)) best = type;
        }
        return best;
    };
}

UserTypes anyTypes() {
    return [](Domain, const std::string&, bool) { return UserType{}; };
}

}  // namespace emca::query::detail
