#include "emca/probe/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace emca::probe {

namespace {

constexpr double kPi = std::numbers::pi;

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }
Vec3f toFloat(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

Vec3d fromAngles(double cosTheta, double phi) {
    const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
    return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}

}  // namespace

SphereFrame SphereFrame::around(Vec3f pole, Vec3f forward) {
    SphereFrame frame;
    const Vec3d up = normalize(toDouble(pole));
    Vec3d ahead = toDouble(forward);
    ahead -= up * dot(ahead, up);
    const double size = length(toDouble(forward));
    if (!(length(ahead) > 1e-4 * size)) {
        // The axis that is least along the pole.
        const double x = std::abs(up.x), y = std::abs(up.y), z = std::abs(up.z);
        ahead = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
        ahead -= up * dot(ahead, up);
    }
    frame.pole = toFloat(up);
    frame.forward = toFloat(normalize(ahead));
    return frame;
}

Vec3d SphereFrame::toLocal(Vec3f world) const {
    const Vec3d w = toDouble(world), ahead = toDouble(forward), up = toDouble(pole);
    return {dot(w, ahead), dot(w, cross(up, ahead)), dot(w, up)};
}

Vec3f SphereFrame::toWorld(Vec3d local) const {
    const Vec3d ahead = toDouble(forward), up = toDouble(pole);
    return toFloat(ahead * local.x + cross(up, ahead) * local.y + up * local.z);
}

bool SphereFrame::isValid() const {
    constexpr float kTolerance = 1e-3f;
    return isFinite(pole) && isFinite(forward) && std::abs(length(pole) - 1.f) <= kTolerance &&
           std::abs(length(forward) - 1.f) <= kTolerance && std::abs(dot(pole, forward)) <= kTolerance;
}

SphereMap::SphereMap(const SphereFrame& frame, std::uint32_t width, std::uint32_t height)
    : frame_(frame), width_(std::max(width, 1u)), height_(std::max(height, 1u)) {}

Vec3f SphereMap::direction(Vec2d film) const {
    const double phi = 2 * kPi * (0.5 - film.x / width_);
    return frame_.toWorld(fromAngles(std::cos(kPi * film.y / height_), phi));
}

Vec2d SphereMap::film(Vec3f direction) const {
    const Vec3d local = frame_.toLocal(direction);
    const double theta = std::atan2(std::hypot(local.x, local.y), local.z);
    const double phi = std::atan2(local.y, local.x);
    double u = 0.5 - phi / (2 * kPi);
    if (u >= 1) u -= 1;  // straight back is the left edge
    return {std::clamp(u, 0.0, 1.0) * width_, theta / kPi * height_};
}

Pixel SphereMap::pixelOf(Vec3f direction) const {
    const Vec2d at = film(direction);
    return {std::min(static_cast<std::uint32_t>(at.x), width_ - 1), std::min(static_cast<std::uint32_t>(at.y), height_ - 1)};
}

double SphereMap::solidAngle(std::uint32_t row) const {
    return 2 * kPi / width_ * (std::cos(kPi * row / height_) - std::cos(kPi * (double(row) + 1) / height_));
}

Vec3f SphereMap::sample(Pixel pixel, Vec2f u) const {
    const double top = std::cos(kPi * pixel.y / height_), bottom = std::cos(kPi * (double(pixel.y) + 1) / height_);
    const double phi = 2 * kPi * (0.5 - (pixel.x + double(u.x)) / width_);
    return frame_.toWorld(fromAngles(top + (bottom - top) * double(u.y), phi));
}

}  // namespace emca::probe
