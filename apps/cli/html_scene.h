#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "json.h"

// The scene as a page of `emca export` holds it.
namespace emca::cli {

/// {"triangles" (of the scene), "shown", "meshes": [{"name", "material", "diffuse", "emission", "min", "extent",
/// "vertices", "triangles", "positions", "indices"}]}. Positions are 16-bit fractions of the mesh's box (three per
/// vertex), indices 16 bits, or 32 where a mesh has more than 65536 vertices; both little-endian, in base64.
Json sceneJson(const std::vector<Mesh>& meshes, std::uint64_t maximumTriangles);

/// Every member of Camera, as it is called there.
Json cameraJson(const Camera& camera);

}  // namespace emca::cli
