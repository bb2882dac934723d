#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "emca/analysis/format.h"
#include "emca/analysis/surface_name.h"
#include "emca/core/seed_map.h"
#include "emca/doctor/path_checks.h"
#include "triangle_distance.h"
#include "words.h"

namespace emca::doctor {
namespace {

using analysis::formatNumber;
using Corners = std::array<Vec3d, 3>;

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }

Corners cornersOf(const Mesh& mesh, std::size_t face) {
    const Triangle& t = mesh.triangles[face];
    return {toDouble(mesh.positions[t[0]]), toDouble(mesh.positions[t[1]]), toDouble(mesh.positions[t[2]])};
}

/// Of "pixel (3, 4), path 7, …" what a person does not read beside the pixel already.
std::string withoutPixel(const std::string& example) {
    const std::size_t end = example.find("), ");
    return end == std::string::npos ? example : example.substr(end + 3);
}

/// Relative to a mesh's size: hits of other arithmetic than ours, and offsets against self-intersection of that order.
constexpr double kTolerance = 1e-4, kOffsetTolerance = 1e-3;
/// Of coordinates, which are floats.
constexpr double kRounding = 1e-6;

}  // namespace

/// How far a shape that a mesh stands for may bulge out of each of its triangles. A smooth shape shows by neighbours that
/// are turned against each other a little: an arc of height h and turn theta bulges by about h theta / 8 (the sagitta).
class SurfaceCheck::Curvature {
  public:
    /// \param size  of the mesh, its diagonal
    Curvature(const Mesh& mesh, double size) : mesh_(mesh), cell_(size > 0 ? 1e-6 * size : 1) {
        edges_.reserve(3 * mesh.triangles.size());
        for (std::size_t face = 0; face < mesh.triangles.size(); ++face)
            for (int i = 0; i < 3; ++i) edges_.push_back({key(face, i), static_cast<std::uint32_t>(face)});
        std::sort(edges_.begin(), edges_.end());
    }

    double bulge(std::size_t face) const {
        const Vec3d normal = normalOf(face);
        const Corners corners = cornersOf(mesh_, face);
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const double edge = length(corners[(i + 1) % 3] - corners[i]);
            const double height = edge > 0 ? length(cross(corners[(i + 1) % 3] - corners[i], corners[(i + 2) % 3] - corners[i])) / edge : 0;
            double turn = 0;
            for (const auto& [shared, other] : sharing(face, i)) {
                const double cosine = std::clamp(std::abs(dot(normal, normalOf(other))), 0.0, 1.0);
                const double angle = std::acos(cosine);
                if (angle < std::numbers::pi / 3) turn = std::max(turn, angle);  // beyond: a crease
            }
            sum += height * turn;
        }
        return sum / 4;  // both directions, and twice the estimate
    }

    /// Triangles without area (a sphere has some around its poles) that stand for a part of the shape all the same: who
    /// shares an edge with them. Of others nobody.
    std::vector<std::uint32_t> insteadOf(std::size_t face) const {
        std::vector<std::uint32_t> others;
        const Corners c = cornersOf(mesh_, face);
        const double longest = std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
        if (length(cross(c[1] - c[0], c[2] - c[0])) > 1e-5 * longest * longest) return others;
        for (int i = 0; i < 3; ++i)
            for (const auto& [edge, other] : sharing(face, i))
                if (other != face) others.push_back(other);
        return others;
    }

    /// Where an edge belongs to one triangle, a disc may reach beyond it.
    double overhang(std::size_t face, int edge) const {
        if (edge < 0 || sharing(face, edge).size() != 1) return 0;
        const Corners corners = cornersOf(mesh_, face);
        return 0.05 * length(corners[(edge + 1) % 3] - corners[edge]);
    }

  private:
    using Edge = std::pair<std::uint64_t, std::uint32_t>;  ///< its key, a triangle that has it
    /// The triangles that have an edge of this one, it among them.
    std::span<const Edge> sharing(std::size_t face, int i) const {
        const std::uint64_t wanted = key(face, i);
        const auto first = std::lower_bound(edges_.begin(), edges_.end(), Edge{wanted, 0});
        auto last = first;
        while (last != edges_.end() && last->first == wanted) ++last;
        return {first, last};
    }
    /// By positions, rounded: meshes often split vertices along seams. A hash, since large meshes have many edges.
    std::uint64_t key(std::size_t face, int i) const {
        const Triangle& t = mesh_.triangles[face];
        const auto place = [&](int corner) {
            const Vec3f p = mesh_.positions[t[corner]];
            const auto rounded = [&](float x) { return std::isfinite(x) ? static_cast<std::int64_t>(std::llround(std::clamp(double(x) / cell_, -1e18, 1e18))) : 0; };
            return std::array<std::int64_t, 3>{rounded(p.x), rounded(p.y), rounded(p.z)};
        };
        std::array<std::int64_t, 3> a = place(i), b = place((i + 1) % 3);
        if (b < a) std::swap(a, b);
        std::uint64_t hash = 0;
        for (const std::int64_t part : {a[0], a[1], a[2], b[0], b[1], b[2]}) hash = mix64(hash ^ static_cast<std::uint64_t>(part)) + 1;
        return hash;
    }
    Vec3d normalOf(std::size_t face) const {
        const Corners c = cornersOf(mesh_, face);
        return normalize(cross(c[1] - c[0], c[2] - c[0]));
    }
    const Mesh& mesh_;
    const double cell_;
    std::vector<Edge> edges_;
};

