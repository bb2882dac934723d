#include "mesh_budget.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace emca::cli {
namespace {

struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};
struct CellHash {
    std::size_t operator()(const Cell& c) const {
        const auto mix = [](std::uint64_t v) { return (v ^ v >> 31) * 0x9e3779b97f4a7c15u; };
        return static_cast<std::size_t>(mix(mix(mix(static_cast<std::uint64_t>(c.x)) + static_cast<std::uint64_t>(c.y)) + static_cast<std::uint64_t>(c.z)));
    }
};

bool isFinite(Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Which vertex stands for each vertex: itself, or the first of its cell.
std::vector<std::uint32_t> representatives(const Mesh& mesh, double cell) {
    std::vector<std::uint32_t> stands(mesh.positions.size());
    std::unordered_map<Cell, std::uint32_t, CellHash> first;
    for (std::uint32_t i = 0; i < stands.size(); ++i) {
        const Vec3f p = mesh.positions[i];
        stands[i] = i;
        if (cell <= 0 || !isFinite(p)) continue;
        const auto along = [&](float v) { return static_cast<std::int64_t>(std::clamp(std::floor(static_cast<double>(v) / cell), -9e17, 9e17)); };
        stands[i] = first.try_emplace({along(p.x), along(p.y), along(p.z)}, i).first->second;
    }
    return stands;
}

/// The triangles that are left, with vertices numbered anew.
Mesh withCells(const Mesh& mesh, double cell) {
    Mesh out = mesh;
    out.positions.clear();
    out.triangles.clear();
    constexpr std::uint32_t kNone = 0xffffffffu;
    const std::vector<std::uint32_t> stands = representatives(mesh, cell);
    std::vector<std::uint32_t> numbers(mesh.positions.size(), kNone);
    for (Triangle triangle : mesh.triangles) {
        for (std::uint32_t& v : triangle) v = stands[v];
        const auto [a, b, c] = triangle;
        if (a == b || b == c || c == a) continue;
        if (!isFinite(mesh.positions[a]) || !isFinite(mesh.positions[b]) || !isFinite(mesh.positions[c])) continue;
        for (std::uint32_t& v : triangle) {
            if (numbers[v] == kNone) {
                numbers[v] = static_cast<std::uint32_t>(out.positions.size());
                out.positions.push_back(mesh.positions[v]);
            }
            v = numbers[v];
        }
        out.triangles.push_back(triangle);
    }
    return out;
}

/// Edge of the cells to begin with: about that of a triangle, if the budget's triangles shared the surface.
double firstCell(const std::vector<Mesh>& meshes, std::uint64_t maximumTriangles) {
    double area = 0;
    for (const Mesh& mesh : meshes)
        for (const auto& [a, b, c] : mesh.triangles) {
            const double twice = static_cast<double>(length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])));
            if (std::isfinite(twice)) area += twice / 2;
        }
    const double diagonal = static_cast<double>(boundingBox(meshes).diagonal());
    return std::max(std::sqrt(area / static_cast<double>(maximumTriangles)) / 8, diagonal * 1e-6);
}

}  // namespace

ReducedMeshes reduceMeshes(const std::vector<Mesh>& meshes, std::uint64_t maximumTriangles) {
    ReducedMeshes out;
    for (const Mesh& mesh : meshes) out.before += mesh.triangles.size();
    const auto apply = [&](double cell) {
        out.meshes.clear();
        out.triangles = 0;
        for (const Mesh& mesh : meshes) {
            out.meshes.push_back(withCells(mesh, cell));
            out.triangles += out.meshes.back().triangles.size();
        }
    };
    apply(0);
    if (out.triangles <= maximumTriangles) return out;
    if (maximumTriangles > 0) {
        double cell = firstCell(meshes, maximumTriangles);
        // Eighty steps are a factor of a billion: then a mesh is one cell.
        for (int step = 0; step < 80 && cell > 0 && out.triangles > maximumTriangles; ++step, cell *= 1.3) apply(cell);
    }
    if (out.triangles <= maximumTriangles) return out;
    // What no cell makes small enough: thousands of tiny meshes across cell borders. The largest ones stay.
    std::vector<std::size_t> order(out.meshes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto size = [&](std::size_t i) { return boundingBox({out.meshes[i]}).diagonal(); };
    std::vector<float> sizes;
    for (std::size_t i = 0; i < order.size(); ++i) sizes.push_back(size(i));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    out.triangles = 0;
    for (const std::size_t i : order) {
        Mesh& mesh = out.meshes[i];
        if (out.triangles + mesh.triangles.size() > maximumTriangles) {
            mesh.triangles.clear();
            mesh.positions.clear();
        }
        out.triangles += mesh.triangles.size();
    }
    return out;
}

}  // namespace emca::cli
