#pragma once

#include <filesystem>

#include "emca/core/result.h"
#include "emca/render/triangle_mesh.h"

namespace emca::render {

/// What a shape in a scene file says beside the name of its mesh file.
struct MeshFileOptions {
    bool faceNormals = false;    ///< forget the file's normals and compute none: flat faces
    bool flipTexCoords = false;  ///< v becomes 1 - v (the default of scene files is true for obj, false for ply)
    std::size_t shapeIndex = 0;  ///< which mesh of a .serialized file
};

// Meshes come in object space, with the normals of the file or else smooth ones (unless faceNormals), triangles turned
// to the side of the normals. Polygons are split into triangles. Faces with an index out of range or with a vertex that
// is not finite are left out with a warning that says the first such element and how many there were.
// Errors: fileNotFound, fileUnreadable (with the line or element), tooLarge, outOfMemory.

/// Wavefront OBJ: v, vt, vn, f with any combination and negative indices. Groups are joined to one mesh; materials,
/// lines and curves are passed over.
Result<LoadedMesh> loadObj(const std::filesystem::path& path, const MeshFileOptions& options);

/// Stanford PLY: ascii and binary of either byte order. Normals nx, ny, nz; uvs u, v or s, t (or texture_u, …).
Result<LoadedMesh> loadPly(const std::filesystem::path& path, const MeshFileOptions& options);

/// Mitsuba's compressed meshes, versions 3 and 4.
/// Source: Jakob, "Mitsuba Documentation" (0.6), section 8.1.6.
Result<LoadedMesh> loadSerialized(const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace emca::render
