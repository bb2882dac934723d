#pragma once

#include <filesystem>

#include "emca/render/mesh_files.h"

namespace emca::render {

/// Makes what a file said keep the promises of TriangleMesh and of mesh_files.h: faces with an index out of range or a
/// vertex that is not finite are dropped, uvs that are not finite become 0, normals are unit and there unless faceNormals.
/// `mesh.normals` and `mesh.uvs` are empty or as long as `mesh.positions`; an absent normal is (0, 0, 0).
/// Errors: fileUnreadable if no face is left.
Result<LoadedMesh> cleanUp(TriangleMesh mesh, const MeshFileOptions& options, const std::filesystem::path& path);

inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t(16) << 30;

}  // namespace emca::render
