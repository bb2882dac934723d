#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "emca/doctor/scene_checks.h"
#include "words.h"

namespace emca::doctor {
namespace {

using analysis::formatNumber;

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }

bool usesFieldOfView(const Camera& camera) { return camera.kind == CameraKind::perspective; }

void checkNumbers(const Camera& camera, Finding& finding) {
    const bool finite = isFinite(camera.position) && isFinite(camera.direction) && isFinite(camera.up) && std::isfinite(camera.verticalFieldOfView) &&
                        std::isfinite(camera.focusDistance) && std::isfinite(camera.apertureRadius) && !std::isnan(camera.nearClip) && !std::isnan(camera.farClip);
    if (!finite) finding.complain(Outcome::failed, "It has a NaN or an infinity.", "Look at the matrix that camera() reads.");
    const double direction = length(toDouble(camera.direction)), up = length(toDouble(camera.up));
    const double cosine = dot(toDouble(camera.direction), toDouble(camera.up));
    finding.add("directionLength", direction);
    finding.add("upLength", up);
    finding.add("directionDotUp", cosine);
    if (!(std::abs(direction - 1) <= 1e-3))
        finding.complain(Outcome::failed, fmt::format("Its direction is {} long.", formatNumber(direction)), "Return unit vectors: normalize(direction), normalize(up).");
    if (!(std::abs(up - 1) <= 1e-3))
        finding.complain(Outcome::failed, fmt::format("Its up vector is {} long.", formatNumber(up)), "Return unit vectors: normalize(direction), normalize(up).");
    if (std::abs(direction - 1) <= 1e-3 && std::abs(up - 1) <= 1e-3 && !(std::abs(cosine) <= 1e-3))
        finding.complain(Outcome::failed, fmt::format("Direction and up are not orthogonal: their cosine is {}.", formatNumber(cosine)),
                         "Take the image's upward direction, not the scene's: up = cross(right, direction).");
    if (usesFieldOfView(camera) && !(camera.verticalFieldOfView > 0 && camera.verticalFieldOfView < 180))
        finding.complain(Outcome::failed, fmt::format("Its vertical field of view is {} degrees.", formatNumber(double(camera.verticalFieldOfView))),
                         "Give degrees from the top to the bottom edge of the image, between 0 and 180.");
    else if (usesFieldOfView(camera) && camera.verticalFieldOfView < 0.5f)
        finding.complain(Outcome::warning, fmt::format("Its vertical field of view is only {} degrees.", formatNumber(double(camera.verticalFieldOfView))),
                         "Degrees are meant, not radians.");
    if (!(camera.nearClip < camera.farClip))
        finding.complain(Outcome::failed, fmt::format("Near {} is not before far {}.", formatNumber(double(camera.nearClip)), formatNumber(double(camera.farClip))),
                         "Give distances along the direction, near before far; the defaults do where the renderer has none.");
    else if (camera.nearClip < 0)
        finding.complain(Outcome::warning, fmt::format("Near {} lies behind the camera.", formatNumber(double(camera.nearClip))), "Give distances along the direction.");
    if (camera.focusDistance < 0 || camera.apertureRadius < 0)
        finding.complain(Outcome::warning, "Focus distance or aperture is negative.", "Give 0 for a pinhole.");
}

/// Depth of the box along the view: nearest and farthest corner.
std::array<double, 2> depths(const Camera& camera, const BoundingBox& box) {
    std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3f p{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z};
        const double depth = dot(toDouble(p - camera.position), toDouble(camera.direction));
        range = {std::min(range[0], depth), std::max(range[1], depth)};
    }
    return range;
}

double distanceTo(const BoundingBox& box, Vec3f p) {
    const auto outside = [](float x, float low, float high) { return double(std::max({low - x, x - high, 0.f})); };
    return length(Vec3d{outside(p.x, box.min.x, box.max.x), outside(p.y, box.min.y, box.max.y), outside(p.z, box.min.z, box.max.z)});
}

