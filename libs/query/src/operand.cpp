#include "operand.h"

#include "syntax.h"

namespace emca::query::detail {
namespace {

bool isBlank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

/// Whether an operator of a node binds as weakly as a comparison, or weaker.
bool bindsWeakly(const Node& node) {
    if (node.kind != Kind::operation) return false;
    return (node.op >= Op::less && node.op <= Op::in) || node.op == Op::invert;
}

}  // namespace

Result<std::string> operand(std::string_view text) {
    while (!text.empty() && isBlank(text.substr(0, 1))) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.substr(text.size() - 1))) text.remove_suffix(1);
    Node root;
    QueryError error;
    if (!parseExpression(text, root, error)) return toError(text, error);
    return bindsWeakly(root) ? "(" + std::string(text) + ")" : std::string(text);
}

}  // namespace emca::query::detail
