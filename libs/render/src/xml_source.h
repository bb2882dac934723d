#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emca/core/result.h"
#include "emca/render/scene_node.h"

namespace emca::render {

/// A parsed XML file that knows its lines.
class XmlSource {
  public:
    /// Errors: as readFileBytes; parseFailed with file, line, column and the parser's words.
    static Result<std::unique_ptr<XmlSource>> readFile(const std::filesystem::path& path);
    static Result<std::unique_ptr<XmlSource>> parse(std::string text, const std::filesystem::path& path);

    XmlSource(const XmlSource&) = delete;
    XmlSource& operator=(const XmlSource&) = delete;

    pugi::xml_node root() const { return document_.document_element(); }
    const std::filesystem::path& path() const { return path_; }
    /// Where an element, or the first word of a text, begins.
    SourceLocation locate(pugi::xml_node node) const;

  private:
    XmlSource(std::string text, std::filesystem::path path) : path_(std::move(path)), text_(std::move(text)) {}
    int lineAt(std::ptrdiff_t offset) const;

    std::filesystem::path path_;
    std::string text_;  ///< pugixml parses in place: the document points into it
    std::vector<std::ptrdiff_t> lineStarts_;
    pugi::xml_document document_;
};

/// One element with its attributes, $names already replaced.
class SceneElement {
  public:
    SceneElement(std::string tag, SourceLocation where) : tag_(std::move(tag)), where_(std::move(where)) {}
    void add(std::string name, std::string value) { attributes_.push_back({std::move(name), std::move(value)}); }

    const std::string& tag() const { return tag_; }
    const SourceLocation& where() const { return where_; }
    /// Value of an attribute, null if there is none. Marks it as known.
    const std::string* find(std::string_view name) const;
    std::string get(std::string_view name) const;  ///< empty if there is none
    /// Names of attributes that nobody asked for.
    std::vector<std::string> unused() const;
    /// For an element that is left out as a whole: its attributes are of no more interest.
    void dismiss() const;

  private:
    struct Attribute { std::string name, value; mutable bool used = false; };
    std::string tag_;
    SourceLocation where_;
    std::vector<Attribute> attributes_;
};

}  // namespace emca::render