void checkPlace(const Camera& camera, const BoundingBox& scene, Finding& finding) {
    const double size = double(scene.diagonal()), distance = distanceTo(scene, camera.position);
    finding.add("distanceToBox", distance);
    if (size > 0 && distance > 10 * size)
        finding.complain(Outcome::warning, fmt::format("It is {} away from the scene's box, which is {} large.", formatNumber(distance), formatNumber(size)),
                         "Camera and meshes must both be in world space and in the same unit.");
    const auto [nearest, farthest] = depths(camera, scene);
    if (camera.kind == CameraKind::spherical) return;
    if (farthest <= 0)
        finding.complain(Outcome::warning, "The whole scene is behind it.", "The direction is the way it looks: many renderers keep the opposite in the matrix.");
    else if (nearest > double(camera.farClip) || farthest < double(camera.nearClip))
        finding.complain(Outcome::warning, fmt::format("The scene lies between {} and {} along its direction, outside of near {} and far {}.", formatNumber(nearest), formatNumber(farthest),
                                                       formatNumber(double(camera.nearClip)), formatNumber(double(camera.farClip))),
                         "Give near and far in scene units.");
}

/// Film position of a ray in pixels, by the definition of emca::Camera. NaN behind the camera.
std::array<double, 2> project(const Camera& camera, Vec3d origin, Vec3d target, std::uint32_t width, std::uint32_t height) {
    const Vec3d direction = toDouble(camera.direction), up = toDouble(camera.up);
    const Vec3d right = cross(direction, up) * (camera.rightHanded ? 1.0 : -1.0);
    Vec3d to = target - origin;
    if (camera.apertureRadius > 0 && camera.focusDistance > 0) {  // through any point of a lens: all meet in the plane of focus
        const double along = dot(to, direction);
        to = origin + to * (double(camera.focusDistance) / along) - toDouble(camera.position);
    }
    const double depth = dot(to, direction);
    if (!(depth > 0)) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    const double half = std::tan(double(camera.verticalFieldOfView) * std::numbers::pi / 360), aspect = double(width) / height;
    return {(dot(to, right) / (depth * half * aspect) + 1) / 2 * width, (1 - dot(to, up) / (depth * half)) / 2 * height};
}

/// Of deviations that may hold NaN (behind the camera), which count as far away.
double quantileOf(std::vector<double> values, double p) {
    for (double& v : values)
        if (std::isnan(v)) v = std::numeric_limits<double>::max();
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(p * double(values.size() - 1))];
}

/// Pixels that a ray may be off its pixel's centre: half a pixel, and what filter importance sampling adds.
constexpr double kTolerance = 3;

struct Variant {
    Camera camera;
    const char* what;
    const char* advice;
};

std::vector<Variant> variants(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    std::vector<Variant> all;
    Camera changed = camera;
    changed.rightHanded = !camera.rightHanded;
    all.push_back({changed, "It fits if left and right are exchanged", "Negate Camera::rightHanded."});
    changed = camera;
    changed.up = -camera.up;
    changed.rightHanded = !camera.rightHanded;
    all.push_back({changed, "It fits if the image is turned upside down", "Row 0 is the top of the image: negate up (and Camera::rightHanded), or count rows from the top."});
    changed = camera;
    changed.up = -camera.up;
    all.push_back({changed, "It fits if the image is turned by 180 degrees", "Negate up."});
    changed = camera;
    changed.direction = -camera.direction;
    changed.rightHanded = !camera.rightHanded;
    all.push_back({changed, "It fits if the camera looks the opposite way", "Negate the direction: it is the way the camera looks."});
    changed.rightHanded = camera.rightHanded;
    all.push_back({changed, "It fits if the camera looks the opposite way, mirrored", "Negate the direction: it is the way the camera looks."});
    const double half = std::tan(double(camera.verticalFieldOfView) * std::numbers::pi / 360), aspect = double(width) / height;
    changed = camera;
    changed.verticalFieldOfView = static_cast<float>(std::atan(half / aspect) * 360 / std::numbers::pi);
    all.push_back({changed, "It fits if the field of view is that of the image's width", "Convert it: vertical = 2 atan(tan(horizontal / 2) height / width)."});
    changed.verticalFieldOfView = static_cast<float>(std::atan(half * aspect) * 360 / std::numbers::pi);
    all.push_back({changed, "It fits if the field of view is that of the shorter side", "Give the angle from the top to the bottom edge of the image."});
    changed.verticalFieldOfView = camera.verticalFieldOfView * 2;
    all.push_back({changed, "It fits if the field of view is doubled", "Give the whole angle, not half of it."});
    changed.verticalFieldOfView = camera.verticalFieldOfView / 2;
    all.push_back({changed, "It fits if the field of view is halved", "Give the whole angle from edge to edge, not twice that."});
    return all;
}

}  // namespace

