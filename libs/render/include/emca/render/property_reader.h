#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/vector.h"
#include "emca/render/scene_node.h"
#include "emca/render/transform.h"

namespace emca::render {

/// How the factory of a plugin reads its scene node:
///
///     PropertyReader read(node, diagnostics, searchFolders);
///     const double alpha = read.number("alpha", 0.1);
///     if (const auto texture = read.child("reflectance")) …  else color = read.color("reflectance", Color(0.5f));
///     read.reportUnused();
///
/// Every getter marks what it looked at as used, also if the value then turns out to be of the wrong type; that adds
/// one diagnostic which names plugin, property, found and wanted type, and the fallback is returned.
/// Names are in snake_case ("int_ior"). Marks are kept in the node: not safe for two threads at one node.
class PropertyReader {
  public:
    /// \param node, diagnostics  must outlive the reader; diagnostics are appended, none twice
    /// \param searchFolders      SceneDocument::searchFolders, where file() looks; must outlive the reader
    PropertyReader(const SceneNode& node, std::vector<Diagnostic>& diagnostics,
                   std::span<const std::filesystem::path> searchFolders = {});

    const SceneNode& node() const { return node_; }
    const std::string& type() const { return node_.type; }

    bool hasProperty(std::string_view name) const;  ///< marks nothing
    bool hasChild(std::string_view name) const;     ///< marks nothing

    // Values. The first form of each returns nothing if the property is absent or of the wrong type.
    std::optional<double> number(std::string_view name);  ///< float, integer, or a spectrum that is grey
    double number(std::string_view name, double fallback) { return number(name).value_or(fallback); }
    std::optional<std::int64_t> integer(std::string_view name);  ///< integer, or a float without fraction
    std::int64_t integer(std::string_view name, std::int64_t fallback) { return integer(name).value_or(fallback); }
    std::optional<bool> flag(std::string_view name);
    bool flag(std::string_view name, bool fallback) { return flag(name).value_or(fallback); }
    std::optional<std::string> text(std::string_view name);
    std::string text(std::string_view name, std::string fallback) { return text(name).value_or(std::move(fallback)); }
    std::optional<Color> color(std::string_view name);  ///< any spectrum; a float or integer is grey
    Color color(std::string_view name, Color fallback) { return color(name).value_or(fallback); }
    std::optional<Vec3f> vector(std::string_view name);  ///< point or vector
    Vec3f vector(std::string_view name, Vec3f fallback) { return vector(name).value_or(fallback); }
    std::optional<Transform> transform(std::string_view name);
    Transform transform(std::string_view name, const Transform& fallback) { return transform(name).value_or(fallback); }

    /// A file that a string property names: absolute, else the first that exists of: beside the XML file in which it
    /// is written, then each search folder. If none exists, the path beside the XML file (opening it will fail, and the
    /// message can show both). Nothing if the property is absent.
    struct File {
        std::string written;             ///< as in the scene file
        std::filesystem::path resolved;
    };
    std::optional<File> file(std::string_view name);

    // Nested elements and <ref>s.
    /// The last child of this role (<texture name="reflectance">), null if none.
    std::shared_ptr<const SceneNode> child(std::string_view name);
    /// All children of a kind ("bsdf", "emitter", …), whatever their role, in order of the file.
    std::vector<std::shared_ptr<const SceneNode>> childrenOfKind(std::string_view kind);
    /// The first child of a kind, null if none. Further ones stay unused, so that reportUnused() tells of them.
    std::shared_ptr<const SceneNode> firstOfKind(std::string_view kind);
    /// All children in order of the file, all marked as used.
    const std::vector<SceneNode::Child>& allChildren();

    /// Marks a property or role as known though its value is of no use here.
    void ignore(std::string_view name);

    /// Line of a property, of a nested element, or else of the plugin itself.
    SourceLocation where(std::string_view name) const;

    /// Adds a diagnostic at the plugin's line, or at the line of a property or child; `message` is one whole sentence.
    void report(std::string message);
    void reportAt(std::string_view name, std::string message);
    /// Adds a diagnostic: `property "alpha" of bsdf "roughplastic" <what>`.
    void reportProperty(std::string_view name, std::string_view what);

    /// One diagnostic for every property and child that nobody asked for. \return how many
    int reportUnused();

    /// `bsdf "roughplastic"`, with its id if it has one.
    std::string description() const;

  private:
    const SceneNode::Entry* find(std::string_view name);
    void wrongType(std::string_view name, const SceneNode::Entry& entry, std::string_view wanted);
    void add(SourceLocation where, std::string message);

    const SceneNode& node_;
    std::vector<Diagnostic>& diagnostics_;
    std::span<const std::filesystem::path> searchFolders_;
};

/// "a float", "a colour", …: the type of a property in words, for messages.
const char* typeName(const Property& property);

}  // namespace emca::render
