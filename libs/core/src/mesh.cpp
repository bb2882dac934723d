#include "emca/core/mesh.h"

namespace emca {

void BoundingBox::extend(Vec3f p) {
    if (!isFinite(p)) return;
    if (empty) {
        min = max = p;
        empty = false;
        return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        min[i] = std::min(min[i], p[i]);
        max[i] = std::max(max[i], p[i]);
    }
}

BoundingBox boundingBox(const std::vector<Mesh>& meshes) {
    BoundingBox box;
    for (const Mesh& mesh : meshes)
        for (const Vec3f p : mesh.positions) box.extend(p);
    return box;
}

Result<void> validate(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t index : mesh.triangles[t])
            if (index >= mesh.positions.size())
                return Error{ErrorCode::invalidArgument,
                             "Triangle " + std::to_string(t) + " of mesh \"" + mesh.name + "\" uses vertex " +
                                 std::to_string(index) + ", but the mesh has only " +
                                 std::to_string(mesh.positions.size()) + "."};
    return {};
}

}  // namespace emca
