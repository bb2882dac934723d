#include "table.h"

#include <algorithm>

namespace emca::cli {
namespace {

std::size_t width(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

std::string Table::text() const {
    std::vector<std::vector<std::string>> lines(1);
    for (const Column& column : columns_) lines[0].push_back(column.header);
    for (const auto& row : rows_) {
        lines.emplace_back();
        for (const std::string& cell : row) lines.back().push_back(printable(cell));
    }
    std::vector<std::size_t> widths(columns_.size(), 0);
    for (const auto& line : lines)
        for (std::size_t c = 0; c < widths.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));

    std::string text;
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < widths.size(); ++c) {
            const std::string padding(widths[c] - width(line[c]), ' ');
            if (c > 0) text += "  ";
            text += columns_[c].align == Align::left ? line[c] + padding : padding + line[c];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

}  // namespace emca::cli
