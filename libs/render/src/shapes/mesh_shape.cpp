#include "shapes/mesh_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "embree_compat.h"
#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

float largestCoordinate(Vec3f p) { return std::max(std::abs(p.x), std::max(std::abs(p.y), std::abs(p.z))); }

double triangleArea(Vec3f a, Vec3f b, Vec3f c) {
    const auto wide = [](Vec3f v) { return Vec3d{double(v.x), double(v.y), double(v.z)}; };
    return 0.5 * length(cross(wide(b) - wide(a), wide(c) - wide(a)));
}

}  // namespace

MeshShape::MeshShape(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    // Embree reads 16 bytes at every vertex, also at the last one.
    mesh_.positions.reserve(mesh_.positions.size() + 1);
    double area = 0;
    faces_.reserve(mesh_.triangles.size());
    for (const Triangle& t : mesh_.triangles) {
        const Vec3f a = mesh_.positions[t[0]], b = mesh_.positions[t[1]], c = mesh_.positions[t[2]];
        area += triangleArea(a, b, c);
        const float largest = std::max(largestCoordinate(a), std::max(largestCoordinate(b), largestCoordinate(c)));
        faces_.push_back({a, b - a, c - a, normalize(cross(b - a, c - a)), kRelativePositionError * largest});
    }
    area_ = static_cast<float>(area);
}

void MeshShape::prepareSampling() {
    std::vector<float> areas;
    areas.reserve(mesh_.triangles.size());
    for (const Triangle& t : mesh_.triangles) {
        areas.push_back(static_cast<float>(
            triangleArea(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]])));
    }
    triangles_ = Distribution1D(areas);
    if (faces_.size() == 2 && !reusesTriangleSample_)
        parallelogram_ = Parallelogram::of(mesh_, std::max(faces_[0].positionError, faces_[1].positionError));
}

void MeshShape::reuseTriangleSample() {
    reusesTriangleSample_ = true;
    parallelogram_.reset();
}

void MeshShape::interact(const Ray&, const RayHit& hit, SurfaceInteraction& at) const {
    const Face& face = faces_[hit.primitive];
    // From the vertices, not along the ray: the error then does not grow with the distance to the ray's origin.
    at.position = face.at(hit.u, hit.v);
    at.geometricNormal = face.normal;
    at.positionError = face.positionError;
    at.face = static_cast<std::int32_t>(hit.primitive);
    at.barycentrics = {hit.u, hit.v};

    Vec3f normal = face.normal;
    if (!mesh_.normals.empty()) {
        const Triangle& t = mesh_.triangles[hit.primitive];
        const float w = 1.f - hit.u - hit.v;
        const Vec3f smooth = mesh_.normals[t[0]] * w + mesh_.normals[t[1]] * hit.u + mesh_.normals[t[2]] * hit.v;
        if (dot(smooth, smooth) > 0.f) normal = normalize(smooth);
    }
    at.shading = Frame::fromNormal(normal);
}

ShapePlace MeshShape::placeAt(Vec3f position) const {
    if (!parallelogram_) return {};
    const Vec2f u = parallelogram_->parametersOf(position);
    return {parallelogram_->face(u), parallelogram_->barycentrics(u)};
}

Vec2f MeshShape::uv(std::int32_t face, Vec2f bary, Vec3f position) const {
    if (face < 0 && parallelogram_) {
        const ShapePlace place = placeAt(position);
        face = place.face;
        bary = place.barycentrics;
    }
    if (mesh_.uvs.empty()) return bary;  // as Mitsuba gives
    const Triangle& t = mesh_.triangles[static_cast<std::size_t>(face)];
    return mesh_.uvs[t[0]] * (1.f - bary.x - bary.y) + mesh_.uvs[t[1]] * bary.x + mesh_.uvs[t[2]] * bary.y;
}

bool MeshShape::sample(Vec3f from, Vec2f u, ShapeSample& sample) const {
    if (parallelogram_) {
        sample.position = parallelogram_->at(u);
        sample.normal = parallelogram_->normal();
        sample.positionError = parallelogram_->positionError();
        // Few ask for the triangle, and to choose it takes a branch that is predicted wrongly half the time.
        sample.face = -1;
    } else {
        sampleTriangle(u, sample);
    }
    return completeAreaSample(from, area_, sample);
}

void MeshShape::sampleTriangle(Vec2f u, ShapeSample& sample) const {
    assert(triangles_.size() > 0);
    // The triangle takes what it needs of u.x and the point gets the remainder: using u.x twice as it is correlates
    // triangle and point.
    const Distribution1D::Choice chosen = triangles_.sample(u.x);
    const Face& face = faces_[chosen.index];
    const Vec2f bary = squareToUniformTriangle({reusesTriangleSample_ ? u.x : chosen.remainder, u.y});
    sample.position = face.at(bary.x, bary.y);
    sample.normal = face.normal;
    sample.positionError = face.positionError;
    sample.face = static_cast<std::int32_t>(chosen.index);
    sample.barycentrics = bary;
}

float MeshShape::pdf(Vec3f, Vec3f direction, float distance, const SurfaceInteraction& at) const {
    const float cosine = std::abs(dot(at.geometricNormal, direction));
    return cosine > 0.f ? square(distance) / (cosine * area_) : 0.f;
}

RTCGeometryTy* MeshShape::makeGeometry(RTCDeviceTy* device) const {
    static_assert(sizeof(Vec3f) == 12 && sizeof(Triangle) == 12);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh_.positions.data(), 0,
                               sizeof(Vec3f), mesh_.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh_.triangles.data(), 0,
                               sizeof(Triangle), mesh_.triangles.size());
    return geometry;
}

emca::Mesh MeshShape::displayMesh() const {
    emca::Mesh mesh;
    mesh.positions = mesh_.positions;
    mesh.triangles = mesh_.triangles;
    return mesh;
}

}  // namespace emca::render
