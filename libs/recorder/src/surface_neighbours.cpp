#include <algorithm>
#include <array>
#include <bit>

#include "surface_fill.h"

namespace emca::detail {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Number of the first vertex at the same position. -0 is 0; vertices that are not finite are only themselves.
std::vector<std::uint32_t> weld(const std::vector<Vec3f>& positions) {
    std::size_t capacity = std::bit_ceil(2 * positions.size() + 1);
    std::vector<std::uint32_t> slots(capacity, kNone), out(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const Vec3f p = positions[i];
        std::uint64_t hash = 0;
        for (const float f : {p.x, p.y, p.z})
            hash = (hash ^ std::bit_cast<std::uint32_t>(f + 0.f)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
        std::size_t slot = hash & (capacity - 1);
        while (slots[slot] != kNone && !(positions[slots[slot]] == p)) slot = (slot + 1) & (capacity - 1);
        if (slots[slot] == kNone || !isFinite(p)) slots[slot] = i;
        out[i] = slots[slot];
    }
    return out;
}

/// A mesh that refine() takes: triangles with missing vertices become degenerate.
Mesh sound(const SurfaceMeshView& view) {
    Mesh mesh;
    mesh.positions.assign(view.positions.begin(), view.positions.end());
    if (mesh.positions.empty()) mesh.positions.push_back({});
    mesh.triangles.assign(view.triangles.begin(), view.triangles.end());
    for (Triangle& t : mesh.triangles)
        if (*std::max_element(t.begin(), t.end()) >= mesh.positions.size()) t = {0, 0, 0};
    return mesh;
}

/// The refined faces on each edge.
class EdgeTable {
  public:
    EdgeTable(const RefinedMesh& mesh, std::size_t basePositions)
        : mesh_(mesh), basePositions_(basePositions), weld_(weld(mesh.positions)) {
        const std::size_t entries = 3 * mesh.triangles.size();
        slots_.assign(std::bit_ceil(2 * entries + 1), {0, kNone});
        next_.assign(entries, kNone);
        for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face)
            for (std::uint32_t side = 0; side < 3; ++side) {
                const auto [a, b] = edge(face, side);
                if (weld_[a] == weld_[b]) continue;
                Slot& slot = find(a, b);
                next_[3 * face + side] = slot.first;
                slot = {key(a, b), 3 * face + side};
            }
    }

    /// Calls `pair(face, other)` for each two faces on one edge, or on an edge and a part of it.
    template <typename Pair>
    void pairs(Pair pair) {
        for (std::uint32_t face = 0; face < mesh_.triangles.size(); ++face)
            for (std::uint32_t side = 0; side < 3; ++side) {
                auto [a, b] = edge(face, side);
                if (weld_[a] == weld_[b]) continue;
                // Each pair once: those before this one in the list. Where many faces share an edge (foliage made of
                // crossed planes, broken meshes), a few are enough.
                std::uint32_t other = next_[3 * face + side];
                for (int i = 0; other != kNone && i < 8; ++i, other = next_[other])
                    if (other / 3 != face) pair(face, other / 3);
                while (enclosing(a, b)) {
                    other = find(a, b).first;
                    for (int i = 0; other != kNone && i < 8; ++i, other = next_[other]) pair(face, other / 3);
                }
            }
    }

  private:
    struct Slot { std::uint64_t key; std::uint32_t first; };

    std::array<std::uint32_t, 2> edge(std::uint32_t face, std::uint32_t side) const {
        const Triangle& t = mesh_.triangles[face];
        return {t[side], t[side == 2 ? 0 : side + 1]};
    }
    std::uint64_t key(std::uint32_t a, std::uint32_t b) const {
        return std::uint64_t(std::max(weld_[a], weld_[b])) << 32 | std::min(weld_[a], weld_[b]);
    }
    Slot& find(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t k = key(a, b);
        std::size_t i = (k ^ k >> 29) * 0x9e3779b97f4a7c15u >> 20 & (slots_.size() - 1);
        while (slots_[i].first != kNone && slots_[i].key != k) i = (i + 1) & (slots_.size() - 1);
        return slots_[i];
    }
    /// From half an edge to the whole edge of the face above. False if it is no half.
    bool enclosing(std::uint32_t& a, std::uint32_t& b) const {
        for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
            if (b < basePositions_) continue;
            const auto [p, q] = mesh_.midpointOf[b - basePositions_];
            if (p != a && q != a) continue;
            b = p == a ? q : p;
            return true;
        }
        return false;
    }

    const RefinedMesh& mesh_;
    std::size_t basePositions_;
    std::vector<std::uint32_t> weld_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> next_;  ///< per side of a face: the next one on the same edge
};

}  // namespace

SurfaceNeighbours::SurfaceNeighbours(const SurfaceMeshView& view, const SurfaceSubdivision& subdivision,
                                     std::size_t faces)
    : begin_(faces + 1, 0) {
    const Mesh mesh = sound(view);
    const auto refined = refine(mesh, subdivision);
    if (!refined || refined->triangles.size() != faces) return;
    EdgeTable table(*refined, mesh.positions.size());
    std::vector<std::array<std::uint32_t, 2>> pairs;
    pairs.reserve(2 * faces);
    table.pairs([&](std::uint32_t a, std::uint32_t b) { pairs.push_back({a, b}); });
    for (const auto [a, b] : pairs) ++begin_[a + 1], ++begin_[b + 1];
    for (std::size_t face = 0; face < faces; ++face) begin_[face + 1] += begin_[face];
    list_.resize(2 * pairs.size());
    std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
    for (const auto [a, b] : pairs) {
        list_[next[a]++] = b;
        list_[next[b]++] = a;
    }
}

}  // namespace emca::detail
