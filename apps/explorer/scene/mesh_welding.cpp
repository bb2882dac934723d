#include "mesh_welding.h"

#include <algorithm>
#include <cmath>

#include "place_table.h"

namespace emca::explorer {
namespace {

constexpr double kSteps = 1e6;   ///< of the grid of places along the mesh's diagonal
static_assert(kSteps < double(PlaceTable::kLargest));

/// Joins positions; returns the number of each one's place.
std::vector<std::uint32_t> joinPositions(const Mesh& mesh, std::vector<Vec3f>& joined) {
    BoundingBox box;
    for (const Vec3f& p : mesh.positions)
        if (isFinite(p)) box.extend(p);
    const double scale = kSteps / std::max(double(box.diagonal()), 1e-30);
    const auto step = [scale](float v, float min) {
        return std::clamp<std::int64_t>(std::llround((double(v) - double(min)) * scale), 0, PlaceTable::kLargest);
    };
    PlaceTable places(mesh.positions.size());
    std::vector<std::uint32_t> numbers(mesh.positions.size());
    joined.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3f p = mesh.positions[i];
        if (!isFinite(p)) continue;
        const auto [number, isNew] = places.number(PlaceTable::key(step(p.x, box.min.x), step(p.y, box.min.y), step(p.z, box.min.z)));
        if (isNew) joined.push_back(p);
        numbers[i] = number;
    }
    return numbers;
}

}  // namespace

Welded weld(const Mesh& mesh, std::uint64_t& skipped) {
    Welded w;
    const std::vector<std::uint32_t> numbers = joinPositions(mesh, w.positions);
    w.triangles.reserve(mesh.triangles.size());
    w.faceNormals.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        const std::size_t n = mesh.positions.size();
        if (t[0] >= n || t[1] >= n || t[2] >= n || !isFinite(mesh.positions[t[0]]) || !isFinite(mesh.positions[t[1]]) ||
            !isFinite(mesh.positions[t[2]])) {
            ++skipped;
            continue;
        }
        const Triangle joined{numbers[t[0]], numbers[t[1]], numbers[t[2]]};
        const Vec3f a = w.positions[joined[0]], ab = w.positions[joined[1]] - a, ac = w.positions[joined[2]] - a;
        const Vec3f normal = cross(ab, ac);
        // Slivers, as at the poles of a sphere: nothing to see, and a normal of rounding errors makes false creases.
        const float longest = std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)});
        if (!(length(normal) > 1e-5f * longest)) continue;
        w.triangles.push_back(joined);
        w.faceNormals.push_back(normal);
    }
    w.firstFace.assign(w.positions.size() + 1, 0);
    for (const Triangle& t : w.triangles)
        for (const std::uint32_t v : t) ++w.firstFace[v + 1];
    for (std::size_t v = 0; v < w.positions.size(); ++v) w.firstFace[v + 1] += w.firstFace[v];
    w.faces.resize(w.firstFace.back());
    std::vector<std::uint32_t> cursor(w.firstFace.begin(), w.firstFace.end() - 1);
    for (std::uint32_t f = 0; f < w.triangles.size(); ++f)
        for (const std::uint32_t v : w.triangles[f]) w.faces[cursor[v]++] = f;
    return w;
}

}  // namespace emca::explorer
