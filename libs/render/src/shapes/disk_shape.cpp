#include "shapes/disk_shape.h"

#include <algorithm>
#include <cmath>

#include "emca/render/sampling_functions.h"
#include "shapes/tessellation_face.h"
#include "shapes/user_geometry.h"

namespace emca::render {

namespace {

Vec3d column(const Transform& t, int index) { return {t(0, index), t(1, index), t(2, index)}; }

/// Half extent per axis of an ellipse with half axes x and y.
Vec3d halfExtent(Vec3d x, Vec3d y) {
    return {std::hypot(x.x, y.x), std::hypot(x.y, y.y), std::hypot(x.z, y.z)};
}

/// Angle of a point of the plane, in turns from the first axis: in [0, 1].
float turn(Vec2d p) {
    const double turns = std::atan2(p.y, p.x) * (0.5 * double(kInvPi));
    return static_cast<float>(turns < 0 ? turns + 1 : turns);
}

}  // namespace

DiskShape::DiskShape(const DiskGeometry& disk, TriangleMesh tessellation, bool flipped)
    : center_(column(disk.toWorld, 3)),
      axisX_(column(disk.toWorld, 0)),
      axisY_(column(disk.toWorld, 1)),
      normal_(normalize(cross(axisX_, axisY_))),
      normalSign_(flipped ? -1.f : 1.f),
      tessellation_(std::move(tessellation)) {
    // A map that mirrors leaves the front where +z went.
    if (disk.toWorld.determinant() < 0) normalSign_ = -normalSign_;
    const Vec3d areaVector = cross(axisX_, axisY_);
    const double squaredArea = dot(areaVector, areaVector);
    dualX_ = cross(axisY_, areaVector) / squaredArea;
    dualY_ = cross(areaVector, axisX_) / squaredArea;
    area_ = kPi * static_cast<float>(std::sqrt(squaredArea));
    const Vec3d extent = halfExtent(axisX_, axisY_);
    const double largest = std::max(std::abs(center_.x) + extent.x,
                                    std::max(std::abs(center_.y) + extent.y, std::abs(center_.z) + extent.z));
    positionError_ = kRelativePositionError * static_cast<float>(largest);
}

Vec2d DiskShape::planeCoordinates(Vec3d point) const {
    const Vec3d offset = point - center_;
    return {dot(offset, dualX_), dot(offset, dualY_)};
}

std::optional<double> DiskShape::intersect(Vec3d origin, Vec3d direction, double nearest, double farthest) const {
    const double cosine = dot(direction, normal_);
    if (cosine == 0) return std::nullopt;
    const double t = dot(center_ - origin, normal_) / cosine;
    if (!(t > nearest && t < farthest)) return std::nullopt;
    const Vec2d p = planeCoordinates(origin + direction * t);
    if (!(p.x * p.x + p.y * p.y <= 1)) return std::nullopt;
    return t;
}

void DiskShape::interact(const Ray& ray, const RayHit& hit, SurfaceInteraction& at) const {
    const Vec2d p = planeCoordinates(widen(ray.origin) + widen(ray.direction) * double(hit.distance));
    at.position = narrow(center_ + axisX_ * p.x + axisY_ * p.y);
    at.geometricNormal = narrow(normal_) * normalSign_;
    at.shading = Frame::fromNormal(at.geometricNormal);
    at.positionError = positionError_;
    at.face = diskFace(turn(p));
    at.barycentrics = kNoBarycentrics;
}

ShapePlace DiskShape::placeAt(Vec3f position) const {
    return {.face = diskFace(turn(planeCoordinates(widen(position))))};
}

Vec2f DiskShape::uv(std::int32_t, Vec2f, Vec3f position) const {
    const Vec2d p = planeCoordinates(widen(position));
    return {static_cast<float>(std::sqrt(p.x * p.x + p.y * p.y)), turn(p)};
}

bool DiskShape::sample(Vec3f from, Vec2f u, ShapeSample& sample) const {
    const Vec2f p = squareToConcentricDisk(u);
    sample.position = narrow(center_ + axisX_ * double(p.x) + axisY_ * double(p.y));
    sample.normal = narrow(normal_) * normalSign_;
    sample.positionError = positionError_;
    return completeAreaSample(from, area_, sample);
}

float DiskShape::pdf(Vec3f, Vec3f direction, float distance, const SurfaceInteraction& at) const {
    const float cosine = std::abs(dot(at.geometricNormal, direction));
    return cosine > 0.f ? square(distance) / (cosine * area_) : 0.f;
}

// The box gets a little thickness, so that a disk parallel to an axis is not an empty box.
Vec3f DiskShape::lowerCorner() const {
    const Vec3d thickness{double(positionError_), double(positionError_), double(positionError_)};
    return narrow(center_ - halfExtent(axisX_, axisY_) - thickness);
}

Vec3f DiskShape::upperCorner() const {
    const Vec3d thickness{double(positionError_), double(positionError_), double(positionError_)};
    return narrow(center_ + halfExtent(axisX_, axisY_) + thickness);
}

RTCGeometryTy* DiskShape::makeGeometry(RTCDeviceTy* device) const { return makeUserGeometry(device, *this); }

emca::Mesh DiskShape::displayMesh() const {
    emca::Mesh mesh;
    mesh.positions = tessellation_.positions;
    mesh.triangles = tessellation_.triangles;
    return mesh;
}

}  // namespace emca::render
