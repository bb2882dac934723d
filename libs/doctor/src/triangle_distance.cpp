#include "triangle_distance.h"

#include <algorithm>

namespace emca::doctor {
namespace {

Vec3d nearestOnSegment(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d along = b - a;
    const double squared = dot(along, along);
    return squared > 0 ? a + along * std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : a;
}

}  // namespace

NearestPoint nearestPoint(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    // Inside if the projection is on the inner side of all three edges; else the nearest of the points on the edges.
    const Vec3d normal = cross(b - a, c - a);
    const double area = dot(normal, normal);
    const Vec3d corners[] = {a, b, c};
    if (area > 0) {
        bool inside = true;
        for (int i = 0; i < 3; ++i) inside = inside && dot(cross(corners[(i + 1) % 3] - corners[i], p - corners[i]), normal) >= 0;
        if (inside) return {p - normal * (dot(p - a, normal) / area), -1};
    }
    NearestPoint best;
    double least = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3d candidate = nearestOnSegment(p, corners[i], corners[(i + 1) % 3]);
        const double distance = dot(p - candidate, p - candidate);
        if (i > 0 && distance >= least) continue;
        best = {candidate, i};
        least = distance;
    }
    return best;
}

}  // namespace emca::doctor
