#include "shapes/sphere_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emca/render/sampling_functions.h"
#include "shapes/tessellation_face.h"
#include "shapes/user_geometry.h"

namespace emca::render {

namespace {

constexpr double kPiDouble = 3.14159265358979323846;

/// 1 - cos of the half angle under which a sphere is seen; keeps its digits for small spheres.
double oneMinusCosine(double squaredSine) { return squaredSine / (1 + std::sqrt(1 - squaredSine)); }

}  // namespace

SphereShape::SphereShape(const SphereGeometry& sphere, TriangleMesh tessellation, bool flipped)
    : center_(widen(sphere.center)),
      radius_(double(sphere.radius)),
      normalSign_(flipped ? -1.f : 1.f),
      toObject_(sphere.toWorld.inverse().value_or(Transform())),
      tessellation_(std::move(tessellation)) {
    const double extent = std::max(std::abs(center_.x), std::max(std::abs(center_.y), std::abs(center_.z))) + radius_;
    positionError_ = kRelativePositionError * static_cast<float>(extent);
}

std::optional<double> SphereShape::intersect(Vec3d origin, Vec3d direction, double nearest, double farthest) const {
    const Vec3d toOrigin = origin - center_;
    const double scale = dot(direction, direction);
    const double middle = -dot(toOrigin, direction) / scale;
    // Distance of the centre from the line, squared, without the cancellation of the textbook's b^2 - 4ac.
    const Vec3d aside = toOrigin + direction * middle;
    const double inside = radius_ * radius_ - dot(aside, aside);
    if (inside < 0) return std::nullopt;
    const double half = std::sqrt(inside / scale);
    for (const double t : {middle - half, middle + half}) {
        if (t > nearest && t < farthest) return t;
    }
    return std::nullopt;
}

void SphereShape::interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const {
    const Vec3d origin = widen(ray.origin), direction = widen(ray.direction);
    const Vec3d normal = normalize(origin + direction * double(hit.distance) - center_);
    at.position = narrow(center_ + normal * radius_);
    at.geometricNormal = narrow(normal) * normalSign_;
    at.shading = Frame::fromNormal(at.geometricNormal);
    at.positionError = positionError_;
    at.face = sphereFace(normalize(toObject_.vector(narrow(normal))));
    at.barycentrics = kNoBarycentrics;
}

Vec2f SphereShape::uv(std::int32_t, Vec2f, Vec3f position) const {
    const Vec3f local = toLocal(position);
    const float azimuth = std::atan2(local.y, local.x) * (0.5f * kInvPi);
    return {azimuth < 0.f ? azimuth + 1.f : azimuth, std::acos(std::clamp(local.z, -1.f, 1.f)) * kInvPi};
}

ShapePlace SphereShape::placeAt(Vec3f position) const {
    return {.face = sphereFace(toLocal(position))};
}

Vec3f SphereShape::toLocal(Vec3f position) const {
    return normalize(toObject_.vector(narrow(normalize(widen(position) - center_))));
}

float SphereShape::area() const { return static_cast<float>(4 * kPiDouble * radius_ * radius_); }

bool SphereShape::sample(Vec3f from, Vec2f u, ShapeSample& sample) const {
    const Vec3d toCenter = center_ - widen(from);
    const double squaredDistance = dot(toCenter, toCenter);
    const double squaredSine = radius_ * radius_ / squaredDistance;
    if (!(squaredSine < 1)) return sampleFromInside(from, u, sample);

    const double coneSize = oneMinusCosine(squaredSine);
    const double distance = std::sqrt(squaredDistance);
    const double off = double(u.x) * coneSize;  // 1 - cos theta
    const double cosine = 1 - off, squaredSineTheta = off * (2 - off);
    const double toSurface =
        distance * cosine - std::sqrt(std::max(0.0, radius_ * radius_ - squaredDistance * squaredSineTheta));
    const double sine = std::sqrt(squaredSineTheta), phi = 2 * kPiDouble * double(u.y);
    const Frame frame = Frame::fromNormal(narrow(toCenter / distance));
    const Vec3d direction = widen(frame.s) * (sine * std::cos(phi)) + widen(frame.t) * (sine * std::sin(phi)) +
                            toCenter * (cosine / distance);
    const Vec3d normal = normalize(widen(from) + direction * toSurface - center_);

    sample.position = narrow(center_ + normal * radius_);
    sample.normal = narrow(normal) * normalSign_;
    sample.positionError = positionError_;
    sample.direction = narrow(direction);
    sample.distance = static_cast<float>(toSurface);
    sample.pdf = static_cast<float>(1 / (2 * kPiDouble * coneSize));
    return true;
}

bool SphereShape::sampleFromInside(Vec3f from, Vec2f u, ShapeSample& sample) const {
    const Vec3f normal = squareToUniformSphere(u);
    sample.position = narrow(center_ + widen(normal) * radius_);
    sample.normal = normal * normalSign_;
    sample.positionError = positionError_;
    return completeAreaSample(from, area(), sample);
}

float SphereShape::pdf(Vec3f from, Vec3f direction, float distance, const SurfaceInteraction& at) const {
    const Vec3d toCenter = center_ - widen(from);
    const double squaredSine = radius_ * radius_ / dot(toCenter, toCenter);
    if (!(squaredSine < 1)) {
        const float cosine = std::abs(dot(at.geometricNormal, direction));
        return cosine > 0.f ? square(distance) / (cosine * area()) : 0.f;
    }
    // The cone reaches the near half of the sphere alone.
    if (dot(at.geometricNormal, direction) * normalSign_ > 0.f) return 0.f;
    return static_cast<float>(1 / (2 * kPiDouble * oneMinusCosine(squaredSine)));
}

Vec3f SphereShape::lowerCorner() const {
    const Vec3d corner = center_ - Vec3d{radius_, radius_, radius_};
    const float less = -std::numeric_limits<float>::infinity();
    const Vec3f p = narrow(corner);
    return {std::nextafter(p.x, less), std::nextafter(p.y, less), std::nextafter(p.z, less)};
}

Vec3f SphereShape::upperCorner() const {
    const Vec3d corner = center_ + Vec3d{radius_, radius_, radius_};
    const float more = std::numeric_limits<float>::infinity();
    const Vec3f p = narrow(corner);
    return {std::nextafter(p.x, more), std::nextafter(p.y, more), std::nextafter(p.z, more)};
}

RTCGeometryTy* SphereShape::makeGeometry(RTCDeviceTy* device) const { return makeUserGeometry(device, *this); }

emca::Mesh SphereShape::displayMesh() const {
    emca::Mesh mesh;
    mesh.positions = tessellation_.positions;
    mesh.triangles = tessellation_.triangles;
    return mesh;
}

}  // namespace emca::render
