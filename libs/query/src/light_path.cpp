// Light path expressions as regular expressions over bytes. Sources: P. Heckbert, "Adaptive radiosity textures for
// bidirectional ray tracing", SIGGRAPH 1990, section 3; Open Shading Language specification, "Light path expressions".
#include "light_path.h"

#include <algorithm>
#include <bitset>

#include "patterns.h"

namespace emca::query::detail {

namespace {

constexpr std::size_t kFirstEvent = 5, kEvents = 3, kLobes = 5;
constexpr std::string_view kEventLetters = "RTV", kLobeLetters = "DGSs";

using Symbols = std::bitset<256>;

std::size_t symbolOf(std::size_t event, std::size_t lobe, std::size_t label) {
    return kFirstEvent + (label * kEvents + event) * kLobes + lobe;
}

/// Translates an expression to the syntax of RE2.
class Translator {
  public:
    Translator(std::string_view text, std::uint32_t begin, QueryError& error) : text_(text), begin_(begin), error_(error) {}

    bool run() {
        findLabels();
        if (labels.size() > LightPathExpression::kMaximumLabels) return fail("There are more than 15 labels");
        if (!alternatives()) return false;
        return at_ == text_.size() ? true : fail("Expected an event, found ) without (");
    }

    std::string pattern;
    std::vector<std::string> labels;

  private:
    bool fail(std::string message) {
        // The expression stands in quotes; escapes inside it would shift this a little.
        const auto place = static_cast<std::uint32_t>(begin_ + 1 + std::min(at_, text_.size()));
        error_ = {"In the light path expression: " + std::move(message), {place, place + (at_ < text_.size() ? static_cast<std::uint32_t>(found().size()) : 1)}};
        return false;
    }

    void findLabels() {
        std::size_t from = 0;
        while ((from = text_.find('\'', from)) != text_.npos) {
            const std::size_t end = text_.find('\'', from + 1);
            if (end == text_.npos) return;
            const std::string label(text_.substr(from + 1, end - from - 1));
            if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
            from = end + 1;
        }
    }

    void skipBlanks() { while (at_ < text_.size() && text_[at_] == ' ') ++at_; }
    char next() { skipBlanks(); return at_ < text_.size() ? text_[at_] : '\0'; }

    /// The character that comes next, in UTF-8.
    std::string found() const {
        if (at_ >= text_.size()) return "the end";
        std::size_t end = at_ + 1;
        while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xc0) == 0x80) ++end;
        return std::string(text_.substr(at_, end - at_));
    }

    bool alternatives() {
        if (++depth_ > 100) return fail("parentheses are nested too deeply");
        while (true) {
            while (next() != '\0' && next() != '|' && next() != ')') {
                if (!repeated()) return false;
            }
            if (next() != '|') break;
            ++at_;
            pattern += '|';
        }
        --depth_;
        return true;
    }

    bool repeated() {
        if (!atom()) return false;
        const char c = next();
        if (c == '*' || c == '+' || c == '?') {
            ++at_;
            pattern += c;
        } else if (c == '{') {
            return counts();
        }
        return true;
    }

    bool counts() {
        const std::size_t end = text_.find('}', at_);
        if (end == text_.npos) return fail("expected } to close {");
        std::string inside;
        for (const char c : text_.substr(at_ + 1, end - at_ - 1))
            if (c != ' ') inside += c;
        static const re2::RE2 valid("[0-9]{1,3}(,[0-9]{0,3})?");
        if (!re2::RE2::FullMatch(inside, valid)) return fail("expected a count such as {2}, {2,} or {2,4}");
        pattern += "{" + inside + "}";
        at_ = end + 1;
        return true;
    }

    bool atom() {
        if (next() == '(') {
            ++at_;
            pattern += "(?:";
            if (!alternatives()) return false;
            if (next() != ')') return fail("expected ) to close (");
            ++at_;
            pattern += ')';
            return true;
        }
        Symbols symbols;
        if (!oneEvent(symbols)) return false;
        write(symbols);
        return true;
    }