SurfaceCheck::SurfaceCheck(const std::vector<Mesh>& meshes) : meshes_(meshes) {
    for (const Mesh& mesh : meshes) {
        BoundingBox box;
        for (const Vec3f p : mesh.positions)
            if (isFinite(p)) box.extend(p);
        sizes_.push_back(double(box.diagonal()));
    }
    scene_ = double(boundingBox(meshes).diagonal());
}

SurfaceCheck::~SurfaceCheck() = default;

void SurfaceCheck::note(Off& off, double distance, const PathSet& paths, Index vertex, std::string surface) {
    if (off.count++ > 0 && !(distance > off.distance)) return;
    off.distance = distance;
    off.example = fmt::format("{}, on {}", placeName(paths, vertex), surface);
    off.pixel = paths.pixel(paths.pathOf(vertex));
}

void SurfaceCheck::add(const PathSet& paths) {
    for (Index v = 0; v < paths.vertexCount(); ++v) {
        const auto surface = paths.surface(v);
        if (!surface) continue;
        ++surfaces_;
        const bool known = surface->mesh >= 0 && std::size_t(surface->mesh) < meshes_.size() && surface->face >= 0 &&
                           std::size_t(surface->face) < meshes_[surface->mesh].triangles.size();
        if (!known) {
            note(outOfRange_, 0, paths, v, fmt::format("mesh {}, face {}", surface->mesh, surface->face));
            continue;
        }
        const auto position = paths.position(v);
        if (position && isFinite(*position) && !paths.isEnvironment(v)) place(paths, v, *surface, *position);
    }
}

void SurfaceCheck::place(const PathSet& paths, Index vertex, PathSet::Surface surface, Vec3f position) {
    const std::size_t mesh = std::size_t(surface.mesh), face = std::size_t(surface.face);
    const Corners c = cornersOf(meshes_[mesh], face);
    if (!isFinite(c[0]) || !isFinite(c[1]) || !isFinite(c[2])) return;
    ++placed_;
    const Vec3d p = toDouble(position);
    const NearestPoint nearest = nearestPoint(p, c[0], c[1], c[2]);
    const double distance = length(p - nearest.point);
    const double rounding = kRounding * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (distance <= kTolerance * sizes_[mesh] + rounding) return;
    const std::string name = analysis::surfaceName(surface, meshes_);
    auto& curvature = curvatures_[mesh];
    if (!curvature) curvature = std::make_unique<Curvature>(meshes_[mesh], sizes_[mesh]);
    const double tolerance = kTolerance * sizes_[mesh] + rounding;
    bool curved = distance <= curvature->bulge(face) + curvature->overhang(face, nearest.edge) + tolerance;
    for (const std::uint32_t other : curvature->insteadOf(face)) {
        const Corners o = cornersOf(meshes_[mesh], other);
        curved = curved || length(p - nearestPoint(p, o[0], o[1], o[2]).point) <= curvature->bulge(other) + tolerance;
    }
    if (curved) return note(curved_, distance, paths, vertex, name);
    note(distance <= kOffsetTolerance * sizes_[mesh] + rounding ? slightly_ : off_, distance, paths, vertex, name);
}

Finding SurfaceCheck::finding() const {
    Finding finding{.check = "surfaces"};
    finding.count("surfaces", surfaces_);
    finding.count("outOfRange", outOfRange_.count);
    finding.count("onCurvedShapes", curved_.count);
    finding.count("slightlyOff", slightly_.count);
    finding.count("off", off_.count);
    finding.add("largestDistance", std::max({curved_.distance, slightly_.distance, off_.distance}));
    finding.add("sceneSize", scene_);
    if (surfaces_ == 0) {
        finding.outcome = Outcome::skipped;
        finding.sentence = "No vertex says on which triangle it lies (setIntersectionSurface): surface layers and queries by mesh will be missing.";
        return finding;
    }
    finding.sentence = fmt::format("{} of {} on the triangle that they name", placed_ - curved_.count - slightly_.count - off_.count, counted(surfaces_, "vertex is", "vertices are"));
    if (curved_.count > 0) finding.sentence += fmt::format(", {} beside one by as much as a curved shape bulges ({} at most)", curved_.count, formatNumber(curved_.distance));
    finding.sentence += '.';
    if (outOfRange_.count > 0) {
        finding.complain(Outcome::failed, fmt::format("{} name a mesh or face that the scene does not have, first {}.", outOfRange_.count, outOfRange_.example),
                         "The mesh is the place in the list of meshes(), the face the place in Mesh::triangles, both from 0.");
        finding.pixels.push_back({outOfRange_.pixel, withoutPixel(outOfRange_.example)});
    }
    if (slightly_.count > 0) {
        finding.complain(Outcome::warning, fmt::format("{} a little beside their triangle, by {} at most ({}).", counted(slightly_.count, "lies", "lie"), formatNumber(slightly_.distance), slightly_.example),
                         "Record the intersection itself, not the point that is moved off the surface for the next ray.");
        finding.pixels.push_back({slightly_.pixel, withoutPixel(slightly_.example)});
    }
    if (off_.count > 0) {
        finding.complain(Outcome::failed, fmt::format("{} off their triangle, by {} at most ({}); the scene is {} large.", counted(off_.count, "is", "are"), formatNumber(off_.distance), off_.example, formatNumber(scene_)),
                         "Mesh and face must be those of meshes() and positions in world space: look for another order of meshes, faces reordered by the acceleration structure, instances without their transform.");
        finding.pixels.push_back({off_.pixel, withoutPixel(off_.example)});
    }
    return finding;
}

}  // namespace emca::doctor
