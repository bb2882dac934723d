#include "shapes/parallelogram.h"

#include <algorithm>
#include <cmath>

namespace emca::render {

namespace {

/// Place in `t` of the vertex that `other` does not have; nothing unless exactly one is like that.
std::optional<std::uint32_t> apexOf(const TriangleMesh& mesh, const Triangle& t, const Triangle& other) {
    std::optional<std::uint32_t> apex;
    for (std::uint32_t i = 0; i < 3; ++i) {
        // By position: a mesh may have a vertex twice, with different texture coordinates.
        const bool shared = std::ranges::any_of(
            other, [&](std::uint32_t index) { return mesh.positions[index] == mesh.positions[t[i]]; });
        if (shared) continue;
        if (apex) return std::nullopt;
        apex = i;
    }
    return apex;
}

}  // namespace

std::optional<Parallelogram> Parallelogram::of(const TriangleMesh& mesh, float positionError) {
    if (mesh.triangles.size() != 2) return std::nullopt;
    const Triangle& a = mesh.triangles[0];
    const Triangle& b = mesh.triangles[1];
    const auto apexA = apexOf(mesh, a, b), apexB = apexOf(mesh, b, a);
    if (!apexA || !apexB) return std::nullopt;
    const auto vertex = [&](const Triangle& t, std::uint32_t i) { return mesh.positions[t[i % 3]]; };
    Parallelogram shape;
    shape.corner_ = vertex(a, *apexA);
    shape.first_ = vertex(a, *apexA + 1) - shape.corner_;
    shape.second_ = vertex(a, *apexA + 2) - shape.corner_;
    // Seen from the same side, the second triangle meets the shared edge the other way round.
    if (vertex(a, *apexA + 1) != vertex(b, *apexB + 2) || vertex(a, *apexA + 2) != vertex(b, *apexB + 1))
        return std::nullopt;
    const Vec3f gap = shape.at({1.f, 1.f}) - vertex(b, *apexB);
    if (!(std::max({std::abs(gap.x), std::abs(gap.y), std::abs(gap.z)}) <= 0.25f * positionError)) return std::nullopt;
    const Vec3f normal = cross(shape.first_, shape.second_);
    if (!(dot(normal, normal) > 0.f)) return std::nullopt;
    shape.normal_ = normalize(normal);
    shape.dualFirst_ = cross(shape.second_, normal) / dot(normal, normal);
    shape.dualSecond_ = cross(normal, shape.first_) / dot(normal, normal);
    shape.positionError_ = positionError;

    // Weights of the vertices from the apex on, as {1, u.x, u.y} times:
    shape.halves_[0] = half(*apexA, {{{1, -1, -1}, {0, 1, 0}, {0, 0, 1}}});
    shape.halves_[1] = half(*apexB, {{{-1, 1, 1}, {1, -1, 0}, {1, 0, -1}}});
    return shape;
}

Parallelogram::Half Parallelogram::half(std::uint32_t apex, const std::array<std::array<float, 3>, 3>& weights) {
    const auto& second = weights[(1 + 3 - apex) % 3];
    const auto& third = weights[(2 + 3 - apex) % 3];
    return {{second[0], third[0]}, {second[1], third[1]}, {second[2], third[2]}};
}

}  // namespace emca::render
