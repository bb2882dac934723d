#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emca/query/query.h"

namespace emca::query {

enum class TokenKind : std::uint8_t {
    end, number, name, quotedName, text, symbol  // a quoted name stands in backquotes, a text in quotes
};

struct Token {
    TokenKind kind = TokenKind::end;
    SourceRange where;
    std::string text;      ///< of a name or text: without quotes and escapes; of a symbol: itself
    double number = 0;

    bool is(std::string_view symbol) const { return kind == TokenKind::symbol && text == symbol; }
    bool isWord(std::string_view word) const { return kind == TokenKind::name && text == word; }
};

/// Splits a query; the last token is `end`. False: `error` says what is wrong, and where.
bool tokenize(std::string_view query, std::vector<Token>& tokens, QueryError& error);

/// How a token is named in an error, e.g. "the number 3" or "the end of the query".
std::string describe(const Token& token);

}  // namespace emca::query
