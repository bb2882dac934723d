#include "scene_reader.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "emca/render/diagnostics.h"
#include "scene_values.h"
#include "text_numbers.h"

namespace emca::render {

namespace {

// A file that includes two others, each of which includes two others, …, needs no circle to go on for ever.
constexpr int kMaxIncludes = 1000;

/// Kind of node that a tag makes, empty if it makes none. Early versions said luminaire and camera.
std::string_view kindOf(std::string_view tag) {
    static constexpr std::array<std::string_view, 14> kKinds = {
        "scene", "shape", "bsdf", "texture", "emitter", "sensor", "film", "sampler", "rfilter", "integrator",
        "medium", "phase", "volume", "subsurface"};
    if (tag == "luminaire")
        return "emitter";
    if (tag == "camera")
        return "sensor";
    const auto found = std::find(kKinds.begin(), kKinds.end(), tag);
    return found == kKinds.end() ? std::string_view() : *found;
}

SpectrumUse spectrumUse(const SceneNode& parent) {
    return parent.kind == "emitter" ? SpectrumUse::light : SpectrumUse::ratio;
}

std::filesystem::path canonicalPath(const std::filesystem::path& path) {
    std::error_code error;
    auto result = std::filesystem::weakly_canonical(path, error);
    return error ? path.lexically_normal() : result;
}

}  // namespace

Result<SceneDocument> SceneReader::read(const XmlSource& source) {
    const SceneElement scene = makeElement(source, source.root());
    if (scene.tag() != "scene")
        return Error{ErrorCode::parseFailed, scene.where().text() + ": not a scene: the outermost element is <" + scene.tag() +
                                                 ">, but <scene> is expected."};
    document_.folder = source.path().parent_path();
    document_.searchFolders.push_back(document_.folder);
    openFiles_.push_back(canonicalPath(source.path()));
    checkVersion(scene);

    const auto root = std::make_shared<SceneNode>();
    root->kind = "scene";
    root->id = scene.get("id");
    root->type = scene.get("type");
    root->where = scene.where();
    references_.addNode(root, document_.diagnostics);
    reportUnknownAttributes(scene);
    readContents(source, source.root(), root, 1);
    references_.resolve(root, document_.diagnostics);
    for (const auto& name : parameters_.unusedDefines())
        report({source.path().string(), 1}, "the value given for $" + name + " changes nothing: " +
                                                (parameters_.hasDefault(name) ? "the scene declares that name but does not use it"
                                                                              : "the scene does not use that name"));
    document_.root = root;
    return std::move(document_);
}

void SceneReader::checkVersion(const SceneElement& scene) {
    const std::string text = scene.get("version");
    const auto parts = splitList(text, '.');
    const auto number = [&](std::size_t i) { return i < parts.size() ? parseNumber<int>(parts[i]) : std::optional<int>(0); };
    const auto major = number(0), minor = number(1);
    if (parts.empty() || !major || !minor)
        report(scene.where(), text.empty() ? "the scene does not say its version; it is read as 3.0"
                                           : "the scene's version \"" + text + "\" is not a version; it is read as 3.0");
    else if ((*major == 0 && *minor < 4) || *major == 1 || *major > 3 || *major < 0)
        report(scene.where(), "scene version " + text + " is not one of 0.4 to 0.6, 2.x and 3.x; it is read as if it were");
    early_ = !parts.empty() && major && *major == 0;
}

void SceneReader::readContents(const XmlSource& source, pugi::xml_node parent, const NodePointer& into, int depth) {
    if (depth > kMaxSceneDepth) {
        report(source.locate(parent), "elements are nested more than " + std::to_string(kMaxSceneDepth) +
                                          " deep; what is inside of this one is ignored");
        return;
    }
    for (const pugi::xml_node xml : parent.children()) {
        if (xml.type() == pugi::node_element)
            readElement(source, xml, into, depth);
        else if (xml.type() == pugi::node_pcdata || xml.type() == pugi::node_cdata)
            report(source.locate(xml), "text between the elements is ignored: \"" +
                                           std::string(trimmed(xml.value()).substr(0, 40)) + '"');
    }
}

void SceneReader::readElement(const XmlSource& source, pugi::xml_node xml, const NodePointer& into, int depth) {
    const SceneElement element = makeElement(source, xml);
    const std::string& tag = element.tag();
    if (tag == "spectrum" && element.find("type"))
        readTypedSpectrum(source, xml, element, into, depth);
    else if (isValueTag(tag))
        readValueProperty(element, *into);
    else if (tag == "transform")
        readTransform(source, xml, element, *into);
    else if (tag == "animation")
        readAnimation(source, xml, element, *into);
    else if (tag == "default")
        readDefault(element);
    else if (tag == "include")
        readInclude(element, into, depth);
    else if (tag == "ref")
        readReference(element, into);
    else if (tag == "alias")
        readAlias(element);
    else if (tag == "path")
        readPath(element);
    else if (!kindOf(tag).empty())
        readObject(source, xml, element, into, depth);
    else
        return report(element.where(), "element <" + tag + "> is not known and ignored, with all that it contains");
    reportUnknownAttributes(element);
}

SceneReader::NodePointer SceneReader::makeNode(const XmlSource& source, pugi::xml_node xml, const SceneElement& element,
                                               int depth) {
    const auto node = std::make_shared<SceneNode>();
    node->kind = kindOf(element.tag()).empty() ? element.tag() : std::string(kindOf(element.tag()));
    node->type = element.get("type");
    node->id = element.get("id");
    node->early = early_;
    node->where = element.where();
    references_.addNode(node, document_.diagnostics);
    readContents(source, xml, node, depth + 1);
    return node;
}

void SceneReader::readObject(const XmlSource& source, pugi::xml_node xml, const SceneElement& element,
                             const NodePointer& into, int depth) {
    const std::string role = toSnakeCase(element.get("name"));
    if (element.get("type").empty()) {
        element.dismiss();
        return report(element.where(), "<" + element.tag() + "> has no attribute \"type\" and is ignored");
    }
    const auto node = makeNode(source, xml, element, depth);
    into->children.push_back({role, node, element.where()});
}

void SceneReader::readTypedSpectrum(const XmlSource& source, pugi::xml_node xml, const SceneElement& element,
                                    const NodePointer& into, int depth) {
    const std::string name = element.get("name");
    const auto node = makeNode(source, xml, element, depth);
    if (const auto color = evaluateSpectrum(*node, spectrumUse(*into)))
        return setProperty(element, *into, *color);
    else if (node->type == "d65" || node->type == "blackbody" || node->type == "regular" || node->type == "irregular")
        return report(element.where(), color.error().message + "; it is ignored");
    // A plugin of its own: its consumer may know it.
    into->children.push_back({toSnakeCase(name), node, element.where()});
}

void SceneReader::readValueProperty(const SceneElement& element, SceneNode& into) {
    const auto folder = std::filesystem::path(element.where().file).parent_path();
    auto value = readValue(element, spectrumUse(into), folder);
    if (value)
        return setProperty(element, into, std::move(*value));
    element.dismiss();
    report(element.where(), value.error().message + "; it is ignored");
}

void SceneReader::readTransform(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, SceneNode& into) {
    element.find("time");  // of a step of an animation
    Transform transform;
    for (const pugi::xml_node child : xml.children()) {
        if (child.type() != pugi::node_element)
            continue;
        const SceneElement step = makeElement(source, child);
        if (!isTransformTag(step.tag())) {
            report(step.where(), "element <" + step.tag() + "> in a transform is not known and ignored");
            continue;
        }
        const auto map = readTransformStep(step);
        if (!map) {
            report(step.where(), map.error().message + "; this step of the transform is ignored");
            continue;
        }
        reportUnknownAttributes(step);
        transform = *map * transform;  // what is written first is applied first
    }
    setProperty(element, into, transform);
}

void SceneReader::readAnimation(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, SceneNode& into) {
    report(element.where(), "animation is not supported; its first transform holds for all times");
    const pugi::xml_node first = xml.child("transform");
    if (!first)
        return;
    SceneNode moving;
    SceneElement step = makeElement(source, first);
    if (!step.find("name"))
        step.add("name", element.get("name"));
    readTransform(source, first, step, moving);
    for (auto& [name, entry] : moving.properties)
        into.properties.insert_or_assign(toSnakeCase(element.get("name")), entry);
}

void SceneReader::setProperty(const SceneElement& element, SceneNode& into, Property value) {
    const std::string name = toSnakeCase(element.get("name"));
    if (name.empty())
        return report(element.where(), "<" + element.tag() + "> has no attribute \"name\" and is ignored");
    const auto [place, added] = into.properties.insert_or_assign(name, SceneNode::Entry{std::move(value), element.where()});
    if (!added)
        report(element.where(), "property \"" + name + "\" is given twice; this one counts");
}

void SceneReader::readDefault(const SceneElement& element) {
    const std::string name = element.get("name");
    const std::string* value = element.find("value");
    if (name.empty() || !value)
        return report(element.where(), "<default> needs the attributes \"name\" and \"value\"; it is ignored");
    parameters_.setDefault(name, *value);
}

void SceneReader::readInclude(const SceneElement& element, const NodePointer& into, int depth) {
    const std::string name = element.get("filename");
    if (name.empty())
        return report(element.where(), "<include> has no attribute \"filename\" and is ignored");
    auto path = std::filesystem::path(element.where().file).parent_path() / name;
    std::error_code ignored;
    for (const auto& folder : document_.searchFolders)
        if (!std::filesystem::exists(path, ignored) && std::filesystem::exists(folder / name, ignored))
            path = folder / name;
    const auto refused = [&](const std::string& why) {
        report(element.where(), "file \"" + name + "\" is not included: " + why);
    };
    const auto same = canonicalPath(path);
    if (std::find(openFiles_.begin(), openFiles_.end(), same) != openFiles_.end())
        return refused("it includes itself");
    if (++includes_ > kMaxIncludes)
        return refused("there are more than " + std::to_string(kMaxIncludes) + " inclusions");
    const auto source = XmlSource::readFile(path);
    if (!source)
        return refused(source.error().message);
    openFiles_.push_back(same);
    // A file with a whole scene stands for what is in it, any other for its outermost element.
    const pugi::xml_node root = (*source)->root();
    if (std::string_view(root.name()) == "scene")
        readContents(**source, root, into, depth + 1);
    else
        readElement(**source, root, into, depth + 1);
    openFiles_.pop_back();
}

void SceneReader::readReference(const SceneElement& element, const NodePointer& into) {
    const std::string id = element.get("id"), role = toSnakeCase(element.get("name"));
    if (id.empty())
        return report(element.where(), "<ref> has no attribute \"id\" and is ignored");
    references_.addReference(into, role, id, element.where());
}

void SceneReader::readAlias(const SceneElement& element) {
    const std::string id = element.get("id"), as = element.get("as");
    if (id.empty() || as.empty())
        return report(element.where(), "<alias> needs the attributes \"id\" and \"as\"; it is ignored");
    references_.addAlias(id, as);
}

void SceneReader::readPath(const SceneElement& element) {
    const std::string value = element.get("value");
    if (value.empty())
        return report(element.where(), "<path> has no attribute \"value\" and is ignored");
    const auto folder = std::filesystem::path(element.where().file).parent_path() / value;
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return report(element.where(), "path \"" + value + "\" is not a folder (looked for " + folder.string() + ")");
    document_.searchFolders.push_back(folder);
}

SceneElement SceneReader::makeElement(const XmlSource& source, pugi::xml_node xml) {
    SceneElement element(xml.name(), source.locate(xml));
    std::vector<std::string> unknown;
    for (const pugi::xml_attribute attribute : xml.attributes())
        element.add(attribute.name(), parameters_.substitute(attribute.value(), unknown));
    for (const auto& name : unknown)
        report(element.where(), "$" + name + " is not a name that the scene declares with <default> or that was given a value");
    return element;
}

void SceneReader::reportUnknownAttributes(const SceneElement& element) {
    for (const auto& name : element.unused())
        report(element.where(), "attribute \"" + name + "\" of <" + element.tag() + "> is not known and ignored");
}

void SceneReader::report(const SourceLocation& where, std::string message) {
    addDiagnostic(document_.diagnostics, where, std::move(message));
}

}  // namespace emca::render
