#include "emca/render/shape_mesh.h"

#include <algorithm>
#include <cmath>

#include "emca/render/mesh_files.h"

namespace emca::render {

namespace {

Error badValue(const PropertyReader& shape, const std::string& what) {
    return {ErrorCode::invalidArgument, shape.description() + " " + what + '.'};
}

/// Transform of a shape: finite and not singular, as a shape without volume has no normals.
Result<Transform> readToWorld(PropertyReader& shape) {
    const Transform toWorld = shape.transform("to_world", Transform());
    if (!toWorld.inverse() || !std::isfinite(toWorld.determinant()) || toWorld.determinant() == 0)
        return badValue(shape, "has a to_world transform that is singular or not finite");
    return toWorld;
}

Result<TriangleMesh> readMeshFile(PropertyReader& shape) {
    MeshFileOptions options;
    options.faceNormals = shape.flag("face_normals", false);
    options.flipTexCoords = shape.type() != "serialized" && shape.flag("flip_tex_coords", shape.type() == "obj");
    if (shape.type() == "serialized") {
        const auto index = shape.integer("shape_index", 0);
        if (index < 0)
            return badValue(shape, "has a negative shape_index");
        options.shapeIndex = static_cast<std::size_t>(index);
    }
    const auto file = shape.file("filename");
    if (!file)
        return badValue(shape, "has no filename");
    auto loaded = shape.type() == "obj"   ? loadObj(file->resolved, options)
                  : shape.type() == "ply" ? loadPly(file->resolved, options)
                                          : loadSerialized(file->resolved, options);
    if (!loaded)
        return Error{loaded.error().code,
                     shape.description() + " cannot load \"" + file->written + "\": " + loaded.error().message};
    for (auto& warning : loaded->warnings)
        shape.reportAt("filename", std::move(warning));
    return std::move(loaded->mesh);
}

/// Whether the linear part is a rotation times one scale (mirrored or not), up to rounding of the scene's decimals.
bool keepsSpheres(const Transform& t) {
    const auto column = [&](int c) { return Vec3d{t(0, c), t(1, c), t(2, c)}; };
    const double scale = dot(column(0), column(0)), tolerance = 1e-4 * scale;
    return std::abs(dot(column(1), column(1)) - scale) < tolerance && std::abs(dot(column(2), column(2)) - scale) < tolerance &&
           std::abs(dot(column(0), column(1))) < tolerance && std::abs(dot(column(0), column(2))) < tolerance &&
           std::abs(dot(column(1), column(2))) < tolerance && t(3, 0) == 0 && t(3, 1) == 0 && t(3, 2) == 0;
}

Result<ShapeGeometry> readSphere(PropertyReader& shape, const Transform& toWorld) {
    const Vec3f center = shape.vector("center", Vec3f{0, 0, 0});
    const double radius = shape.number("radius", 1.0);
    if (!(radius > 0) || !std::isfinite(static_cast<float>(radius)))
        return badValue(shape, "has a radius that is not positive");
    ShapeGeometry geometry;
    geometry.mesh = tessellateSphere(center, static_cast<float>(radius), toWorld);
    const Vec3d c{double(center.x), double(center.y), double(center.z)};
    const Transform whole = toWorld * Transform::translate(c) * Transform::scale({radius, radius, radius});
    const double worldRadius = std::cbrt(std::abs(whole.determinant()));
    if (keepsSpheres(whole))
        geometry.sphere = SphereGeometry{whole.point({0, 0, 0}), static_cast<float>(worldRadius), whole};
    else
        shape.reportAt("to_world", shape.description() + " is stretched by its transform and becomes a mesh of triangles");
    return geometry;
}

Result<ShapeGeometry> readGeometry(PropertyReader& shape, const Transform& toWorld) {
    const std::string& type = shape.type();
    if (type == "sphere")
        return readSphere(shape, toWorld);
    ShapeGeometry geometry;
    if (type == "disk") {
        geometry.mesh = tessellateDisk(toWorld);
        geometry.disk = DiskGeometry{toWorld};
        return geometry;
    }
    if (type == "rectangle" || type == "cube") {
        geometry.mesh = type == "cube" ? makeCube() : makeRectangle();
    } else {
        auto mesh = readMeshFile(shape);
        if (!mesh)
            return mesh.error();
        geometry.mesh = std::move(*mesh);
    }
    apply(toWorld, geometry.mesh);
    return geometry;
}

}  // namespace

Result<ShapeGeometry> readShapeGeometry(PropertyReader& shape) {
    static constexpr const char* kTypes[] = {"obj", "ply", "serialized", "rectangle", "cube", "sphere", "disk"};
    if (std::none_of(std::begin(kTypes), std::end(kTypes), [&](const char* t) { return shape.type() == t; }))
        return Error{ErrorCode::notSupported, shape.description() + " is of a type that is not known (known: obj, ply, "
                                                                    "serialized, rectangle, cube, sphere, disk)."};
    const auto toWorld = readToWorld(shape);
    if (!toWorld)
        return toWorld.error();
    auto geometry = readGeometry(shape, *toWorld);
    if (!geometry)
        return geometry;
    const auto& positions = geometry->mesh.positions;
    if (!std::all_of(positions.begin(), positions.end(), [](Vec3f p) { return isFinite(p); }))
        return badValue(shape, "has a to_world transform that moves some of its vertices to infinity");
    geometry->flipped = shape.flag("flip_normals", false);
    if (geometry->flipped)
        flip(geometry->mesh);
    return geometry;
}

}  // namespace emca::render
