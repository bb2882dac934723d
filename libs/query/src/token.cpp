#include "token.h"

#include <charconv>

namespace emca::query {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
/// Bytes beyond ASCII are letters: names may be in any script, in UTF-8.
bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}
bool isEscaped(char c) { return c == '\\' || c == '"' || c == '\'' || c == '`'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Bytes of the character of UTF-8 at the begin of `text`; 0 if there is none.
std::size_t characterSize(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t size = first < 0x80 ? 1 : first >= 0xc2 && first < 0xe0 ? 2 : first >= 0xe0 && first < 0xf0 ? 3 : first >= 0xf0 && first < 0xf5 ? 4 : 0;
    if (size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    // Longer than needed, surrogates, beyond Unicode.
    const bool wrong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0) || (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90);
    return wrong ? 0 : size;
}

/// Errors repeat pieces of the query, and go into JSON.
bool isUtf8(std::string_view text, QueryError& error) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t size = text[i] == '\0' ? 0 : characterSize(text.substr(i));
        if (size == 0) {
            error = {"This byte is no text in UTF-8", {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i)}};
            return false;
        }
        i += size;
    }
    return true;
}

class Tokenizer {
  public:
    Tokenizer(std::string_view query, std::vector<Token>& tokens, QueryError& error)
        : query_(query), tokens_(tokens), error_(error) {}

    bool run() {
        while (true) {
            while (at_ < query_.size() && isBlank(query_[at_])) ++at_;
            if (at_ == query_.size()) break;
            if (!next()) return false;
        }
        add(TokenKind::end, at_, {});
        return true;
    }

  private:
    bool next() {
        const char c = query_[at_];
        if (isDigit(c) || (c == '.' && at_ + 1 < query_.size() && isDigit(query_[at_ + 1]))) return number();
        if (isLetter(c)) return name();
        if (c == '"' || c == '\'') return quoted(c, TokenKind::text, "This text is");
        if (c == '`') return quoted(c, TokenKind::quotedName, "This name is");
        return symbol();
    }

    bool number() {
        const std::size_t begin = at_;
        double value = 0;
        const auto [end, code] = std::from_chars(query_.data() + at_, query_.data() + query_.size(), value);
        at_ = static_cast<std::size_t>(end - query_.data());
        if (code != std::errc()) return fail(begin, "This number is beyond what double precision holds");
        if (at_ < query_.size() && isLetter(query_[at_])) {
            return fail(begin, "A number is followed by a letter: put an operator or a blank between them");
        }
        add(TokenKind::number, begin, std::string(query_.substr(begin, at_ - begin)));
        tokens_.back().number = value;
        return true;
    }

    bool name() {
        const std::size_t begin = at_;
        while (at_ < query_.size() && (isLetter(query_[at_]) || isDigit(query_[at_]))) ++at_;
        add(TokenKind::name, begin, std::string(query_.substr(begin, at_ - begin)));
        return true;
    }

    bool quoted(char quote, TokenKind kind, const char* what) {
        const std::size_t begin = at_++;
        std::string text;
        while (at_ < query_.size() && query_[at_] != quote) {
            // Other backslashes stay: "\d" in a regular expression is written as everywhere.
            if (query_[at_] == '\\' && at_ + 1 < query_.size() && isEscaped(query_[at_ + 1])) ++at_;
            text += query_[at_++];
        }
        if (at_ == query_.size()) return fail(begin, std::string(what) + " not closed: expected " + quote + " at its end");
        ++at_;
        add(kind, begin, std::move(text));
        return true;
    }

    bool symbol() {
        static constexpr std::string_view kSymbols[] = {"==", "!=", "<=", ">=", "&&", "||", "<", ">", "+", "-", "*", "/",
                                                        "%",  "^",  "(",  ")",  "[",  "]",  ",", ".", "!"};
        for (const std::string_view symbol : kSymbols) {
            if (query_.substr(at_, symbol.size()) != symbol) continue;
            at_ += symbol.size();
            add(TokenKind::symbol, at_ - symbol.size(), std::string(symbol));
            return true;
        }
        const std::size_t begin = at_++;
        if (query_[begin] == '=') return fail(begin, "A single = means nothing here: expected ==");
        return fail(begin, std::string("The character ") + query_[begin] + " has no meaning here");
    }

    void add(TokenKind kind, std::size_t begin, std::string text) {
        tokens_.push_back({kind, {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at_)}, std::move(text), 0});
    }

    bool fail(std::size_t begin, std::string message) {
        error_ = {std::move(message), {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at_)}};
        return false;
    }

    std::string_view query_;
    std::vector<Token>& tokens_;
    QueryError& error_;
    std::size_t at_ = 0;
};

}  // namespace

bool tokenize(std::string_view query, std::vector<Token>& tokens, QueryError& error) {
    return isUtf8(query, error) && Tokenizer(query, tokens, error).run();
}

std::string describe(const Token& token) {
    switch (token.kind) {
        case TokenKind::end: return "the end of the query";
        case TokenKind::number: return "the number " + token.text;
        case TokenKind::name: return "the name " + token.text;
        case TokenKind::quotedName: return "the name `" + token.text + "`";
        case TokenKind::text: return "the text \"" + token.text + "\"";
        case TokenKind::symbol: break;
    }
    return "the sign " + token.text;
}

}  // namespace emca::query
