#include "ply_header.h"

#include <algorithm>

#include "text_numbers.h"

namespace emca::render {

namespace {

std::optional<PlyType> plyType(std::string_view name) {
    struct Name { std::string_view name; PlyType type; };
    static constexpr Name kNames[] = {
        {"char", PlyType::int8},     {"int8", PlyType::int8},       {"uchar", PlyType::uint8},    {"uint8", PlyType::uint8},
        {"short", PlyType::int16},   {"int16", PlyType::int16},     {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},
        {"int", PlyType::int32},     {"int32", PlyType::int32},     {"uint", PlyType::uint32},    {"uint32", PlyType::uint32},
        {"float", PlyType::float32}, {"float32", PlyType::float32}, {"double", PlyType::float64}, {"float64", PlyType::float64}};
    for (const auto& [known, type] : kNames)
        if (known == name)
            return type;
    return {};
}

std::optional<PlyFormat> plyFormat(std::string_view name) {
    if (name == "ascii")
        return PlyFormat::ascii;
    if (name == "binary_little_endian")
        return PlyFormat::littleEndian;
    if (name == "binary_big_endian")
        return PlyFormat::bigEndian;
    return {};
}

std::optional<PlyProperty> readProperty(const std::vector<std::string_view>& words) {
    PlyProperty property;
    const bool list = words.size() == 5 && words[1] == "list";
    const auto type = words.size() == 3 || list ? plyType(words[list ? 3 : 1]) : std::nullopt;
    const auto countType = list ? plyType(words[2]) : PlyType::uint8;
    if (!type || !countType || *countType == PlyType::float32 || *countType == PlyType::float64)
        return {};
    return PlyProperty{std::string(words.back()), *type, list, *countType};
}

/// The fewest bytes that one element can take; a list may be empty.
std::uint64_t smallestSize(const PlyElement& element, PlyFormat format) {
    std::uint64_t size = 0;
    for (const auto& property : element.properties)
        size += format == PlyFormat::ascii ? 2 : plySize(property.isList ? property.countType : property.type);
    return size;
}

}  // namespace

std::size_t plySize(PlyType type) {
    static constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (const auto wanted : names)
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (properties[i].name == wanted)
                return static_cast<int>(i);
    return -1;
}

Result<PlyHeader> readPlyHeader(std::string_view file, const std::filesystem::path& path) {
    PlyHeader header;
    std::size_t at = 0;
    bool formatSeen = false;
    const auto failure = [&](std::size_t line, const std::string& what) {
        return Error{ErrorCode::fileUnreadable, path.string() + ":" + std::to_string(line) + ": " + what + '.'};
    };
    for (std::size_t line = 1;; ++line) {
        const auto end = file.find('\n', at);
        if (end == file.npos)
            return failure(line, line == 1 ? "not a PLY file" : "the header of the PLY file has no end_header");
        const std::string_view text = trimmed(file.substr(at, end - at));
        const auto words = splitList(text, ' ');
        at = end + 1;
        if (line == 1) {
            if (text != "ply")
                return failure(line, "not a PLY file: it does not begin with \"ply\"");
        } else if (text == "end_header") {
            break;
        } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
            continue;
        } else if (words[0] == "format" && words.size() >= 2 && plyFormat(words[1])) {
            header.format = *plyFormat(words[1]);
            formatSeen = true;
        } else if (words[0] == "element" && words.size() == 3 && parseNumber<std::uint64_t>(words[2])) {
            header.elements.push_back({std::string(words[1]), *parseNumber<std::uint64_t>(words[2]), {}});
        } else if (words[0] == "property" && !header.elements.empty() && readProperty(words)) {
            header.elements.back().properties.push_back(*readProperty(words));
        } else {
            return failure(line, "not understood in the header of a PLY file: \"" + std::string(text.substr(0, 60)) + '"');
        }
    }
    if (!formatSeen)
        return failure(1, "the header of the PLY file names no format");
    header.dataBegin = at;
    std::uint64_t left = file.size() - at + 1;  // the last line of text may lack its end
    for (const auto& element : header.elements) {
        const std::uint64_t size = smallestSize(element, header.format);
        if (size > 0 && element.count > left / size)
            return failure(1, "the header announces " + std::to_string(element.count) + " of \"" + element.name +
                                  "\", more than the " + std::to_string(file.size() - at) + " bytes after it can hold");
        left -= size * element.count;
    }
    return header;
}

}  // namespace emca::render
