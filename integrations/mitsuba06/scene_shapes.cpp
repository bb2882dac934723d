#include "scene_shapes.h"

#include <algorithm>
#include <string>

#include <mitsuba/core/track.h>
#include <mitsuba/render/emitter.h>
#if __has_include(<shapes/instance.h>)
// Not among Mitsuba's public headers, but what stands in them needs nothing of the plugin's code.
#include <shapes/instance.h>
#define EMCA_HAS_INSTANCES 1
#endif

namespace emca::mitsuba06 {

namespace {

/// An intersection in the middle of a triangle, seen from its front, as far as materials and emitters look at one.
mts::Intersection middleOf(const mts::Shape& shape, const Mesh& mesh) {
    const Triangle& t = mesh.triangles.front();
    const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const Vec3f centre = (a + b + c) / 3.f, normal = normalize(cross(b - a, c - a));
    mts::Intersection its;
    its.shape = &shape;
    its.instance = nullptr;
    its.t = 1;
    its.time = 0;
    its.primIndex = 0;
    its.p = mts::Point(centre.x, centre.y, centre.z);
    its.shFrame = its.geoFrame = mts::Frame(mts::Normal(normal.x, normal.y, normal.z));
    its.uv = mts::Point2(mts::Float(0.5), mts::Float(0.5));
    its.dpdu = its.shFrame.s;
    its.dpdv = its.shFrame.t;
    its.dudx = its.dudy = its.dvdx = its.dvdy = 0;
    its.hasUVPartials = true;
    its.color = mts::Spectrum(mts::Float(1));
    its.wi = mts::Vector(0, 0, 1);
    return its;
}

void describe(const mts::Shape& shape, Mesh& mesh) {
    mesh.name = nameOf(shape);
    if (shape.getBSDF()) mesh.material = nameOf(*shape.getBSDF());
    if (mesh.triangles.empty()) return;
    const mts::Intersection its = middleOf(shape, mesh);
    if (shape.getBSDF()) {
        const Color diffuse = toColor(shape.getBSDF()->getDiffuseReflectance(its)),
                    specular = toColor(shape.getBSDF()->getSpecularReflectance(its));
        const auto shown = [](float d, float s) { return std::clamp(d > 0 ? d : 0.5f * (s > 0 ? s : 1.f), 0.f, 1.f); };
        mesh.diffuse =
            isBlack(diffuse) ? Color(shown(0, specular.r), shown(0, specular.g), shown(0, specular.b)) : diffuse;
    }
    if (shape.getEmitter()) mesh.emission = toColor(shape.getEmitter()->eval(its, its.shFrame.n));
}

Mesh toMesh(const mts::TriMesh& source, const mts::Transform& toWorld) {
    Mesh mesh;
    mesh.positions.reserve(source.getVertexCount());
    for (std::size_t i = 0; i < source.getVertexCount(); ++i)
        mesh.positions.push_back(toVec3f(toWorld(source.getVertexPositions()[i])));
    mesh.triangles.reserve(source.getTriangleCount());
    for (std::size_t i = 0; i < source.getTriangleCount(); ++i) {
        const std::uint32_t* const idx = source.getTriangles()[i].idx;
        mesh.triangles.push_back({idx[0], idx[1], idx[2]});
    }
    return mesh;
}

/// The triangles of any shape, if it has some: with the shape itself where it is a mesh.
struct Tessellation {
    mts::ref<mts::TriMesh> mesh;
    bool isTriMesh = false;
};

Tessellation tessellate(mts::Shape& shape) {
    if (shape.getClass()->derivesFrom(MTS_CLASS(mts::TriMesh))) return {static_cast<mts::TriMesh*>(&shape), true};
    try {
        return {shape.createTriMesh(), false};
    } catch (const std::exception&) {
        return {};  // one that has no tessellation
    }
}

}  // namespace

std::string_view nameOf(const mts::ConfigurableObject& object) {
    const std::string& id = object.getID();
    return id.empty() || id == "unnamed" ? std::string_view(object.getClass()->getName()) : std::string_view(id);
}

std::string nameOf(const mts::Emitter& emitter) {
    return emitter.getShape() ? nameOf(*emitter.getShape())
                              : std::string(nameOf(static_cast<const mts::ConfigurableObject&>(emitter)));
}

std::string nameOf(const mts::Shape& shape) {
    const std::string& id = shape.getID();
    if (!id.empty() && id != "unnamed") return id;
    const std::string name = shape.getName();
    return name.empty() ? shape.getClass()->getName() : name;
}

std::vector<mts::Shape*> shapesOfInstance([[maybe_unused]] mts::Shape& shape) {
    std::vector<mts::Shape*> shapes;
#ifdef EMCA_HAS_INSTANCES
    if (shape.getClass()->getName() != "Instance") return shapes;
    for (const mts::Shape* inner : static_cast<mts::Instance&>(shape).getShapeGroup()->getKDTree()->getShapes()) {
        shapes.push_back(const_cast<mts::Shape*>(inner));  // the scene's own, of which the tree gives constant pointers
    }
#endif
    return shapes;
}

SceneShapes::SceneShapes(mts::Scene& scene) {
    const mts::Float time = scene.getSensor()->getShutterOpen();
    for (auto& shape : scene.getShapes()) {
        if (shapesOfInstance(*shape).empty())
            add(*shape);
        else
            addInstance(*shape, time);
    }
}

void SceneShapes::add(mts::Shape& shape) {
    const Tessellation triangles = tessellate(shape);
    if (triangles.mesh != nullptr) add(nullptr, shape, toMesh(*triangles.mesh, mts::Transform()), triangles.isTriMesh);
}

void SceneShapes::addInstance([[maybe_unused]] mts::Shape& instance, [[maybe_unused]] mts::Float time) {
#ifdef EMCA_HAS_INSTANCES
    const mts::Transform toWorld = static_cast<mts::Instance&>(instance).getAnimatedTransform()->eval(time);
    for (mts::Shape* shape : shapesOfInstance(instance)) {
        const Tessellation triangles = tessellate(*shape);
        if (triangles.mesh != nullptr) add(&instance, *shape, toMesh(*triangles.mesh, toWorld), triangles.isTriMesh);
    }
#endif
}

void SceneShapes::add(const mts::Shape* instance, const mts::Shape& shape, Mesh mesh, bool isTriMesh) {
    describe(shape, mesh);
    Entry entry{static_cast<std::int32_t>(meshes_.size()), isTriMesh, nullptr};
    if (!isTriMesh || shape.getEmitter()) entry.nearest = std::make_unique<const NearestFace>(mesh);
    meshes_.push_back(std::move(mesh));
    if (instance)
        instanced_.emplace(std::pair(instance, &shape), std::move(entry));
    else
        entries_.emplace(&shape, std::move(entry));
}

const SceneShapes::Entry* SceneShapes::find(const mts::Shape* instance, const mts::Shape* shape) const {
    if (instance) {
        const auto found = instanced_.find({instance, shape});
        return found == instanced_.end() ? nullptr : &found->second;
    }
    const auto found = entries_.find(shape);
    return found == entries_.end() ? nullptr : &found->second;
}

SurfacePlace SceneShapes::place(const mts::Intersection& its) const {
    const Entry* const entry = find(its.instance, its.shape);
    if (!entry) return {};
    if (entry->isTriMesh) return {entry->mesh, static_cast<std::int32_t>(its.primIndex)};
    return {entry->mesh, entry->nearest->find(toVec3f(its.p))};
}

SurfacePlace SceneShapes::place(const mts::Shape* shape, const mts::Point& point) const {
    const Entry* const entry = find(nullptr, shape);
    if (!entry || !entry->nearest) return {};
    return {entry->mesh, entry->nearest->find(toVec3f(point))};
}

}  // namespace emca::mitsuba06
