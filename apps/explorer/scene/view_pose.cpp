#include "view_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace emca::explorer {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Vec3d widened(Vec3f p) { return {p.x, p.y, p.z}; }

/// Some unit vector orthogonal to `d`, near `hint` if that is possible.
Vec3d orthogonal(Vec3d d, Vec3d hint) {
    Vec3d v = hint - d * dot(hint, d);
    if (length(v) < 1e-6) {
        const Vec3d other = std::abs(d.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        v = other - d * dot(other, d);
    }
    return normalize(v);
}

/// `v` turned around the unit vector `k` (Rodrigues' formula).
Vec3d rotated(Vec3d v, Vec3d k, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c));
}

struct Quaternion { double w = 1, x = 0, y = 0, z = 0; };

/// Rotation that takes the axes x, y, z to right, up and backwards (Shepperd's method).
Quaternion quaternionOf(Vec3d r, Vec3d u, Vec3d b) {
    const double trace = r.x + u.y + b.z;
    Quaternion q;
    if (trace > 0) {
        const double s = 2 * std::sqrt(trace + 1);
        q = {s / 4, (u.z - b.y) / s, (b.x - r.z) / s, (r.y - u.x) / s};
    } else if (r.x > u.y && r.x > b.z) {
        const double s = 2 * std::sqrt(1 + r.x - u.y - b.z);
        q = {(u.z - b.y) / s, s / 4, (u.x + r.y) / s, (b.x + r.z) / s};
    } else if (u.y > b.z) {
        const double s = 2 * std::sqrt(1 + u.y - r.x - b.z);
        q = {(b.x - r.z) / s, (u.x + r.y) / s, s / 4, (b.y + u.z) / s};
    } else {
        const double s = 2 * std::sqrt(1 + b.z - r.x - u.y);
        q = {(r.y - u.x) / s, (b.x + r.z) / s, (b.y + u.z) / s, s / 4};
    }
    return q;
}

Quaternion slerp(Quaternion a, Quaternion b, double t) {
    double c = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
    if (c < 0) {
        b = {-b.w, -b.x, -b.y, -b.z};
        c = -c;
    }
    double wa = 1 - t, wb = t;
    if (c < 0.9995) {
        const double angle = std::acos(c);
        wa = std::sin((1 - t) * angle) / std::sin(angle);
        wb = std::sin(t * angle) / std::sin(angle);
    }
    const Quaternion q{wa * a.w + wb * b.w, wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z};
    const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / n, q.x / n, q.y / n, q.z / n};
}

Vec3d turned(Quaternion q, Vec3d v) {
    const Vec3d u{q.x, q.y, q.z};
    return u * (2 * dot(u, v)) + v * (q.w * q.w - dot(u, u)) + cross(u, v) * (2 * q.w);
}

}  // namespace

Vec3d ViewPose::direction() const {
    const Vec3d d = focus - position;
    return length(d) > 0 ? normalize(d) : Vec3d{0, 0, -1};
}

Vec3d ViewPose::right() const { return normalize(cross(direction(), up)); }

double ViewPose::heightAtFocus() const { return 2 * distance() * std::tan(verticalFieldOfView * kDegree / 2); }

Projection::Projection(const ViewPose& pose, Viewport viewport)
    : position_(pose.position), right_(pose.right()), forward_(pose.direction()), viewport_(viewport),
      orthographic_(pose.orthographic) {
    up_ = cross(right_, forward_);
    scale_ = orthographic_ ? viewport.height / std::max(pose.heightAtFocus(), 1e-300)
                           : viewport.height / (2 * std::tan(pose.verticalFieldOfView * kDegree / 2));
}

std::optional<ScreenPoint> Projection::project(Vec3d p) const {
    const Vec3d v = p - position_;
    const double depth = dot(v, forward_);
    if (!isFinite(v) || (!orthographic_ && depth <= 0)) return std::nullopt;
    const double scale = orthographic_ ? scale_ : scale_ / depth;
    const ScreenPoint s{viewport_.width / 2.0 + dot(v, right_) * scale, viewport_.height / 2.0 - dot(v, up_) * scale, depth};
    return std::isfinite(s.x) && std::isfinite(s.y) ? std::optional(s) : std::nullopt;
}

