#include "emca/render/property_reader.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "emca/render/diagnostics.h"

namespace emca::render {

namespace {

bool isGrey(Color c) { return c.r == c.g && c.g == c.b; }

std::string inQuotes(std::string_view text) { return '"' + std::string(text) + '"'; }

}  // namespace

const char* typeName(const Property& property) {
    static constexpr const char* kNames[] = {"a boolean", "an integer", "a float", "a string",
                                             "a point or vector", "a colour", "a transform"};
    return kNames[property.index()];
}

PropertyReader::PropertyReader(const SceneNode& node, std::vector<Diagnostic>& diagnostics,
                               std::span<const std::filesystem::path> searchFolders)
    : node_(node), diagnostics_(diagnostics), searchFolders_(searchFolders) {}

bool PropertyReader::hasProperty(std::string_view name) const { return node_.properties.contains(std::string(name)); }

bool PropertyReader::hasChild(std::string_view name) const {
    return std::any_of(node_.children.begin(), node_.children.end(), [&](const auto& c) { return c.name == name; });
}

const SceneNode::Entry* PropertyReader::find(std::string_view name) {
    const auto found = node_.properties.find(std::string(name));
    if (found == node_.properties.end())
        return nullptr;
    found->second.used = true;
    return &found->second;
}

void PropertyReader::wrongType(std::string_view name, const SceneNode::Entry& entry, std::string_view wanted) {
    reportProperty(name, std::string("is ") + typeName(entry.value) + ", but " + std::string(wanted) +
                             " is expected; it is ignored");
}

std::optional<double> PropertyReader::number(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<double>(&entry->value))
        return *value;
    if (const auto* value = std::get_if<std::int64_t>(&entry->value))
        return static_cast<double>(*value);
    if (const auto* value = std::get_if<Color>(&entry->value); value && isGrey(*value))
        return static_cast<double>(value->r);
    wrongType(name, *entry, "a float");
    return {};
}

std::optional<std::int64_t> PropertyReader::integer(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<std::int64_t>(&entry->value))
        return *value;
    // Beyond 2^53 not every integer is a double, so that rounding would be silent.
    if (const auto* value = std::get_if<double>(&entry->value);
        value && std::abs(*value) <= 9007199254740992.0 && *value == std::floor(*value))
        return static_cast<std::int64_t>(*value);
    wrongType(name, *entry, "an integer");
    return {};
}

std::optional<bool> PropertyReader::flag(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<bool>(&entry->value))
        return *value;
    wrongType(name, *entry, "a boolean");
    return {};
}

std::optional<std::string> PropertyReader::text(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<std::string>(&entry->value))
        return *value;
    wrongType(name, *entry, "a string");
    return {};
}

std::optional<Color> PropertyReader::color(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<Color>(&entry->value))
        return *value;
    if (const auto* value = std::get_if<double>(&entry->value))
        return Color(static_cast<float>(*value));
    if (const auto* value = std::get_if<std::int64_t>(&entry->value))
        return Color(static_cast<float>(*value));
    wrongType(name, *entry, "a colour");
    return {};
}

std::optional<Vec3f> PropertyReader::vector(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<Vec3f>(&entry->value))
        return *value;
    wrongType(name, *entry, "a point or vector");
    return {};
}

std::optional<Transform> PropertyReader::transform(std::string_view name) {
    const auto* entry = find(name);
    if (!entry)
        return {};
    if (const auto* value = std::get_if<Transform>(&entry->value))
        return *value;
    wrongType(name, *entry, "a transform");
    return {};
}

std::optional<PropertyReader::File> PropertyReader::file(std::string_view name) {
    const auto written = text(name);
    if (!written)
        return {};
    const std::filesystem::path path(*written);
    if (path.is_absolute())
        return File{*written, path};
    const auto besideXml = std::filesystem::path(where(name).file).parent_path() / path;
    std::error_code ignored;
    if (std::filesystem::exists(besideXml, ignored))
        return File{*written, besideXml};
    for (const auto& folder : searchFolders_)
        if (std::filesystem::exists(folder / path, ignored))
            return File{*written, folder / path};
    return File{*written, besideXml};
}

std::shared_ptr<const SceneNode> PropertyReader::child(std::string_view name) {
    std::shared_ptr<const SceneNode> found;
    for (const auto& child : node_.children) {
        if (child.name != name)
            continue;
        child.used = true;
        found = child.node;
    }
    return found;
}

std::vector<std::shared_ptr<const SceneNode>> PropertyReader::childrenOfKind(std::string_view kind) {
    std::vector<std::shared_ptr<const SceneNode>> found;
    for (const auto& child : node_.children) {
        if (child.node->kind != kind)
            continue;
        child.used = true;
        found.push_back(child.node);
    }
    return found;
}

std::shared_ptr<const SceneNode> PropertyReader::firstOfKind(std::string_view kind) {
    for (const auto& child : node_.children) {
        if (child.node->kind == kind) {
            child.used = true;
            return child.node;
        }
    }
    return nullptr;
}

const std::vector<SceneNode::Child>& PropertyReader::allChildren() {
    for (const auto& child : node_.children)
        child.used = true;
    return node_.children;
}

void PropertyReader::ignore(std::string_view name) {
    find(name);
    child(name);
}

SourceLocation PropertyReader::where(std::string_view name) const {
    if (const auto found = node_.properties.find(std::string(name)); found != node_.properties.end())
        return found->second.where;
    for (const auto& child : node_.children)
        if (child.name == name)
            return child.where;
    return node_.where;
}

void PropertyReader::report(std::string message) { add(node_.where, std::move(message)); }

void PropertyReader::reportAt(std::string_view name, std::string message) { add(where(name), std::move(message)); }

void PropertyReader::reportProperty(std::string_view name, std::string_view what) {
    reportAt(name, "property " + inQuotes(name) + " of " + description() + " " + std::string(what));
}

int PropertyReader::reportUnused() {
    int count = 0;
    for (const auto& [name, entry] : node_.properties) {
        if (entry.used)
            continue;
        add(entry.where, "property " + inQuotes(name) + " of " + description() + " is not known and ignored");
        ++count;
    }
    for (const auto& child : node_.children) {
        if (child.used)
            continue;
        const std::string role = child.name.empty() ? "" : " as " + inQuotes(child.name);
        add(child.where, child.node->kind + " " + inQuotes(child.node->type) + " in " + description() + role +
                             " is not known there and ignored");
        ++count;
    }
    return count;
}

std::string PropertyReader::description() const {
    return node_.kind + " " + inQuotes(node_.type) + (node_.id.empty() ? "" : " (" + node_.id + ")");
}

void PropertyReader::add(SourceLocation where, std::string message) {
    addDiagnostic(diagnostics_, std::move(where), std::move(message));
}

}  // namespace emca::render