    bool oneEvent(Symbols& symbols) {
        const char c = next();
        if (c == '[') return set(symbols);
        if (c == '<') return event(symbols);
        if (!letter(c, symbols)) return fail("expected an event such as D, <RS>, [DG] or L, found " + found());
        ++at_;
        return true;
    }

    bool letter(char c, Symbols& symbols) const {
        if (c == '.') {
            symbols = everything();
        } else if (c == 'C') {
            symbols.set(LightPathExpression::kCamera);
        } else if (c == 'L') {
            for (const char end : {LightPathExpression::kLight, LightPathExpression::kSurface, LightPathExpression::kEnvironment})
                symbols.set(static_cast<std::size_t>(end));
        } else if (c == 'O') {
            symbols.set(LightPathExpression::kSurface);
        } else if (c == 'B') {
            symbols.set(LightPathExpression::kEnvironment);
        } else if (const std::size_t event = kEventLetters.find(c); event != kEventLetters.npos) {
            addEvents(symbols, [&](std::size_t e, std::size_t, std::size_t) { return e == event; });
        } else if (const std::size_t lobe = kLobeLetters.find(c); lobe != kLobeLetters.npos) {
            addEvents(symbols, [&](std::size_t, std::size_t l, std::size_t) { return l == lobe + 1; });
        } else {
            return false;
        }
        return true;
    }

    template <typename Wanted>
    void addEvents(Symbols& symbols, Wanted wanted) const {
        for (std::size_t label = 0; label <= labels.size(); ++label)
            for (std::size_t event = 0; event < kEvents; ++event)
                for (std::size_t lobe = 0; lobe < kLobes; ++lobe)
                    if (wanted(event, lobe, label)) symbols.set(symbolOf(event, lobe, label));
    }

    /// Anything after the camera.
    Symbols everything() const {
        Symbols all;
        addEvents(all, [](std::size_t, std::size_t, std::size_t) { return true; });
        letter('L', all);
        return all;
    }

    bool set(Symbols& symbols) {
        ++at_;
        const bool others = next() == '^';
        if (others) ++at_;
        while (next() != ']') {
            if (next() == '\0') return fail("expected ] to close [");
            if (next() == '[') return fail("a set inside a set: write its members");
            Symbols member;
            if (!oneEvent(member)) return false;
            symbols |= member;
        }
        ++at_;
        if (others) symbols = everything() & ~symbols;
        return true;
    }

    /// One of the letters at a place of < >, or a set of them, as bits; a dot for all.
    bool choice(std::string_view letters, std::uint32_t& bits, const char* what) {
        const auto one = [&](char c) {
            const std::size_t place = letters.find(c);
            if (place == letters.npos) return fail(std::string("expected ") + what + ", found " + found());
            bits |= 1u << place;
            ++at_;
            return true;
        };
        bits = 0;
        if (next() == '.') {
            ++at_;
            bits = ~0u;
            return true;
        }
        if (next() != '[') return one(next());
        ++at_;
        const bool others = next() == '^';
        if (others) ++at_;
        while (next() != ']')
            if (!one(next())) return false;
        ++at_;
        if (others) bits = ~bits;
        return true;
    }

    bool event(Symbols& symbols) {
        ++at_;
        std::uint32_t events = ~0u, lobes = ~0u;
        if (!choice(kEventLetters, events, "R, T, V or . after <")) return false;
        if (next() != '>' && next() != '\'' && !choice(kLobeLetters, lobes, "D, G, S, s or . as the second letter")) return false;
        std::size_t wanted = 0;
        if (next() == '\'') {
            const std::size_t end = text_.find('\'', at_ + 1);
            if (end == text_.npos) return fail("expected ' to close the label");
            const auto label = std::find(labels.begin(), labels.end(), text_.substr(at_ + 1, end - at_ - 1));
            wanted = static_cast<std::size_t>(label - labels.begin()) + 1;
            at_ = end + 1;
        }
        if (next() != '>') return fail("expected > to close <");
        ++at_;
        addEvents(symbols, [&](std::size_t e, std::size_t l, std::size_t label) {
            const bool lobeFits = l == 0 ? lobes == ~0u : (lobes >> (l - 1) & 1u) != 0;
            return (events >> e & 1u) != 0 && lobeFits && (wanted == 0 || wanted == label);
        });
        return true;
    }

