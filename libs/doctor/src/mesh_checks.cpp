#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "emca/analysis/format.h"
#include "emca/core/seed_map.h"
#include "emca/doctor/scene_checks.h"
#include "words.h"

namespace emca::doctor {
namespace {

std::string meshText(const std::vector<Mesh>& meshes, std::size_t i) {
    return meshes[i].name.empty() ? fmt::format("mesh {}", i) : fmt::format("mesh {} ({})", i, meshes[i].name);
}

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }

/// Without area, as far as floats can tell: a triangle is as good as its longest edge if its height is within the
/// rounding of the coordinates.
bool isDegenerate(const Mesh& mesh, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
    const Vec3d a = toDouble(mesh.positions[t[0]]), b = toDouble(mesh.positions[t[1]]), c = toDouble(mesh.positions[t[2]]);
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    return !(length(cross(b - a, c - a)) > 1e-12 * longest);
}

std::uint64_t contentHash(const Mesh& mesh) {
    std::uint64_t hash = mix64(mesh.positions.size() * 31 + mesh.triangles.size());
    const auto take = [&](std::uint32_t bits) { hash = mix64(hash ^ bits); };
    for (const Vec3f p : mesh.positions)
        for (const float f : {p.x, p.y, p.z}) take(std::bit_cast<std::uint32_t>(f));
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t i : t) take(i);
    return hash;
}

void inspectOne(const std::vector<Mesh>& meshes, std::size_t i, MeshFacts& facts) {
    const Mesh& mesh = meshes[i];
    facts.vertices += mesh.positions.size();
    facts.triangles += mesh.triangles.size();
    if (mesh.triangles.empty() && facts.empty++ == 0) facts.emptyExample = meshText(meshes, i);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!isFinite(mesh.positions[v]) && facts.nonFinitePositions++ == 0)
            facts.nonFiniteExample = fmt::format("{}, vertex {}", meshText(meshes, i), v);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        if (std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) { return v >= mesh.positions.size(); })) {
            if (facts.badIndices++ == 0) facts.badIndexExample = fmt::format("{}, triangle {}", meshText(meshes, i), t);
        } else if (isDegenerate(mesh, triangle)) {
            ++facts.degenerate;
        }
    }
}

std::string sizeText(const BoundingBox& box) {
    const Vec3f size = box.max - box.min;
    return fmt::format("{} x {} x {}", analysis::formatNumber(double(size.x)), analysis::formatNumber(double(size.y)),
                       analysis::formatNumber(double(size.z)));
}

void addFigures(const MeshFacts& facts, Finding& finding) {
    finding.count("meshes", facts.meshes);
    finding.count("vertices", facts.vertices);
    finding.count("triangles", facts.triangles);
    finding.count("degenerate", facts.degenerate);
    finding.count("empty", facts.empty);
    finding.count("duplicates", facts.duplicates);
    finding.count("badIndices", facts.badIndices);
    finding.count("nonFinite", facts.nonFinitePositions);
    if (facts.box.empty) return;
    finding.add("boxMin", facts.box.min);
    finding.add("boxMax", facts.box.max);
}

}  // namespace

MeshFacts inspect(const std::vector<Mesh>& meshes) {
    MeshFacts facts;
    facts.meshes = meshes.size();
    facts.box = boundingBox(meshes);
    std::unordered_multimap<std::uint64_t, std::size_t> seen;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        inspectOne(meshes, i, facts);
        if (meshes[i].triangles.empty()) continue;
        const std::uint64_t hash = contentHash(meshes[i]);
        const auto [first, last] = seen.equal_range(hash);
        const auto same = std::find_if(first, last, [&](const auto& entry) {
            const Mesh& other = meshes[entry.second];
            return other.positions == meshes[i].positions && other.triangles == meshes[i].triangles;
        });
        if (same != last && facts.duplicates++ == 0)
            facts.duplicateExample = fmt::format("{} is {}", meshText(meshes, i), meshText(meshes, same->second));
        if (same == last) seen.emplace(hash, i);
    }
    return facts;
}

Finding checkMeshes(const std::vector<Mesh>& meshes, std::uint64_t announcedMeshes, std::uint64_t announcedTriangles) {
    const MeshFacts facts = inspect(meshes);
    Finding finding{.check = "meshes"};
    addFigures(facts, finding);
    finding.sentence = fmt::format("{} in {}, {} of them without area", counted(facts.triangles, "triangle"),
                                   counted(facts.meshes, "mesh", "meshes"), facts.degenerate);
    finding.sentence += facts.box.empty ? "." : fmt::format("; the box is {}.", sizeText(facts.box));
    if (facts.triangles == 0)
        finding.complain(Outcome::warning, "There is nothing to show in 3D.", "Return the scene's shapes from meshes(), analytic ones tessellated.");
    if (facts.badIndices > 0)
        finding.complain(Outcome::failed, fmt::format("{} a vertex that the mesh does not have, first {}.", counted(facts.badIndices, "triangle uses", "triangles use"), facts.badIndexExample),
                         "Indices of a triangle count from 0 within the positions of their own mesh.");
    if (facts.nonFinitePositions > 0)
        finding.complain(Outcome::failed, fmt::format("{} NaN or infinite, first {}.", counted(facts.nonFinitePositions, "vertex is", "vertices are"), facts.nonFiniteExample),
                         "Look at the transform to world space of that shape.");
    if (facts.degenerate * 5 > facts.triangles && facts.degenerate > 0)
        finding.complain(Outcome::warning, "More than a fifth of all triangles has no area.", "Look at how shapes are tessellated, and whether indices are read in threes.");
    if (facts.empty > 0)
        finding.complain(Outcome::warning, fmt::format("{} no triangle, first {}.", counted(facts.empty, "mesh has", "meshes have"), facts.emptyExample),
                         "Leave shapes that cannot be drawn only if mesh indices need their place.");
    if (facts.duplicates > 0)
        finding.complain(Outcome::warning, fmt::format("{} there twice: {}.", counted(facts.duplicates, "mesh is", "meshes are"), facts.duplicateExample),
                         "Send a shape once, so that one face has one name (renderers list shapes of area lights twice).");
    if (announcedMeshes != facts.meshes || announcedTriangles != facts.triangles)
        finding.complain(Outcome::failed, fmt::format("The renderer announces {} in {}.", counted(announcedTriangles, "triangle"), counted(announcedMeshes, "mesh", "meshes")),
                         "meshes() must return the same list each time: mesh indices of recorded surfaces refer to it.");
    return finding;
}

}  // namespace emca::doctor
