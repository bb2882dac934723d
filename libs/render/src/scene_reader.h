#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "emca/render/scene_xml.h"
#include "scene_parameters.h"
#include "scene_references.h"
#include "xml_source.h"

namespace emca::render {

/// Walks the elements of a scene file and of those that it includes, and makes nodes of them. For one scene.
class SceneReader {
  public:
    explicit SceneReader(const SceneDefines& defines) : parameters_(defines) {}

    Result<SceneDocument> read(const XmlSource& source);

  private:
    using NodePointer = SceneReferences::NodePointer;

    void checkVersion(const SceneElement& scene);
    void readContents(const XmlSource& source, pugi::xml_node parent, const NodePointer& into, int depth);
    void readElement(const XmlSource& source, pugi::xml_node xml, const NodePointer& into, int depth);
    void readObject(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, const NodePointer& into,
                    int depth);
    void readTypedSpectrum(const XmlSource& source, pugi::xml_node xml, const SceneElement& element,
                           const NodePointer& into, int depth);
    void readValueProperty(const SceneElement& element, SceneNode& into);
    void readTransform(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, SceneNode& into);
    void readAnimation(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, SceneNode& into);
    void readDefault(const SceneElement& element);
    void readInclude(const SceneElement& element, const NodePointer& into, int depth);
    void readReference(const SceneElement& element, const NodePointer& into);
    void readAlias(const SceneElement& element);
    void readPath(const SceneElement& element);

    NodePointer makeNode(const XmlSource& source, pugi::xml_node xml, const SceneElement& element, int depth);
    void setProperty(const SceneElement& element, SceneNode& into, Property value);
    SceneElement makeElement(const XmlSource& source, pugi::xml_node xml);
    void reportUnknownAttributes(const SceneElement& element);
    void report(const SourceLocation& where, std::string message);

    SceneParameters parameters_;
    SceneReferences references_;
    SceneDocument document_;
    bool early_ = false;  ///< the scene says a version below 1
    std::vector<std::filesystem::path> openFiles_;  ///< canonical, from the scene file to the one being read
    int includes_ = 0;
};

}  // namespace emca::render
