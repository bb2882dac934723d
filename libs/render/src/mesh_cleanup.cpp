#include "mesh_cleanup.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace emca::render {

namespace {

/// Counts what is wrong in the same way and remembers the first.
struct Flaw {
    std::size_t count = 0, first = 0;
    void add(std::size_t element) {
        if (count++ == 0)
            first = element;
    }
};

/// Drops the vertices that no triangle uses.
void removeUnusedVertices(TriangleMesh& mesh) {
    constexpr std::uint32_t kUnused = 0xffffffffu;
    std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
    for (const auto& triangle : mesh.triangles)
        for (const auto index : triangle)
            place[index] = 0;
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == kUnused)
            continue;
        mesh.positions[kept] = mesh.positions[i];
        if (!mesh.normals.empty())
            mesh.normals[kept] = mesh.normals[i];
        if (!mesh.uvs.empty())
            mesh.uvs[kept] = mesh.uvs[i];
        place[i] = kept++;
    }
    mesh.positions.resize(kept);
    mesh.normals.resize(mesh.normals.empty() ? 0 : kept);
    mesh.uvs.resize(mesh.uvs.empty() ? 0 : kept);
    for (auto& triangle : mesh.triangles)
        for (auto& index : triangle)
            index = place[index];
}

void dropBadTriangles(LoadedMesh& loaded, const std::filesystem::path& path) {
    auto& mesh = loaded.mesh;
    Flaw badIndex, badVertex;
    const bool allFinite = std::all_of(mesh.positions.begin(), mesh.positions.end(), [](Vec3f p) { return isFinite(p); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = mesh.triangles[i];
        if (std::any_of(t.begin(), t.end(), [&](auto index) { return index >= mesh.positions.size(); }))
            badIndex.add(i);
        else if (!allFinite && std::any_of(t.begin(), t.end(), [&](auto index) { return !isFinite(mesh.positions[index]); }))
            badVertex.add(i);
        else
            mesh.triangles[kept++] = t;
    }
    mesh.triangles.resize(kept);
    const auto warn = [&](const Flaw& flaw, const std::string& what) {
        if (flaw.count > 0)
            loaded.warnings.push_back(std::to_string(flaw.count) + " triangles of \"" + path.string() + "\" " + what +
                                      " and are left out; the first is triangle " + std::to_string(flaw.first) + ", counted from 0.");
    };
    warn(badIndex, "name a vertex that is not there");
    warn(badVertex, "have a vertex that is not finite");
    if (!allFinite)
        removeUnusedVertices(mesh);
}

void repairUvs(LoadedMesh& loaded, const std::filesystem::path& path) {
    Flaw bad;
    for (std::size_t i = 0; i < loaded.mesh.uvs.size(); ++i) {
        Vec2f& uv = loaded.mesh.uvs[i];
        if (std::isfinite(uv.x) && std::isfinite(uv.y))
            continue;
        bad.add(i);
        uv = {0, 0};
    }
    if (bad.count > 0)
        loaded.warnings.push_back(std::to_string(bad.count) + " texture coordinates of \"" + path.string() +
                                  "\" are not finite and become (0, 0); the first is that of vertex " +
                                  std::to_string(bad.first) + ", counted from 0.");
}

void repairNormals(TriangleMesh& mesh) {
    if (mesh.normals.empty())
        return computeNormals(mesh);
    bool allThere = true;
    for (auto& normal : mesh.normals) {
        const float l = length(normal);
        allThere = allThere && l > 0 && std::isfinite(l);
        if (l > 0)
            normal = normal / l;
    }
    if (!allThere) {
        const std::vector<Vec3f> given = std::move(mesh.normals);
        computeNormals(mesh);
        for (std::size_t i = 0; i < given.size(); ++i)
            if (length(given[i]) > 0.5f && isFinite(given[i]))
                mesh.normals[i] = given[i];
    }
    alignWithNormals(mesh);
}

}  // namespace

Result<LoadedMesh> cleanUp(TriangleMesh mesh, const MeshFileOptions& options, const std::filesystem::path& path) {
    LoadedMesh loaded{std::move(mesh), {}};
    dropBadTriangles(loaded, path);
    if (loaded.mesh.triangles.empty())
        return Error{ErrorCode::fileUnreadable,
                     '"' + path.string() + "\" has no usable triangle" +
                         (loaded.warnings.empty() ? "." : ": " + loaded.warnings.front())};
    if (options.flipTexCoords)
        for (auto& uv : loaded.mesh.uvs)
            uv.y = 1 - uv.y;
    repairUvs(loaded, path);
    if (options.faceNormals)
        loaded.mesh.normals.clear();
    else
        repairNormals(loaded.mesh);
    return loaded;
}

}  // namespace emca::render