    void write(const Symbols& symbols) {
        static constexpr char kHex[] = "0123456789abcdef";
        pattern += symbols.none() ? "[^\\x00-\\xff" : "[";
        const auto byte = [&](std::size_t i) { pattern += {'\\', 'x', kHex[i >> 4], kHex[i & 15]}; };
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            if (!symbols.test(i)) continue;
            byte(i);
            std::size_t last = i;
            while (last + 1 < symbols.size() && symbols.test(last + 1)) ++last;
            if (last > i) {
                pattern += '-';
                byte(last);
            }
            i = last;
        }
        pattern += ']';
    }

    std::string_view text_;
    std::uint32_t begin_;
    QueryError& error_;
    std::size_t at_ = 0, depth_ = 0;
};

re2::RE2::Options options() {
    re2::RE2::Options options = patternOptions();
    options.set_encoding(re2::RE2::Options::EncodingLatin1);
    return options;
}

}  // namespace

LightPathExpression::~LightPathExpression() = default;

std::size_t LightPathExpression::symbolCount() const { return symbolOf(0, 0, labels_.size() + 1); }

int LightPathExpression::programSize() const { return expression_->ProgramSize(); }

std::shared_ptr<const LightPathExpression> LightPathExpression::parse(std::string_view text, std::uint32_t begin, QueryError& error) {
    if (text.size() > kMaximumLength) {
        error = {"The light path expression is longer than " + std::to_string(kMaximumLength) + " characters", {begin, begin + static_cast<std::uint32_t>(text.size()) + 2}};
        return nullptr;
    }
    Translator translator(text, begin, error);
    if (!translator.run()) return nullptr;
    std::shared_ptr<LightPathExpression> result(new LightPathExpression);
    result->expression_ = std::make_unique<re2::RE2>(translator.pattern, options());
    if (!result->expression_->ok()) {
        error = {"The light path expression is too large: use fewer or smaller repetitions", {begin, begin + static_cast<std::uint32_t>(text.size()) + 2}};
        return nullptr;
    }
    result->labels_ = std::move(translator.labels);
    return result;
}

char LightPathExpression::symbol(Event event, Lobe lobe, std::size_t labelClass) const {
    switch (event) {
        case Event::reflect: return static_cast<char>(symbolOf(0, static_cast<std::size_t>(lobe), labelClass));
        case Event::transmit: return static_cast<char>(symbolOf(1, static_cast<std::size_t>(lobe), labelClass));
        case Event::volume: return static_cast<char>(symbolOf(2, static_cast<std::size_t>(lobe), labelClass));
        case Event::pass: return static_cast<char>(symbolOf(1, static_cast<std::size_t>(Lobe::straight), labelClass));
        default: return 0;
    }
}

LightPathExpression::Ways LightPathExpression::takeWays() const {
    const std::lock_guard lock(waysMutex_);
    if (ways_.empty()) return {};
    Ways ways = std::move(ways_.back());
    ways_.pop_back();
    return ways;
}

void LightPathExpression::giveBack(Ways ways) const {
    constexpr std::size_t kMostKept = 64, kMostEntries = 1 << 18;  // as many as threads; 1 MiB
    if (ways.next.size() > kMostEntries) return;
    const std::lock_guard lock(waysMutex_);
    if (ways_.size() < kMostKept) ways_.push_back(std::move(ways));
}

bool LightPathExpression::matches(std::string_view path) const {
    return re2::RE2::FullMatch(re2::StringPiece(path.data(), path.size()), *expression_);
}

}  // namespace emca::query::detail
