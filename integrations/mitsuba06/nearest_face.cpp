#include "nearest_face.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace emca::mitsuba06 {

namespace {

constexpr std::uint32_t kLeafSize = 4;

Vec3f minimum(Vec3f a, Vec3f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f maximum(Vec3f a, Vec3f b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

float squared(Vec3f v) { return dot(v, v); }

/// From a point to the segment from `from` along `edge`.
float squaredDistanceToEdge(Vec3f point, Vec3f from, Vec3f edge) {
    const Vec3f toPoint = point - from;
    const float length = dot(edge, edge);
    const float along = length > 0 ? std::clamp(dot(toPoint, edge) / length, 0.f, 1.f) : 0.f;
    return squared(toPoint - edge * along);
}

}  // namespace

float NearestFace::Box::squaredDistance(Vec3f point) const {
    return squared(maximum(maximum(min - point, point - max), Vec3f{}));
}

float NearestFace::Corners::squaredDistance(Vec3f point) const {
    const Vec3f ab = b - a, bc = c - b, ca = a - c;
    const Vec3f normal = cross(ab, c - a);
    const float area = dot(normal, normal);
    // Above the triangle if on the inner side of all three edges.
    if (area > 0 && dot(cross(normal, ab), point - a) >= 0 && dot(cross(normal, bc), point - b) >= 0 &&
        dot(cross(normal, ca), point - c) >= 0) {
        const float height = dot(normal, point - a);
        return height * height / area;
    }
    return std::min({squaredDistanceToEdge(point, a, ab), squaredDistanceToEdge(point, b, bc),
                     squaredDistanceToEdge(point, c, ca)});
}

NearestFace::NearestFace(const Mesh& mesh) : order_(mesh.triangles.size()) {
    corners_.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        corners_.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

NearestFace::Box NearestFace::boundsOf(const std::vector<Corners>& corners, std::span<const std::uint32_t> faces) {
    Box box{corners[faces[0]].a, corners[faces[0]].a};
    for (const std::uint32_t face : faces) {
        const Corners& t = corners[face];
        box.min = minimum(box.min, minimum(t.a, minimum(t.b, t.c)));
        box.max = maximum(box.max, maximum(t.a, maximum(t.b, t.c)));
    }
    return box;
}

void NearestFace::build(std::uint32_t first, std::uint32_t last) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({boundsOf(corners_, std::span(order_).subspan(first, last - first)), first, last - first});
    if (last - first <= kLeafSize) return;

    const Vec3f extent = nodes_[at].box.max - nodes_[at].box.min;
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t middle = (first + last) / 2;
    const auto centre = [&](std::uint32_t face) {
        return corners_[face].a[axis] + corners_[face].b[axis] + corners_[face].c[axis];
    };
    std::nth_element(
        order_.begin() + first, order_.begin() + middle, order_.begin() + last,
        [&](std::uint32_t a, std::uint32_t b) { return centre(a) != centre(b) ? centre(a) < centre(b) : a < b; });
    build(first, middle);
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].count = 0;
    build(middle, last);
}

std::int32_t NearestFace::find(Vec3f point) const {
    if (nodes_.empty() || !isFinite(point)) return -1;
    std::uint32_t stack[64];  // halves: 2^32 triangles are 32 levels
    int size = 0;
    stack[size++] = 0;
    float nearest = std::numeric_limits<float>::infinity();
    std::uint32_t best = std::numeric_limits<std::uint32_t>::max();
    while (size > 0) {
        const std::uint32_t at = stack[--size];
        const Node& node = nodes_[at];
        if (node.box.squaredDistance(point) > nearest) continue;
        if (node.count == 0) {
            const std::uint32_t left = at + 1, right = node.first;
            const bool leftFirst = nodes_[left].box.squaredDistance(point) <= nodes_[right].box.squaredDistance(point);
            stack[size++] = leftFirst ? right : left;
            stack[size++] = leftFirst ? left : right;
            continue;
        }
        for (const std::uint32_t face : std::span(order_).subspan(node.first, node.count)) {
            const float distance = corners_[face].squaredDistance(point);
            if (distance < nearest || (distance == nearest && face < best)) {
                nearest = distance;
                best = face;
            }
        }
    }
    return best == std::numeric_limits<std::uint32_t>::max() ? -1 : static_cast<std::int32_t>(best);
}

}  // namespace emca::mitsuba06
