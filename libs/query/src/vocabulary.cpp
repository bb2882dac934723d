#include "emca/query/vocabulary.h"

#include <algorithm>

#include "check.h"
#include "emca/query/table.h"
#include "prepare.h"

namespace emca::query {
namespace {

using namespace detail;

Owner ownerOf(Domain domain) {
    switch (domain) {
        case Domain::vertex: return Owner::vertex;
        case Domain::contribution: return Owner::contribution;
        case Domain::nextEvent: return Owner::shadowTest;
        default: return Owner::path;
    }
}

std::string dotted(Domain domain) { return domain == Domain::path ? std::string() : std::string(prefix(domain)) + "."; }

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const auto first = text.find_first_not_of(kBlanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::vector<Quantity> coreQuantities() {
    std::vector<Quantity> all;
    for (const CoreName& core : coreNames())
        all.push_back({dotted(core.domain) + core.name, ownerOf(core.domain), core.type, core.components, core.meaning, false});
    return all;
}

std::vector<Quantity> dataOf(const PathSet& paths) {
    std::vector<Quantity> all;
    const UserTypes types = typesOf(paths);
    for (const Column& column : paths.userColumns()) {
        const Domain domain = column.scope == Scope::path ? Domain::path : Domain::vertex;
        // A core quantity of the same name is meant by the name alone.
        std::string expression = dotted(domain) + (findCore(domain, column.name) ? "data[" + quotedText(column.name) + "]" : quotedName(column.name));
        if (!all.empty() && all.back().expression == expression) continue;  // columns of one name, by type, are neighbours
        const UserType type = types(domain, column.name, false);
        all.push_back({std::move(expression), ownerOf(domain), type.type, type.components, "", true});
    }
    return all;
}

std::vector<Quantity> partsOf(const Quantity& quantity) {
    std::vector<Quantity> parts;
    const auto add = [&](std::string expression) { parts.push_back({std::move(expression), quantity.owner, Type::number, 1, "", quantity.data}); };
    const auto members = [&](std::string_view letters) {
        for (int i = 0; i < quantity.components; ++i) add(quantity.expression + "." + letters[static_cast<std::size_t>(i)]);
    };
    if (quantity.type == Type::color) {
        add("luminance(" + quantity.expression + ")");
        members("rgba");
    } else if (quantity.type == Type::vector) {
        add("length(" + quantity.expression + ")");
        members("xyz");
    }
    return parts;
}

Result<Quantity> describe(std::string_view expression, const PathSet& paths, QueryError* where) {
    const std::string_view text = trimmed(expression);
    Node root;
    QueryError error;
    Domain domain = Domain::constant;
    const bool fits = parseExpression(text, root, error) && prepare(root, error) && directDomain(root, domain, error) &&
                      checkWithin(root, std::max(domain, Domain::path), typesOf(paths), error);
    if (!fits) {
        if (where) *where = error;
        return toError(text, error);
    }
    return Quantity{std::string(text), ownerOf(domain), root.type, root.type == Type::text || root.type == Type::spectrum ? 0 : root.components, "",
                    root.kind == Kind::user};
}

std::vector<std::string> textsOf(std::string_view expression, const PathSet& paths, std::size_t maximum) {
    const auto quantity = describe(expression, paths);
    if (!quantity || quantity->type != Type::text) return {};
    const auto table = Table::parse("count() group by " + quantity->expression);
    if (!table) return {};
    const auto rows = table->evaluate(paths);
    if (!rows) return {};
    std::vector<std::pair<double, std::string>> found;
    const auto key = std::find_if(rows->columns.begin(), rows->columns.end(), [](const TableColumn& c) { return c.key; });
    const auto count = std::find_if(rows->columns.begin(), rows->columns.end(), [](const TableColumn& c) { return !c.key; });
    if (key == rows->columns.end() || count == rows->columns.end() || key->values.texts.empty()) return {};
    for (std::size_t row = 0; row < rows->rowCount; ++row)
        if (key->values.known[row]) found.emplace_back(count->values.numbers[row], key->values.texts[row]);
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    if (found.size() > maximum) found.resize(maximum);
    std::vector<std::string> texts;
    for (auto& [times, value] : found) texts.push_back(std::move(value));
    return texts;
}

std::vector<FunctionName> functionNames() {
    std::vector<FunctionName> names;
    for (const Function& f : functions()) names.push_back({f.name, f.minimumArguments, f.maximumArguments, f.meaning});
    return names;
}

}  // namespace emca::query
