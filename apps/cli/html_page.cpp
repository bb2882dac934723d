#include "html_page.h"

#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "html_sources.h"

namespace emca::cli {
namespace {

std::vector<std::byte> fromHex(std::string_view hex) {
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::byte>(std::strtoul(std::string(hex.substr(i, 2)).c_str(), nullptr, 16)));
    return bytes;
}

/// As policies name what they allow.
std::string hashSource(std::string_view sha256) { return "'sha256-" + toBase64(fromHex(sha256)) + "'"; }

std::string_view valueOf(std::string_view name, const std::vector<std::pair<std::string_view, std::string>>& values) {
    for (const auto& [key, value] : values)
        if (key == name) return value;
    return {};
}

/// The template with each {{name}} replaced. What is put in is not searched: it may hold anything.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string out;
    for (;;) {
        const std::size_t begin = text.find("{{");
        out += text.substr(0, begin);
        if (begin == std::string_view::npos) return out;
        const std::size_t end = text.find("}}", begin);
        out += valueOf(text.substr(begin + 2, end - begin - 2), values);
        text.remove_prefix(end + 2);
    }
}

}  // namespace

std::string toBase64(std::span<const std::byte> bytes) {
    constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kLetters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

std::string escapeHtml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '<') out += "&lt;";
        else if (c == '>') out += "&gt;";
        else if (c == '&') out += "&amp;";
        else if (c == '"') out += "&quot;";
        else if (c == '\'') out += "&#39;";
        else if (static_cast<unsigned char>(c) < 32 || c == 127) out += "\uFFFD";
        else out += c;
    }
    return out;
}

std::string scriptJson(const Json& data) {
    const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        if (c == '<') out += "\\u003c";
        else out += c;
    }
    return out;
}

std::string htmlPage(const std::string& title, const Json& data) {
    const std::string script = hashSource(kPageScriptSha256), style = hashSource(kPageStyleSha256);
    return filled(kPageTemplate,
                  {{"title", escapeHtml(title)},
                   {"policy", escapeHtml("default-src 'none'; script-src " + script + "; style-src " + style + "; img-src data:; base-uri 'none'; form-action 'none'")},
                   {"style", std::string(kPageStyle)},
                   {"script", std::string(kPageScript)},
                   {"data", scriptJson(data)}});
}

}  // namespace emca::cli
