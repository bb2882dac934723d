#include "shape_sources.h"

#include <mutex>
#include <unordered_map>

#include "inside.h"

namespace emca::pbrt4 {

namespace {

using Textures = std::map<std::string, pbrt::FloatTexture>;

constinit ShapeSources* listener = nullptr;  // set and cleared while pbrt makes nothing

}  // namespace

pstd::vector<pbrt::Shape> realCreate(const std::string& name, const pbrt::Transform* renderFromObject,
                                     const pbrt::Transform* objectFromRender, bool reverseOrientation,
                                     const pbrt::ParameterDictionary& parameters, const Textures& textures,
                                     const pbrt::FileLoc* where,
                                     pbrt::Allocator allocator) asm("__real_" EMCA_PBRT_CREATE_SHAPE);
pstd::vector<pbrt::Shape> wrapCreate(const std::string& name, const pbrt::Transform* renderFromObject,
                                     const pbrt::Transform* objectFromRender, bool reverseOrientation,
                                     const pbrt::ParameterDictionary& parameters, const Textures& textures,
                                     const pbrt::FileLoc* where,
                                     pbrt::Allocator allocator) asm("__wrap_" EMCA_PBRT_CREATE_SHAPE);

struct ShapeSources::Impl {
    std::mutex mutex;
    std::unordered_map<const void*, ShapeSource> of;
};

struct WrappedShapes {
    static void made(ShapeSources& sources, const std::string& type, const pbrt::ParameterDictionary& parameters,
                     const pbrt::FileLoc& where, const pstd::vector<pbrt::Shape>& shapes) {
        ShapeSource source{
            .type = type, .sceneFile = std::string(where.filename), .line = where.line, .column = where.column};
        if (type == "plymesh") source.plyFile = parameters.GetOneString("filename", "");
        const std::scoped_lock lock(sources.impl_->mutex);
        const void* last = nullptr;
        for (const pbrt::Shape& shape : shapes) {
            const void* whole = ShapeSources::wholeOf(shape);
            if (whole != last) sources.impl_->of.emplace(whole, source);
            last = whole;
        }
    }
};

pstd::vector<pbrt::Shape> wrapCreate(const std::string& name, const pbrt::Transform* renderFromObject,
                                     const pbrt::Transform* objectFromRender, bool reverseOrientation,
                                     const pbrt::ParameterDictionary& parameters, const Textures& textures,
                                     const pbrt::FileLoc* where, pbrt::Allocator allocator) {
    auto shapes = realCreate(name, renderFromObject, objectFromRender, reverseOrientation, parameters, textures, where,
                             allocator);
    if (listener != nullptr && where != nullptr) WrappedShapes::made(*listener, name, parameters, *where, shapes);
    return shapes;
}

std::string ShapeSource::name() const {
    if (plyFile.empty()) return type + ", line " + std::to_string(line);
    const std::size_t folder = plyFile.find_last_of('/');
    return folder == std::string::npos ? plyFile : plyFile.substr(folder + 1);
}

ShapeSources::ShapeSources() : impl_(new Impl) { listener = this; }

ShapeSources::~ShapeSources() {
    listener = nullptr;
    delete impl_;
}

const ShapeSource* ShapeSources::find(const pbrt::Shape& shape) const {
    const auto found = impl_->of.find(wholeOf(shape));
    return found == impl_->of.end() ? nullptr : &found->second;
}

const void* ShapeSources::wholeOf(const pbrt::Shape& shape) {
    if (const auto* triangle = shape.CastOrNullptr<pbrt::Triangle>()) return inside::triangle(*triangle).mesh;
    if (const auto* patch = shape.CastOrNullptr<pbrt::BilinearPatch>()) return inside::patch(*patch).mesh;
    if (const auto* segment = shape.CastOrNullptr<pbrt::Curve>()) return inside::curve(*segment);
    return shape.ptr();
}

}  // namespace emca::pbrt4
