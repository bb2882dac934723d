#include "emca/analysis/surface_name.h"

#include "emca/analysis/format.h"

namespace emca::analysis {

std::string meshName(std::int32_t mesh, std::span<const Mesh> meshes) {
    const bool known = mesh >= 0 && static_cast<std::size_t>(mesh) < meshes.size();
    if (known && !meshes[static_cast<std::size_t>(mesh)].name.empty()) return meshes[static_cast<std::size_t>(mesh)].name;
    return "mesh " + formatInteger(mesh);
}

std::string surfaceName(PathSet::Surface surface, std::span<const Mesh> meshes) {
    return meshName(surface.mesh, meshes) + ", face " + formatInteger(surface.face);
}

}  // namespace emca::analysis
