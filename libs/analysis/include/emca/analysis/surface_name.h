#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emca/core/mesh.h"
#include "emca/core/path_set.h"

namespace emca::analysis {

/// What a mesh is called wherever one is named: as the scene calls it, else "mesh 4".
/// \param meshes  of the scene; a mesh that is not among them (the scene did not come) has no name of its own
std::string meshName(std::int32_t mesh, std::span<const Mesh> meshes);

/// "lamp, face 12", "mesh 4, face 12": where a vertex lies.
std::string surfaceName(PathSet::Surface surface, std::span<const Mesh> meshes);

}  // namespace emca::analysis