Finding checkCamera(const Camera& camera, const BoundingBox& scene) {
    Finding finding{.check = "camera"};
    static constexpr const char* kKinds[] = {"Perspective", "Spherical", "Orthographic", "Other"};
    const auto kind = static_cast<std::size_t>(camera.kind);
    finding.sentence = fmt::format("{} camera at {}", kind < 4 ? kKinds[kind] : "Unknown", analysis::formatVector(camera.position));
    if (usesFieldOfView(camera)) finding.sentence += fmt::format(", {} degrees from top to bottom", formatNumber(double(camera.verticalFieldOfView)));
    finding.sentence += '.';
    finding.add("position", camera.position);
    finding.add("direction", camera.direction);
    finding.add("up", camera.up);
    finding.add("verticalFieldOfView", camera.verticalFieldOfView);
    checkNumbers(camera, finding);
    if (finding.outcome != Outcome::failed && !scene.empty) checkPlace(camera, scene, finding);
    return finding;
}

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height) : camera_(camera), width_(width), height_(height) {}

void CameraRays::add(const PathSet& paths) {
    constexpr std::size_t kEnough = 200000;
    for (Index path = 0; path < paths.pathCount() && rays_.size() < kEnough; ++path) {
        const IndexRange vertices = paths.vertices(path);
        for (Index v = vertices.first; v < vertices.last; ++v) {
            const auto position = paths.position(v);
            if (paths.subpath(v) != Subpath::camera || !position) continue;
            if (paths.depthIndex(v) < 1) continue;  // the camera itself
            if (paths.depthIndex(v) > 1 || !isFinite(*position)) break;
            const auto origin = paths.origin(path);
            const bool hasOrigin = origin && isFinite(*origin);
            rays_.push_back({paths.pixel(path), hasOrigin ? *origin : camera_.position, *position, hasOrigin});
            break;
        }
    }
}

std::vector<double> CameraRays::deviations(const Camera& camera) const {
    std::vector<double> all;
    all.reserve(rays_.size());
    for (const Ray& ray : rays_) {
        // A pinhole's rays go through its position, wherever the renderer lets them begin (at the near plane, for one).
        const bool lens = camera.apertureRadius > 0 && camera.focusDistance > 0;
        const Vec3d origin = toDouble(lens && ray.hasOrigin ? ray.origin : camera.position);
        const auto [x, y] = project(camera, origin, toDouble(ray.target), width_, height_);
        all.push_back(std::max(std::abs(x - (ray.pixel.x + 0.5)), std::abs(y - (ray.pixel.y + 0.5))));
        if (std::isnan(x)) all.back() = x;
    }
    return all;
}

Finding CameraRays::finding() const {
    Finding finding{.check = "camera-rays"};
    finding.count("rays", rays_.size());
    if (camera_.kind != CameraKind::perspective || rays_.empty()) {
        finding.outcome = Outcome::skipped;
        finding.sentence = rays_.empty() ? "No first vertex (depth 1) was recorded that could be compared with the camera." : "Only perspective cameras are compared with their rays.";
        return finding;
    }
    const std::vector<double> off = deviations(camera_);
    const double median = quantileOf(off, 0.5), most = quantileOf(off, 0.95);
    finding.add("medianDeviation", median);
    finding.add("deviation95", most);
    const Variant* better = nullptr;
    const std::vector<Variant> others = variants(camera_, width_, height_);
    for (const Variant& variant : others) {
        // In a small image, a wrong camera is not many pixels off; but a right one is much nearer.
        const double deviation = most > 1 ? quantileOf(deviations(variant.camera), 0.95) : most;
        if (!better && deviation <= kTolerance && deviation < most / 2) better = &variant;
    }
    if (most <= kTolerance && !better) {
        finding.sentence = fmt::format("The first segments of {} begin where the camera puts their pixels: 95 % within {} pixels.", counted(rays_.size(), "path"), formatNumber(most));
        return finding;
    }
    const bool behind = most == std::numeric_limits<double>::max();
    const std::string sentence = fmt::format("By the camera, first segments of paths belong to other pixels: half of them {}.",
                                             median == std::numeric_limits<double>::max() ? "are behind it" : fmt::format("are more than {} pixels off", formatNumber(median))) +
                                 (behind ? " Some are behind it." : "");
    if (better) {
        finding.complain(Outcome::failed, fmt::format("{} {}.", sentence, better->what), better->advice);
        return finding;
    }
    finding.complain(Outcome::warning, sentence, "The 3D view will show another view than the image. Is the image cropped, or the lens shifted? Then nothing can be done; else look at position, direction, up and field of view.");
    return finding;
}

}  // namespace emca::doctor
