#include <algorithm>
#include <bit>
#include <cmath>

#include "emca/core/surface_field.h"
#include "emca/core/surface_tree.h"

namespace emca {
namespace {

Error badBits(std::size_t baseFaces, const SurfaceSubdivision& subdivision, const char* what) {
    return {ErrorCode::protocolViolation, "The subdivision of a mesh with " + std::to_string(baseFaces) +
                                              " triangles has " + std::to_string(subdivision.bits.size()) + " bytes, " +
                                              what + "; collect the surface layers again."};
}

/// The checks that end every walk over the bits.
Result<void> finishWalk(std::size_t baseFaces, const SurfaceSubdivision& subdivision,
                        const detail::SubdivisionReader& reader, std::uint64_t faces) {
    if (faces > kMaxRefinedFaces) return badBits(baseFaces, subdivision, "which are more triangles than a mesh may have");
    if (reader.failed()) return badBits(baseFaces, subdivision, "which end before its last triangle");
    if (!reader.complete()) return badBits(baseFaces, subdivision, "which go on after its last triangle");
    return {};
}

/// Calls `begin(base face, its first bit, its first refined face)` for each base face; the number of refined faces.
template <typename Begin>
Result<std::uint32_t> walk(std::size_t baseFaces, const SurfaceSubdivision& subdivision, Begin begin) {
    detail::SubdivisionReader reader(subdivision.bits);
    std::uint64_t faces = 0;
    for (std::size_t face = 0; face < baseFaces && faces <= kMaxRefinedFaces && !reader.failed(); ++face) {
        begin(face, reader.position(), faces);
        // How many triangles of each level are still to be read: all that a pre-order walk has to remember.
        std::uint32_t left[kMaxSurfaceLevel + 1] = {1}, level = 0;
        while (!reader.failed()) {
            --left[level];
            if (reader.divided(level)) {
                left[++level] = 4;
                continue;
            }
            ++faces;
            while (level > 0 && left[level] == 0) --level;
            if (left[level] == 0) break;
        }
    }
    if (auto ok = finishWalk(baseFaces, subdivision, reader, faces); !ok) return ok.error();
    return static_cast<std::uint32_t>(faces);
}

/// Midpoint of each edge that was divided, by its two vertices: open addressing, since a mesh has millions.
class MidpointMap {
  public:
    /// The midpoint's index, or `fresh` (which is then kept) if the edge has none yet.
    std::uint32_t findOrAdd(std::uint32_t a, std::uint32_t b, std::uint32_t fresh) {
        if (2 * (count_ + 1) > keys_.size()) grow();
        const std::uint64_t key = std::uint64_t(std::max(a, b)) << 32 | std::min(a, b);
        std::size_t i = slot(key);
        for (; keys_[i] != kFree; i = (i + 1) & (keys_.size() - 1))
            if (keys_[i] == key) return midpoints_[i];
        keys_[i] = key;
        midpoints_[i] = fresh;
        ++count_;
        return fresh;
    }

  private:
    static constexpr std::uint64_t kFree = ~std::uint64_t(0);  // no edge: vertices stay below 2^32 - 1
    std::size_t slot(std::uint64_t key) const {
        return std::size_t((key ^ key >> 29) * 0x9e3779b97f4a7c15u >> shift_);
    }
    void grow() {
        std::vector<std::uint64_t> keys(std::max<std::size_t>(64, keys_.size() * 2), kFree);
        std::vector<std::uint32_t> midpoints(keys.size());
        keys.swap(keys_);
        midpoints.swap(midpoints_);
        shift_ = 64 - std::countr_zero(keys_.size());
        for (std::size_t k = 0; k < keys.size(); ++k) {
            if (keys[k] == kFree) continue;
            std::size_t i = slot(keys[k]);
            while (keys_[i] != kFree) i = (i + 1) & (keys_.size() - 1);
            keys_[i] = keys[k];
            midpoints_[i] = midpoints[k];
        }
    }
    std::vector<std::uint64_t> keys_;
    std::vector<std::uint32_t> midpoints_;
    std::size_t count_ = 0;
    int shift_ = 64;
};

/// Divides the triangles of one mesh.
class Refiner {
  public:
    Refiner(const Mesh& mesh, std::size_t faces) : out_{mesh.positions, {}, {}, {}} {
        out_.triangles.reserve(faces);
        out_.baseFace.reserve(faces);
    }

    /// One base face with all that is below it.
    void add(std::uint32_t face, const Triangle& triangle, detail::SubdivisionReader& reader) {
        stack_.assign(1, {triangle, 0});
        while (!stack_.empty()) {
            const auto [t, level] = stack_.back();
            stack_.pop_back();
            if (!reader.divided(level)) {
                out_.triangles.push_back(t);
                out_.baseFace.push_back(face);
                continue;
            }
            const std::uint32_t m01 = midpoint(t[0], t[1]), m12 = midpoint(t[1], t[2]), m20 = midpoint(t[2], t[0]);
            stack_.push_back({{m12, m20, m01}, level + 1});
            stack_.push_back({{m20, m12, t[2]}, level + 1});
            stack_.push_back({{m01, t[1], m12}, level + 1});
            stack_.push_back({{t[0], m01, m20}, level + 1});
        }
    }
    RefinedMesh take() { return std::move(out_); }