ViewPose poseOfCamera(const Camera& camera, double imageAspect, double viewAspect, const BoundingBox& box, double focus) {
    ViewPose pose;
    pose.position = widened(camera.position);
    const Vec3d d = normalize(widened(camera.direction));
    pose.up = orthogonal(d, widened(camera.up));
    const bool hasAngle = camera.kind == CameraKind::perspective && camera.verticalFieldOfView > 0 &&
                          camera.verticalFieldOfView < 179;
    pose.verticalFieldOfView = hasAngle ? double(camera.verticalFieldOfView) : 60;
    if (imageAspect > 0 && viewAspect > 0 && imageAspect > viewAspect) {
        const double t = std::tan(pose.verticalFieldOfView * kDegree / 2) * imageAspect / viewAspect;
        pose.verticalFieldOfView = 2 * std::atan(t) / kDegree;
    }
    double distance = focus > 0 ? focus : double(camera.focusDistance);
    if (!box.empty && !(focus > 0)) {
        const double size = std::max(double(box.diagonal()), 1e-6);
        distance = std::max(dot(widened(box.centre()) - pose.position, d), 0.1 * size);
    }
    pose.focus = pose.position + d * (distance > 0 ? distance : 1);
    return pose;
}

ViewPose poseOfBox(const BoundingBox& box, double viewAspect) {
    ViewPose pose;
    const Vec3d centre = box.empty ? Vec3d{} : widened(box.centre());
    const double radius = box.empty ? 1 : std::max(double(box.diagonal()) / 2, 1e-6);
    const double half = pose.verticalFieldOfView * kDegree / 2;
    const double narrow = std::min(half, std::atan(std::tan(half) * viewAspect));
    const Vec3d d = normalize(Vec3d{-0.5, -0.35, -0.8});
    pose.focus = centre;
    pose.position = centre - d * (1.05 * radius / std::sin(narrow));
    pose.up = orthogonal(d, {0, 1, 0});
    return pose;
}

Vec3d nearestAxis(Vec3d v) {
    const std::size_t axis = std::abs(v.y) >= std::max(std::abs(v.x), std::abs(v.z)) ? 1 : std::abs(v.z) > std::abs(v.x) ? 2 : 0;
    Vec3d result;
    result[axis] = v[axis] < 0 ? -1 : 1;
    return result;
}

ViewPose lookingAt(const ViewPose& pose, Vec3d eye, Vec3d target) {
    if (!(length(target - eye) > 0)) return pose;
    ViewPose result = pose;
    result.position = eye;
    result.focus = target;
    result.up = orthogonal(normalize(target - eye), nearestAxis(pose.up));
    return result;
}

