#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace emca::render {

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back()))
        text.remove_suffix(1);
    return text;
}

/// A finite number that fills the text up to blanks around it, whatever the locale. Nothing for anything else.
template <typename T>
std::optional<T> parseNumber(std::string_view text) {
    text = trimmed(text);
    if (text.size() > 1 && text.front() == '+' && text[1] != '-')
        text.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return {};
    if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value))
            return {};
    }
    return value;
}

/// The parts of a text between blanks, commas and `more`; no empty ones.
inline std::vector<std::string_view> splitList(std::string_view text, char more = ',') {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && !isBlank(text[i]) && text[i] != ',' && text[i] != more)
            continue;
        if (i > begin)
            parts.push_back(text.substr(begin, i - begin));
        begin = i + 1;
    }
    return parts;
}

/// All numbers of a list; nothing if one of them is none or not finite.
inline std::optional<std::vector<double>> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    for (const auto part : splitList(text)) {
        const auto number = parseNumber<double>(part);
        if (!number)
            return {};
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace emca::render