  private:
    std::uint32_t midpoint(std::uint32_t a, std::uint32_t b) {
        const auto fresh = static_cast<std::uint32_t>(out_.positions.size());
        const std::uint32_t found = midpoints_.findOrAdd(a, b, fresh);
        if (found == fresh) {
            // Halves first: the sum of two large coordinates may not be finite.
            out_.positions.push_back(out_.positions[a] * 0.5f + out_.positions[b] * 0.5f);
            out_.midpointOf.push_back({a, b});
        }
        return found;
    }

    struct Item { Triangle triangle; std::uint32_t level; };
    RefinedMesh out_;
    MidpointMap midpoints_;
    std::vector<Item> stack_;
};

}  // namespace

Result<std::uint32_t> refinedFaceCount(std::size_t baseFaces, const SurfaceSubdivision& subdivision) {
    return walk(baseFaces, subdivision, [](std::size_t, std::uint64_t, std::uint64_t) {});
}

Result<RefinedMesh> refine(const Mesh& mesh, const SurfaceSubdivision& subdivision) {
    if (auto ok = validate(mesh); !ok) return ok.error();
    const auto count = refinedFaceCount(mesh.triangles.size(), subdivision);
    if (!count) return count.error();
    // A division adds three faces and at most three vertices.
    if (mesh.positions.size() + *count >= 0xffffffffu)
        return badBits(mesh.triangles.size(), subdivision, "which are more vertices than a mesh may have");
    Refiner refiner(mesh, *count);
    detail::SubdivisionReader reader(subdivision.bits);
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) refiner.add(face, mesh.triangles[face], reader);
    return refiner.take();
}

Result<SurfaceLocator> SurfaceLocator::make(std::size_t baseFaces, const SurfaceSubdivision& subdivision) {
    SurfaceLocator locator;
    if (!subdivision.bits.empty()) locator.starts_.reserve(std::min<std::size_t>(baseFaces, subdivision.bits.size() * 8));
    const auto count = walk(baseFaces, subdivision, [&](std::size_t, std::uint64_t bit, std::uint64_t face) {
        if (!subdivision.bits.empty()) locator.starts_.push_back({bit, static_cast<std::uint32_t>(face)});
    });
    if (!count) return count.error();
    locator.bits_ = subdivision.bits;
    locator.baseFaces_ = static_cast<std::uint32_t>(baseFaces);
    locator.count_ = *count;
    return locator;
}

std::optional<std::uint32_t> SurfaceLocator::refinedFace(std::uint32_t face, float fu, float fv) const {
    if (face >= baseFaces_ || !std::isfinite(fu) || !std::isfinite(fv)) return std::nullopt;
    if (starts_.empty()) return face;
    std::uint32_t u = 0, v = 0;
    detail::toFixed(fu, fv, u, v);
    std::uint64_t bit = starts_[face].bit;
    std::uint32_t refined = starts_[face].face;
    for (std::uint32_t level = 0;; ++level) {
        if (level == kMaxSurfaceLevel) return refined;
        const bool divided = bits_[bit / 8] >> (bit % 8) & 1;
        ++bit;
        if (!divided) return refined;
        // Jump over the children before the right one.
        std::uint32_t skip = detail::descend(u, v);
        std::uint32_t left[kMaxSurfaceLevel + 2] = {}, depth = level + 1;
        for (left[depth] = skip; left[depth] > 0;) {
            --left[depth];
            if (depth < kMaxSurfaceLevel && (bits_[bit / 8] >> (bit % 8) & 1)) {
                ++bit;
                left[++depth] = 4;
                continue;
            }
            if (depth < kMaxSurfaceLevel) ++bit;
            ++refined;
            while (depth > level + 1 && left[depth] == 0) --depth;
        }
    }
}

std::optional<Vec2f> barycentrics(const Mesh& mesh, std::uint32_t face, Vec3f p) {
    if (face >= mesh.triangles.size()) return std::nullopt;
    const Triangle t = mesh.triangles[face];
    for (const std::uint32_t index : t)
        if (index >= mesh.positions.size()) return std::nullopt;
    const auto wide = [](Vec3f q) { return Vec3d{double(q.x), double(q.y), double(q.z)}; };
    const auto to = [&](Vec3f q) { return wide(q) - wide(mesh.positions[t[0]]); };
    const Vec3d e1 = to(mesh.positions[t[1]]), e2 = to(mesh.positions[t[2]]), d = to(p), n = cross(e1, e2);
    const double nn = dot(n, n);
    if (!(nn > 0) || !std::isfinite(nn) || !isFinite(d)) return std::nullopt;
    return Vec2f{float(dot(cross(d, e2), n) / nn), float(dot(cross(e1, d), n) / nn)};
}

}  // namespace emca
