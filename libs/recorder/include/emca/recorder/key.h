#pragma once

#include <cstddef>
#include <cstdint>
#include <source_location>
#include <string>
#include <string_view>
#include <type_traits>

namespace emca {

/// Hash of a key's text. Source: FNV-1a, 64 bits.
constexpr std::uint64_t hashKey(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return hash;
}

/// Where a call stands.
struct SourceLine {
    const char* file = "";   ///< not copied: a literal
    std::uint32_t line = 0;
    constexpr SourceLine() = default;
    constexpr SourceLine(const char* sourceFile, std::uint32_t sourceLine) : file(sourceFile), line(sourceLine) {}
    constexpr SourceLine(std::source_location where) : file(where.file_name()), line(where.line()) {}
};

/// Name of a recorded quantity. A literal's hash and source line are known at compile time, so that a key of any
/// length costs the same; a key made at run time (string_view, string) is hashed when it is built, even while nothing
/// is recorded: prefer literals.
class Key {
  public:
    template <std::size_t N>
    consteval Key(const char (&literal)[N], std::source_location where = std::source_location::current())
        : text_(literal), size_(N - 1), hash_(hashKey({literal, N - 1})), where_(where) {}
    constexpr Key(std::string_view text, std::source_location where = std::source_location::current())
        : text_(text.data()), size_(text.size()), hash_(hashKey(text)), where_(where) {}
    Key(const std::string& text, std::source_location where = std::source_location::current())
        : Key(std::string_view(text), where) {}
    template <typename T>
        requires std::is_same_v<T, const char*> || std::is_same_v<T, char*>
    Key(const T& text, std::source_location where = std::source_location::current())
        : Key(std::string_view(text), where) {}

    /// Of which all is known already: for bindings to other languages. \param hash  hashKey(text)
    constexpr Key(std::string_view text, std::uint64_t hash, SourceLine where)
        : text_(text.data()), size_(text.size()), hash_(hash), where_(where) {}

    constexpr std::string_view text() const { return {text_, size_}; }
    constexpr std::uint64_t hash() const { return hash_; }
    constexpr SourceLine where() const { return where_; }

  private:
    const char* text_;
    std::size_t size_;
    std::uint64_t hash_;
    SourceLine where_;
};

}  // namespace emca
