#include "emca/render/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace emca::render {

namespace {

Vec3d toDouble(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }
Vec3f toFloat(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// Angle between two unit vectors, accurate also where acos is not (Kahan, "How Futile are Mindless Assessments of
/// Roundoff in Floating-Point Computation?", section 12).
double angleBetween(Vec3d a, Vec3d b) { return 2 * std::atan2(length(a - b), length(a + b)); }

}  // namespace

void apply(const Transform& map, TriangleMesh& mesh) {
    for (auto& position : mesh.positions)
        position = map.point(position);
    for (auto& normal : mesh.normals)
        normal = map.normal(normal);
    if (map.determinant() < 0)
        for (auto& triangle : mesh.triangles)
            std::swap(triangle[1], triangle[2]);
}

void flip(TriangleMesh& mesh) {
    for (auto& normal : mesh.normals)
        normal = -normal;
    for (auto& triangle : mesh.triangles)
        std::swap(triangle[1], triangle[2]);
}

void computeNormals(TriangleMesh& mesh) {
    std::vector<Vec3d> sums(mesh.positions.size());
    const auto corner = [&](const Triangle& t, std::size_t i) { return toDouble(mesh.positions[t[i]]); };
    const auto faceNormal = [&](const Triangle& t) {
        return normalize(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
    };
    for (const auto& t : mesh.triangles) {
        const Vec3d normal = faceNormal(t);
        if (!(length(normal) > 0))
            continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d here = corner(t, i);
            const Vec3d a = normalize(corner(t, (i + 1) % 3) - here), b = normalize(corner(t, (i + 2) % 3) - here);
            sums[t[i]] += normal * angleBetween(a, b);
        }
    }
    mesh.normals.assign(mesh.positions.size(), Vec3f{});
    for (std::size_t i = 0; i < sums.size(); ++i)
        mesh.normals[i] = toFloat(normalize(sums[i]));
    // Where faces cancel each other (both sides of a sheet), any of them is as good; where there are none, anything is.
    for (const auto& t : mesh.triangles)
        for (const auto index : t)
            if (!(length(mesh.normals[index]) > 0.5f))
                mesh.normals[index] = toFloat(faceNormal(t));
    for (auto& normal : mesh.normals)
        if (!(length(normal) > 0.5f))
            normal = {0, 0, 1};
}

void alignWithNormals(TriangleMesh& mesh) {
    if (mesh.normals.empty())
        return;
    for (auto& t : mesh.triangles) {
        const Vec3d a = toDouble(mesh.positions[t[0]]), b = toDouble(mesh.positions[t[1]]), c = toDouble(mesh.positions[t[2]]);
        const Vec3f sum = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
        if (dot(cross(b - a, c - a), toDouble(sum)) < 0)
            std::swap(t[1], t[2]);
    }
}

TriangleMesh makeRectangle() {
    return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh makeCube() {
    // Outward normal and the directions in which u and v grow, laid out as Mitsuba lays out its cube.
    struct Face { Vec3f normal, u, v; };
    static constexpr Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    static constexpr Face kFaces[] = {{-y, z, x}, {y, -x, -z}, {x, y, -z}, {z, y, x}, {-x, y, z}, {-z, -y, x}};
    TriangleMesh mesh;
    for (const auto& [normal, u, v] : kFaces) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec2f uv : {Vec2f{0, 1}, Vec2f{1, 1}, Vec2f{1, 0}, Vec2f{0, 0}}) {
            mesh.positions.push_back(normal + u * (2 * uv.x - 1) + v * (2 * uv.y - 1));
            mesh.uvs.push_back(uv);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    return mesh;
}

TriangleMesh makeDisk() {
    constexpr std::uint32_t kSegments = 64;
    TriangleMesh mesh;
    const auto rim = [&](std::uint32_t i) {
        const double turn = double(i) / kSegments, angle = 2 * std::numbers::pi * turn;
        mesh.positions.push_back(toFloat({std::cos(angle), std::sin(angle), 0}));
        mesh.uvs.push_back({1, static_cast<float>(turn)});
    };
    // One centre for each segment, as v depends on the direction in which the centre is left.
    for (std::uint32_t i = 0; i < kSegments; ++i) {
        mesh.positions.push_back({0, 0, 0});
        mesh.uvs.push_back({0, (static_cast<float>(i) + 0.5f) / kSegments});
        rim(i);
        mesh.triangles.push_back({2 * i, 2 * i + 1, i + 1 == kSegments ? 2 * i + 2 : 2 * i + 3});
    }
    rim(kSegments);
    return mesh;
}

TriangleMesh makeSphere() {
    constexpr std::uint32_t kAround = 46, kDown = 23;  // 2 * 46 * (23 - 1) = 2024 triangles
    TriangleMesh mesh;
    // Rows from pole to pole. A pole has one vertex for each column, as u depends on the direction to leave it.
    for (std::uint32_t row = 0; row <= kDown; ++row) {
        const bool pole = row == 0 || row == kDown;
        const double theta = std::numbers::pi * row / kDown, z = pole ? (row == 0 ? 1 : -1) : std::cos(theta);
        for (std::uint32_t column = 0; column <= kAround; ++column) {
            const double turn = (column + (pole ? 0.5 : 0.0)) / kAround, phi = 2 * std::numbers::pi * turn;
            const double s = pole ? 0 : std::sin(theta);
            mesh.positions.push_back(toFloat({s * std::cos(phi), s * std::sin(phi), z}));
            mesh.uvs.push_back({static_cast<float>(std::min(turn, 1.0)), static_cast<float>(row) / kDown});
        }
    }
    mesh.normals = mesh.positions;
    for (auto& normal : mesh.normals)
        normal = normalize(normal);
    for (std::uint32_t row = 0; row < kDown; ++row) {
        for (std::uint32_t column = 0; column < kAround; ++column) {
            const std::uint32_t a = row * (kAround + 1) + column, b = a + kAround + 1;
            if (row + 1 < kDown)
                mesh.triangles.push_back({a, b, b + 1});
            else
                mesh.triangles.push_back({a, b, a + 1});
            if (row > 0 && row + 1 < kDown)
                mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

TriangleMesh tessellateSphere(Vec3f center, float radius, const Transform& toWorld) {
    TriangleMesh mesh = makeSphere();
    const double r = double(radius);
    apply(toWorld * Transform::translate(toDouble(center)) * Transform::scale({r, r, r}), mesh);
    return mesh;
}

TriangleMesh tessellateDisk(const Transform& toWorld) {
    TriangleMesh mesh = makeDisk();
    apply(toWorld, mesh);
    return mesh;
}

}  // namespace emca::render