double eased(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

ViewPose between(const ViewPose& a, const ViewPose& b, double t) {
    if (t <= 0) return a;
    if (t >= 1) return b;
    const auto frame = [](const ViewPose& p) {
        const Vec3d d = p.direction(), r = p.right();
        return quaternionOf(r, cross(r, d), -d);
    };
    const Quaternion q = slerp(frame(a), frame(b), t);
    const double da = std::max(a.distance(), 1e-12), db = std::max(b.distance(), 1e-12);
    ViewPose pose = b;
    pose.focus = a.focus * (1 - t) + b.focus * t;
    pose.position = pose.focus + turned(q, {0, 0, 1}) * (da * std::pow(db / da, t));
    pose.up = turned(q, {0, 1, 0});
    pose.verticalFieldOfView = a.verticalFieldOfView * (1 - t) + b.verticalFieldOfView * t;
    return pose;
}

ViewPose orbited(const ViewPose& pose, Vec3d pivot, Vec3d axis, double yaw, double pitch) {
    const Vec3d d = pose.direction(), r = pose.right();
    // Keep 2 degrees away from looking straight along the axis, where left and right would swap.
    const double elevation = std::asin(std::clamp(dot(d, axis), -1.0, 1.0));
    const double limit = std::numbers::pi / 2 - 2 * kDegree;
    const double goal = std::clamp(elevation + pitch, std::min(-limit, elevation), std::max(limit, elevation));
    const auto apply = [&](Vec3d v) { return rotated(rotated(v, r, goal - elevation), axis, yaw); };
    ViewPose result = pose;
    result.position = pivot + apply(pose.position - pivot);
    result.focus = pivot + apply(pose.focus - pivot);
    result.up = orthogonal(result.direction(), apply(pose.up));
    return result;
}

ViewPose panned(const ViewPose& pose, Viewport viewport, double dx, double dy) {
    const double unit = pose.heightAtFocus() / std::max(viewport.height, 1);
    const Vec3d shift = pose.right() * (-dx * unit) + pose.up * (dy * unit);
    ViewPose result = pose;
    result.position += shift;
    result.focus += shift;
    return result;
}

ViewPose zoomed(const ViewPose& pose, Viewport viewport, double factor, double x, double y) {
    const double unit = pose.heightAtFocus() / std::max(viewport.height, 1);
    const Vec3d target = pose.focus + pose.right() * ((x - viewport.width / 2.0) * unit) -
                         pose.up * ((y - viewport.height / 2.0) * unit);
    ViewPose result = pose;
    result.position = target + (pose.position - target) * factor;
    result.focus = target + (pose.focus - target) * factor;
    return result;
}

ViewPose flown(const ViewPose& pose, double forward, double right, double up) {
    const Vec3d shift = pose.direction() * forward + pose.right() * right + pose.up * up;
    ViewPose result = pose;
    result.position += shift;
    result.focus += shift;
    return result;
}

ViewPose framed(const ViewPose& pose, Viewport viewport, std::span<const Vec3f> points, double margin,
                std::optional<Vec3f> interest) {
    const Vec3d d = pose.direction(), r = pose.right(), u = cross(r, d);
    const double inside = 1 - 2 * std::clamp(margin, 0.0, 0.45);
    const double ty = std::tan(pose.verticalFieldOfView * kDegree / 2) * inside;
    const double tx = std::tan(pose.verticalFieldOfView * kDegree / 2) * viewport.aspect() * inside;

    // An eye at (cx, cy, cz) in the view's own axes sees a point (x, y, z) inside if |x - cx| <= (z - cz) tx and the
    // same for y: four half-spaces per point, so that only the largest of each matters.
    constexpr double kNone = -std::numeric_limits<double>::infinity();
    double left = kNone, rightMost = kNone, bottom = kNone, top = kNone;
    double minX = -kNone, maxX = kNone, minY = -kNone, maxY = kNone, nearest = -kNone, farthest = kNone;
    for (const Vec3f& p : points) {
        if (!isFinite(p)) continue;
        const Vec3d v = widened(p) - pose.position;
        const double x = dot(v, r), y = dot(v, u), z = dot(v, d);
        rightMost = std::max(rightMost, x - z * tx);
        left = std::max(left, -x - z * tx);
        top = std::max(top, y - z * ty);
        bottom = std::max(bottom, -y - z * ty);
        minX = std::min(minX, x), maxX = std::max(maxX, x);
        minY = std::min(minY, y), maxY = std::max(maxY, y);
        nearest = std::min(nearest, z), farthest = std::max(farthest, z);
    }
    if (nearest > farthest) return pose;

    // A single point (or all at one place) leaves the distance free: keep a tenth of what it was.
    const double extent = std::max({maxX - minX, maxY - minY, farthest - nearest});
    const double least = std::max(0.5 * extent, 0.1 * pose.distance());
    ViewPose result = pose;
    double cx, cy, cz;
    const auto slack = [](double low, double high, double wish) {
        return low < high ? std::clamp(wish, low, high) : (low + high) / 2;
    };
    const std::optional<Vec3d> wish =
        interest && isFinite(*interest) ? std::optional(widened(*interest) - pose.position) : std::nullopt;
    const double wishX = wish ? ((minX + maxX) / 2 + dot(*wish, r)) / 2 : (minX + maxX) / 2;
    const double wishY = wish ? ((minY + maxY) / 2 + dot(*wish, u)) / 2 : (minY + maxY) / 2;
    if (pose.orthographic) {
        const double half = std::max({(maxY - minY) / (2 * ty), (maxX - minX) / (2 * tx), least});
        cx = slack(maxX - half * tx, minX + half * tx, wishX);
        cy = slack(maxY - half * ty, minY + half * ty, wishY);
        const double focusDepth = wish ? dot(*wish, d) : (nearest + farthest) / 2;
        cz = focusDepth - half;
    } else {
        cz = std::min({-(rightMost + left) / (2 * tx), -(top + bottom) / (2 * ty), nearest - least * 0.2});
        cz = std::min(cz, (wish ? dot(*wish, d) : farthest) - least);
        cx = slack(rightMost + cz * tx, -left - cz * tx, wishX);
        cy = slack(top + cz * ty, -bottom - cz * ty, wishY);
    }
    result.position = pose.position + r * cx + u * cy + d * cz;
    const double focusDepth = wish ? dot(*wish, d) : (nearest + farthest) / 2;
    result.focus = result.position + d * std::max(focusDepth - cz, least * 0.2);
    return result;
}

ViewPose framedIfNeeded(const ViewPose& pose, Viewport viewport, std::span<const Vec3f> points, double margin,
                        double minimumExtent, std::optional<Vec3f> interest) {
    const Projection projection(pose, viewport);
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    bool needed = false;
    for (const Vec3f& p : points) {
        if (!isFinite(p)) continue;
        const auto s = projection.project(p);
        if (!s || s->depth <= 0) {
            needed = true;
            break;
        }
        x0 = std::min(x0, s->x / viewport.width), x1 = std::max(x1, s->x / viewport.width);
        y0 = std::min(y0, s->y / viewport.height), y1 = std::max(y1, s->y / viewport.height);
    }
    if (!needed && x0 > x1) return pose;
    const bool outside = needed || x0 < margin || y0 < margin || x1 > 1 - margin || y1 > 1 - margin;
    const bool tiny = std::max(x1 - x0, y1 - y0) < minimumExtent;
    return outside || tiny ? framed(pose, viewport, points, margin, interest) : pose;
}

}  // namespace emca::explorer
