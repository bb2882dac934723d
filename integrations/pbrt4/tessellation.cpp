#include "tessellation.h"

#include <algorithm>
#include <cmath>

namespace emca::pbrt4 {

namespace {

constexpr std::uint32_t kAround = 48, kAlong = 24;  ///< cells of a whole sphere
constexpr std::uint32_t kPatchCells = 8;
constexpr float kTwoPi = 6.28318530718f;

std::uint32_t cellsAround(const inside::Quadric& shape) {
    return std::max(3u, static_cast<std::uint32_t>(std::ceil(float(kAround) * shape.phiMax / kTwoPi)));
}

/// Interactions have their normal along dp/du x dp/dv, turned where the scene says ReverseOrientation; that and a
/// mirroring transform cancel as often as in pbrt.
bool flipped(const inside::Quadric& shape) { return shape.reverseOrientation; }

pbrt::Point3f around(const inside::Quadric& shape, float u, float radius, float z) {
    const float phi = u * shape.phiMax;
    return (*shape.renderFromObject)(pbrt::Point3f(radius * std::cos(phi), radius * std::sin(phi), z));
}

}  // namespace

adapter::ParametricMesh gridOf(const pbrt::Sphere& sphere) {
    const inside::Quadric q = inside::quadric(sphere);
    return {.columns = cellsAround(q),
            .rows = kAlong,
            .firstRowIsPoint = q.zMin <= -q.radius,
            .lastRowIsPoint = q.zMax >= q.radius,
            .flipped = flipped(q)};
}

adapter::ParametricMesh gridOf(const pbrt::Disk& disk) {
    const inside::Quadric q = inside::quadric(disk);
    // Finer: in the plane there is no bulge that would excuse a cell's diagonal, which is straight only in (u, v).
    return {.columns = 2 * cellsAround(q), .rows = 16, .lastRowIsPoint = q.innerRadius == 0, .flipped = flipped(q)};
}

adapter::ParametricMesh gridOf(const pbrt::Cylinder& cylinder) {
    const inside::Quadric q = inside::quadric(cylinder);
    return {.columns = cellsAround(q), .rows = 8, .flipped = flipped(q)};
}

pbrt::Point3f pointAt(const pbrt::Sphere& sphere, Vec2f uv) {
    const inside::Quadric q = inside::quadric(sphere);
    const float theta = q.thetaAtZMin + uv.y * (q.thetaAtZMax - q.thetaAtZMin);
    return around(q, uv.x, q.radius * std::sin(theta), q.radius * std::cos(theta));
}

pbrt::Point3f pointAt(const pbrt::Disk& disk, Vec2f uv) {
    const inside::Quadric q = inside::quadric(disk);
    return around(q, uv.x, q.radius - uv.y * (q.radius - q.innerRadius), q.zMin);
}

pbrt::Point3f pointAt(const pbrt::Cylinder& cylinder, Vec2f uv) {
    const inside::Quadric q = inside::quadric(cylinder);
    return around(q, uv.x, q.radius, q.zMin + uv.y * (q.zMax - q.zMin));
}

pbrt::Point3f PatchCorners::at(Vec2f uv) const {
    const pbrt::Vector3f a = pbrt::Vector3f(p00) * (1 - uv.x) + pbrt::Vector3f(p10) * uv.x;
    const pbrt::Vector3f b = pbrt::Vector3f(p01) * (1 - uv.x) + pbrt::Vector3f(p11) * uv.x;
    return pbrt::Point3f(a * (1 - uv.y) + b * uv.y);
}

Vec2f PatchCorners::parameterOf(pbrt::Point3f p) const {
    Vec2f uv{0.5f, 0.5f};
    // Gauss-Newton: one step for parallelograms, few for what scenes have.
    for (int step = 0; step < 16; ++step) {
        const pbrt::Vector3f left = p - at(uv);
        const pbrt::Vector3f du = (p10 - p00) * (1 - uv.y) + (p11 - p01) * uv.y;
        const pbrt::Vector3f dv = (p01 - p00) * (1 - uv.x) + (p11 - p10) * uv.x;
        const float uu = Dot(du, du), uv2 = Dot(du, dv), vv = Dot(dv, dv), determinant = uu * vv - uv2 * uv2;
        if (!(determinant > 0)) break;
        const float gu = Dot(du, left), gv = Dot(dv, left);
        const Vec2f change{(vv * gu - uv2 * gv) / determinant, (uu * gv - uv2 * gu) / determinant};
        uv = {std::clamp(uv.x + change.x, 0.f, 1.f), std::clamp(uv.y + change.y, 0.f, 1.f)};
        if (std::abs(change.x) + std::abs(change.y) < 1e-5f) break;
    }
    return uv;
}

bool PatchCorners::isPlane() const {
    const pbrt::Vector3f bend = (p11 - p01) - (p10 - p00);
    return LengthSquared(bend) <= 1e-8f * DistanceSquared(p00, p11);
}

PatchCorners cornersOf(const pbrt::BilinearPatchMesh& mesh, int patch) {
    const int* corner = &mesh.vertexIndices[4 * patch];
    return {mesh.p[corner[0]], mesh.p[corner[1]], mesh.p[corner[2]], mesh.p[corner[3]]};
}

adapter::ParametricMesh gridOf(const PatchCorners& patch) {
    return patch.isPlane() ? adapter::ParametricMesh{}
                           : adapter::ParametricMesh{.columns = kPatchCells, .rows = kPatchCells};
}

CurveTube::Place CurveTube::place(float u) const {
    const pbrt::Point3f* c = curve_->cpObj;
    const float t = u, s = 1 - u;
    const pbrt::Point3f centre(s * s * s * pbrt::Vector3f(c[0]) + 3 * s * s * t * pbrt::Vector3f(c[1]) +
                               3 * s * t * t * pbrt::Vector3f(c[2]) + t * t * t * pbrt::Vector3f(c[3]));
    pbrt::Vector3f along = 3 * s * s * (c[1] - c[0]) + 6 * s * t * (c[2] - c[1]) + 3 * t * t * (c[3] - c[2]);
    if (LengthSquared(along) == 0) along = c[3] - c[0];
    if (LengthSquared(along) == 0) along = {0, 0, 1};
    along = Normalize(along);
    // One axis for the whole curve, so that the tube does not twist.
    const pbrt::Vector3f whole = Abs(c[3] - c[0]);
    const pbrt::Vector3f axis = whole.x <= whole.y && whole.x <= whole.z ? pbrt::Vector3f(1, 0, 0)
                                : whole.y <= whole.z                     ? pbrt::Vector3f(0, 1, 0)
                                                                         : pbrt::Vector3f(0, 0, 1);
    pbrt::Vector3f side = Cross(axis, along);
    side = LengthSquared(side) > 1e-12f ? Normalize(side)
                                        : Normalize(Cross(pbrt::Vector3f(along.y, along.z, along.x), along));
    return {centre, side, Cross(along, side), 0.5f * (s * curve_->width[0] + t * curve_->width[1])};
}

pbrt::Point3f CurveTube::at(Vec2f uv) const {
    const Place p = place(uv.x);
    const float angle = kTwoPi * uv.y;
    return (*curve_->renderFromObject)(p.centre + p.radius * (std::cos(angle) * p.side + std::sin(angle) * p.up));
}

Vec2f CurveTube::parameterOf(float u, pbrt::Point3f hit) const {
    const Place p = place(std::clamp(u, 0.f, 1.f));
    const pbrt::Vector3f from = (*curve_->objectFromRender)(hit)-p.centre;
    const float angle = std::atan2(Dot(from, p.up), Dot(from, p.side));
    return {u, angle < 0 ? angle / kTwoPi + 1 : angle / kTwoPi};
}

}  // namespace emca::pbrt4
