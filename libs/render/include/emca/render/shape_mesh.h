#pragma once

#include <optional>

#include "emca/core/result.h"
#include "emca/render/property_reader.h"
#include "emca/render/triangle_mesh.h"

namespace emca::render {

/// A sphere in world space.
struct SphereGeometry {
    Vec3f center;
    float radius = 1;
    Transform toWorld;  ///< from the unit sphere around the origin; its rotation places the uvs
};

/// A disk (or, under a skewing transform, an ellipse) in world space.
struct DiskGeometry {
    Transform toWorld;  ///< from the unit disk in the plane z = 0; the front looks along +z
};

/// The geometry of a shape node in world space.
struct ShapeGeometry {
    TriangleMesh mesh;                     ///< always; of analytic shapes their tessellation
    std::optional<SphereGeometry> sphere;  ///< of a sphere that its transform left a sphere
    std::optional<DiskGeometry> disk;
    bool flipped = false;                  ///< flip_normals: already done in `mesh`, to be done by whoever intersects
                                           ///< the analytic shape
};

/// Reads a shape of type obj, ply, serialized, rectangle, cube, sphere or disk: its file and all its geometric
/// properties (filename, to_world, face_normals, flip_normals, flip_tex_coords, shape_index, center, radius).
/// Warnings of the file go to the reader's diagnostics.
/// Errors: notSupported for other types; those of the mesh files, whose message says the file as written in the scene
/// and as it was sought; invalidArgument for a transform that is singular or not finite, or a radius that is not positive.
Result<ShapeGeometry> readShapeGeometry(PropertyReader& shape);

}  // namespace emca::render
