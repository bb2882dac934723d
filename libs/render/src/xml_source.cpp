#include "xml_source.h"

#include <algorithm>

#include "file_bytes.h"
#include "text_numbers.h"

namespace emca::render {

namespace {

// A parsed document takes some five times the size of its text.
constexpr std::uint64_t kMaxSceneFileBytes = std::uint64_t(512) << 20;

}  // namespace

Result<std::unique_ptr<XmlSource>> XmlSource::readFile(const std::filesystem::path& path) {
    auto bytes = readFileBytes(path, kMaxSceneFileBytes);
    if (!bytes)
        return Error{bytes.error().code, "The scene cannot be read: " + bytes.error().message};
    return parse(std::move(*bytes), path);
}

Result<std::unique_ptr<XmlSource>> XmlSource::parse(std::string text, const std::filesystem::path& path) {
    std::unique_ptr<XmlSource> source(new XmlSource(std::move(text), path));
    std::string& content = source->text_;
    source->lineStarts_.push_back(0);
    for (std::size_t i = content.find('\n'); i != content.npos; i = content.find('\n', i + 1))
        source->lineStarts_.push_back(static_cast<std::ptrdiff_t>(i) + 1);

    const pugi::xml_parse_result result =
        source->document_.load_buffer_inplace(content.data(), content.size(), pugi::parse_default | pugi::parse_fragment);
    if (!result) {
        const int line = source->lineAt(result.offset);
        const auto column = result.offset - source->lineStarts_[static_cast<std::size_t>(line - 1)] + 1;
        return Error{result.status == pugi::status_out_of_memory ? ErrorCode::outOfMemory : ErrorCode::parseFailed,
                     path.string() + ":" + std::to_string(line) + ": not well-formed XML: " + result.description() +
                         " (column " + std::to_string(column) + ")."};
    }
    if (!source->root())
        return Error{ErrorCode::parseFailed, path.string() + ":1: not a scene: no XML element found."};
    return source;
}

SourceLocation XmlSource::locate(pugi::xml_node node) const {
    const std::string_view text = node.type() == pugi::node_element ? "" : node.value();
    const auto blanks = std::find_if_not(text.begin(), text.end(), isBlank) - text.begin();
    return {path_.string(), lineAt(node.offset_debug() + blanks)};
}

int XmlSource::lineAt(std::ptrdiff_t offset) const {
    // Text that was not UTF-8 is parsed in a converted copy: its offsets may lie beyond the lines of the file.
    const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), std::max<std::ptrdiff_t>(offset, 0));
    return static_cast<int>(after - lineStarts_.begin());
}

const std::string* SceneElement::find(std::string_view name) const {
    for (const auto& attribute : attributes_) {
        if (attribute.name == name) {
            attribute.used = true;
            return &attribute.value;
        }
    }
    return nullptr;
}

std::string SceneElement::get(std::string_view name) const {
    const std::string* value = find(name);
    return value ? *value : std::string();
}

void SceneElement::dismiss() const {
    for (const auto& attribute : attributes_)
        attribute.used = true;
}

std::vector<std::string> SceneElement::unused() const {
    std::vector<std::string> names;
    for (const auto& attribute : attributes_)
        if (!attribute.used)
            names.push_back(attribute.name);
    return names;
}

}  // namespace emca::render
