#include <algorithm>
#include <memory>
#include <string>

#include "emca/render/bsdf.h"
#include "emca/render/shape_mesh.h"
#include "emitters/area_emitter.h"
#include "scene_building.h"
#include "shapes/disk_shape.h"
#include "shapes/mesh_shape.h"
#include "shapes/sphere_shape.h"

namespace emca::render {

namespace {

/// Whether a mask is anywhere in a tree of materials.
bool containsMask(const SceneNode& bsdf) {
    if (bsdf.type == "mask") return true;
    return std::any_of(bsdf.children.begin(), bsdf.children.end(), [](const SceneNode::Child& child) {
        return child.node->kind == "bsdf" && containsMask(*child.node);
    });
}

std::shared_ptr<const Texture> readRadiance(PropertyReader& read, FactoryContext& factories) {
    if (const auto texture = read.child("radiance")) return makeTexture(*texture, factories);
    return std::make_shared<ConstantTexture>(read.color("radiance", Color(1.f)));
}

/// Area light of a shape, or null.
std::unique_ptr<Emitter> readAreaEmitter(const SceneNode& node, const Shape& shape, SceneBuilding& building) {
    PropertyReader read = building.reader(node);
    if (read.type() != "area") {
        read.report(read.description() + " cannot light a shape; area can. It is left out.");
        return nullptr;
    }
    auto emitter = std::make_unique<AreaEmitter>(shape, readRadiance(read, building.factories));
    emitter->samplingWeight = static_cast<float>(std::max(read.number("sampling_weight", 1.0), 0.0));
    emitter->name = node.id.empty() ? shape.name : node.id;
    read.reportUnused();
    return emitter;
}

std::unique_ptr<Shape> makeShape(ShapeGeometry geometry, bool emits, const IntegratorSettings& integrator) {
    if (geometry.sphere) {
        return std::make_unique<SphereShape>(*geometry.sphere, std::move(geometry.mesh), geometry.flipped);
    }
    if (geometry.disk) return std::make_unique<DiskShape>(*geometry.disk, std::move(geometry.mesh), geometry.flipped);
    auto mesh = std::make_unique<MeshShape>(std::move(geometry.mesh));
    if (emits) mesh->prepareSampling();
    if (integrator.reuseTriangleSample) mesh->reuseTriangleSample();
    return mesh;
}

}  // namespace

void buildShape(const SceneNode& node, SceneBuilding& building) {
    PropertyReader read = building.reader(node);
    auto geometry = readShapeGeometry(read);
    const auto emitterNode = read.firstOfKind("emitter");
    const auto bsdfNode = read.firstOfKind("bsdf");
    if (!geometry) {
        read.report(geometry.error().message + " The shape is left out.");
        return;
    }
    if (geometry->mesh.triangles.empty()) {
        read.report(read.description() + " has no triangles and is left out.");
        return;
    }
    std::unique_ptr<Shape> shape = makeShape(std::move(*geometry), emitterNode != nullptr, building.parts.integrator);
    shape->name = node.id.empty() ? node.type : node.id;
    shape->bsdf = bsdfNode ? makeBsdf(*bsdfNode, building.factories) : defaultBsdf();
    shape->masked = bsdfNode && containsMask(*bsdfNode);
    if (emitterNode) {
        if (shape->area() > 0.f) {
            if (auto emitter = readAreaEmitter(*emitterNode, *shape, building)) {
                shape->emitter = emitter.get();
                building.parts.emitters.push_back(std::move(emitter));
            }
        } else {
            read.report(read.description() + " has no area and cannot emit light.");
        }
    }
    read.reportUnused();
    building.parts.shapes.push_back(std::move(shape));
}

}  // namespace emca::render
