#include "surface_picker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace emca::explorer {
namespace {

constexpr std::uint32_t kBunch = 64;
constexpr double kNever = std::numeric_limits<double>::infinity();

Vec3d wide(Vec3f v) { return {v.x, v.y, v.z}; }

bool usable(const Mesh& mesh, const Triangle& t) {
    const std::size_t n = mesh.positions.size();
    return t[0] < n && t[1] < n && t[2] < n && isFinite(mesh.positions[t[0]]) && isFinite(mesh.positions[t[1]]) &&
           isFinite(mesh.positions[t[2]]);
}

/// Distance at which the ray enters the box; kNever if it misses it or the box is behind.
double entry(const Ray& ray, const Vec3d& inverse, Vec3f min, Vec3f max) {
    double near = 0, far = kNever;
    const double a[3] = {(double(min.x) - ray.origin.x) * inverse.x, (double(min.y) - ray.origin.y) * inverse.y,
                         (double(min.z) - ray.origin.z) * inverse.z};
    const double b[3] = {(double(max.x) - ray.origin.x) * inverse.x, (double(max.y) - ray.origin.y) * inverse.y,
                         (double(max.z) - ray.origin.z) * inverse.z};
    for (int i = 0; i < 3; ++i) {
        if (std::isnan(a[i]) || std::isnan(b[i])) continue;   // parallel to the slab and on its border
        near = std::max(near, std::min(a[i], b[i]));
        far = std::min(far, std::max(a[i], b[i]));
    }
    // Flat boxes have no room for rounding.
    return near <= far * (1 + 1e-9) ? near : kNever;
}

}  // namespace

Ray rayThrough(const ViewPose& pose, Viewport viewport, double x, double y, double behind) {
    const Vec3d forward = pose.direction(), right = pose.right(), up = cross(right, forward);
    const double dx = x - viewport.width / 2.0, dy = viewport.height / 2.0 - y;
    if (pose.orthographic) {
        const double unit = pose.heightAtFocus() / viewport.height;
        return {pose.position + right * (dx * unit) + up * (dy * unit) - forward * behind, forward};
    }
    const double unit = 2 * std::tan(pose.verticalFieldOfView * std::numbers::pi / 360) / viewport.height;
    return {pose.position, normalize(forward + right * (dx * unit) + up * (dy * unit))};
}

SurfacePicker::SurfacePicker(std::shared_ptr<const std::vector<Mesh>> meshes) : meshes_(std::move(meshes)) {
    if (!meshes_) return;
    for (std::uint32_t m = 0; m < meshes_->size(); ++m) {
        const Mesh& mesh = (*meshes_)[m];
        for (std::uint32_t first = 0; first < mesh.triangles.size(); first += kBunch) {
            const auto last = static_cast<std::uint32_t>(std::min<std::size_t>(first + kBunch, mesh.triangles.size()));
            BoundingBox box;
            for (std::uint32_t f = first; f < last; ++f) {
                if (!usable(mesh, mesh.triangles[f])) continue;
                for (const std::uint32_t v : mesh.triangles[f]) box.extend(mesh.positions[v]);
            }
            if (!box.empty) bunches_.push_back({box.min, box.max, m, first, last});
        }
    }
}

std::optional<SurfaceHit> SurfacePicker::pick(const Ray& ray, BackFaces backFaces) const {
    const Vec3d inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
    SurfaceHit front, back;
    front.distance = back.distance = kNever;
    for (const Bunch& bunch : bunches_) {
        const double limit = backFaces == BackFaces::show ? std::min(front.distance, back.distance) : front.distance;
        if (!(entry(ray, inverse, bunch.min, bunch.max) < limit)) continue;
        const Mesh& mesh = (*meshes_)[bunch.mesh];
        for (std::uint32_t f = bunch.first; f < bunch.last; ++f) {
            // Moeller and Trumbore 1997.
            const Triangle& t = mesh.triangles[f];
            if (!usable(mesh, t)) continue;
            const Vec3d a = wide(mesh.positions[t[0]]), ab = wide(mesh.positions[t[1]]) - a, ac = wide(mesh.positions[t[2]]) - a;
            const Vec3d p = cross(ray.direction, ac), s = ray.origin - a, q = cross(s, ab);
            const double determinant = dot(ab, p);
            if (determinant == 0) continue;
            const double u = dot(s, p) / determinant, v = dot(ray.direction, q) / determinant, distance = dot(ac, q) / determinant;
            if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) continue;
            SurfaceHit& best = determinant > 0 ? front : back;
            if (distance < best.distance)
                best = {bunch.mesh, f, static_cast<float>(u), static_cast<float>(v), distance, determinant < 0};
        }
    }
    if (backFaces == BackFaces::hide) back.distance = kNever;
    const bool takeBack = backFaces == BackFaces::show ? back.distance < front.distance : front.distance == kNever;
    const SurfaceHit& hit = takeBack ? back : front;
    return hit.distance < kNever ? std::optional(hit) : std::nullopt;
}

}  // namespace emca::explorer
