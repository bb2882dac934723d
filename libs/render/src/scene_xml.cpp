#include "emca/render/scene_xml.h"

#include <new>

#include "scene_reader.h"
#include "xml_source.h"

namespace emca::render {

namespace {

Result<SceneDocument> readScene(const Result<std::unique_ptr<XmlSource>>& source, const SceneDefines& defines) {
    if (!source)
        return source.error();
    return SceneReader(defines).read(**source);
}

Error outOfMemory(const std::filesystem::path& path) {
    return {ErrorCode::outOfMemory, "Not enough memory to read scene \"" + path.string() + "\"."};
}

}  // namespace

Result<SceneDocument> readSceneFile(const std::filesystem::path& path, const SceneDefines& defines) try {
    return readScene(XmlSource::readFile(path), defines);
} catch (const std::bad_alloc&) {
    return outOfMemory(path);
}

Result<SceneDocument> readSceneText(std::string text, const std::filesystem::path& path, const SceneDefines& defines) try {
    return readScene(XmlSource::parse(std::move(text), path), defines);
} catch (const std::bad_alloc&) {
    return outOfMemory(path);
}

}  // namespace emca::render
