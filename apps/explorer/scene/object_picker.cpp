#include "object_picker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "object_geometry.h"
#include "scene_picker.h"

namespace emca::explorer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Vec3d wide(Vec3f v) { return {v.x, v.y, v.z}; }

/// The interval of a ray inside a slab, cut from [near, far]. False: nothing is left.
bool cutBySlab(double origin, double direction, double low, double high, double& near, double& far) {
    if (direction == 0) return origin >= low && origin <= high;
    const double a = (low - origin) / direction, b = (high - origin) / direction;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
    return near <= far;
}

struct Nearest {
    std::optional<std::size_t> element;
    double depth = kNever;
    void offer(std::size_t candidate, double at) {
        if (at >= depth) return;
        element = candidate;
        depth = at;
    }
};

/// Points and lines.
std::optional<std::pair<std::size_t, double>> pickStrokes(const SceneObject& object, const Projection& projection, double x, double y) {
    if (const auto* points = std::get_if<PointSet>(&object.shape)) {
        const auto hit = pickPoint(projection, points->points, x, y, std::max(double(points->size) / 2 + 2, 5.0));
        if (!hit) return std::nullopt;
        return std::pair<std::size_t, double>(*hit, projection.project(points->points[*hit])->depth);
    }
    std::vector<PickSegment> segments;
    if (const auto* arrows = std::get_if<ArrowSet>(&object.shape))
        for (std::uint32_t i = 0; i < arrows->arrows.size(); ++i) segments.push_back({arrows->arrows[i].from, arrows->arrows[i].to, i});
    if (const auto* boxes = std::get_if<BoxSet>(&object.shape))
        for (std::uint32_t i = 0; i < boxes->boxes.size(); ++i)
            for (const Edge& e : edgesOf(boxes->boxes[i])) segments.push_back({e.from, e.to, i});
    const auto hit = pickSegment(projection, segments, x, y, kLineRadius);
    return hit ? std::optional(std::pair<std::size_t, double>(*hit, 0.0)) : std::nullopt;
}

}  // namespace

std::optional<double> distanceTo(const ObjectBox& box, const Ray& ray) {
    // In the box's own axes it is a cube from -1 to 1 (Cramer's rule).
    const Vec3d x = wide(box.x), y = wide(box.y), z = wide(box.z), o = ray.origin - wide(box.centre), d = ray.direction;
    const double determinant = dot(x, cross(y, z));
    if (!(std::abs(determinant) > 0)) return std::nullopt;
    const Vec3d rows[3] = {cross(y, z) / determinant, cross(z, x) / determinant, cross(x, y) / determinant};
    double near = 0, far = kNever;
    for (const Vec3d& row : rows)
        if (!cutBySlab(dot(row, o), dot(row, d), -1, 1, near, far)) return std::nullopt;
    return near > 0 ? near : far;
}

std::optional<std::pair<std::size_t, double>> firstCell(const VoxelGrid& grid, std::span<const float> values, const Ray& ray) {
    const Vec3d cell = wide(grid.cell), origin = wide(grid.origin);
    double near = 0, far = kNever;
    for (std::size_t a = 0; a < 3; ++a)
        if (!cutBySlab(ray.origin[a], ray.direction[a], origin[a], origin[a] + cell[a] * grid.size[a], near, far)) return std::nullopt;
    std::int64_t at[3];
    double next[3], step[3];
    for (std::size_t a = 0; a < 3; ++a) {
        if (grid.size[a] == 0) return std::nullopt;
        const double place = (ray.origin[a] + near * ray.direction[a] - origin[a]) / cell[a];
        at[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(place)), 0, std::int64_t(grid.size[a]) - 1);
        const double d = ray.direction[a];
        step[a] = d == 0 ? kNever : cell[a] / std::abs(d);
        const double border = origin[a] + cell[a] * double(at[a] + (d > 0 ? 1 : 0));
        next[a] = d == 0 ? kNever : (border - ray.origin[a]) / d;
    }
    double distance = near;
    while (true) {
        const std::size_t i = (std::size_t(at[2]) * grid.size[1] + std::size_t(at[1])) * grid.size[0] + std::size_t(at[0]);
        if (i < values.size() && isShown(grid, values[i])) return std::pair(i, distance);
        const std::size_t a = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
        if (next[a] == kNever) return std::nullopt;
        distance = next[a];
        next[a] += step[a];
        at[a] += ray.direction[a] > 0 ? 1 : -1;
        if (at[a] < 0 || at[a] >= std::int64_t(grid.size[a])) return std::nullopt;
    }
}

std::optional<ObjectHit> ObjectPicker::pick(std::span<const SceneObjects::Entry> entries, const Projection& projection, const Ray& ray,
                                            double x, double y) {
    std::optional<ObjectHit> best;
    const auto offer = [&](const SceneObjects::Entry& entry, const std::optional<std::pair<std::size_t, double>>& hit) {
        if (hit && (!best || hit->second < best->depth)) best = ObjectHit{entry.id, hit->first, hit->second};
    };
    for (const SceneObjects::Entry& entry : entries)
        if (entry.visible && entry.object->opacity > 0) offer(entry, pickStrokes(*entry.object, projection, x, y));
    if (best) return best;
    for (const SceneObjects::Entry& entry : entries) {
        const SceneObject& object = *entry.object;
        if (!entry.visible || !(object.opacity > 0)) continue;
        if (const auto* grid = std::get_if<VoxelGrid>(&object.shape)) offer(entry, firstCell(*grid, object.colors.values, ray));
        if (const auto* boxes = std::get_if<BoxSet>(&object.shape); boxes && boxes->filled > 0) {
            Nearest nearest;
            for (std::size_t i = 0; i < boxes->boxes.size(); ++i)
                if (const auto distance = distanceTo(boxes->boxes[i], ray)) nearest.offer(i, *distance);
            if (nearest.element) offer(entry, std::pair(*nearest.element, nearest.depth));
        }
        if (const auto* set = std::get_if<TriangleSet>(&object.shape)) {
            auto& [owner, picker] = triangles_[&object];
            if (!owner) {
                owner = entry.object;
                Mesh mesh;
                mesh.positions = set->positions;
                mesh.triangles = set->triangles;
                picker = SurfacePicker(std::make_shared<const std::vector<Mesh>>(1, std::move(mesh)));
            }
            if (const auto hit = picker.pick(ray, BackFaces::show)) offer(entry, std::pair<std::size_t, double>(hit->face, hit->distance));
        }
    }
    return best;
}

void ObjectPicker::tidy(std::span<const SceneObjects::Entry> entries) {
    std::erase_if(triangles_, [&](const auto& kept) {
        return std::ranges::none_of(entries, [&](const SceneObjects::Entry& e) { return e.object.get() == kept.first; });
    });
}

}  // namespace emca::explorer
