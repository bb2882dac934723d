#include "clip_plane.h"

#include <algorithm>
#include <limits>

namespace emca::explorer {

ClipPlane clipPlane(const ClipChoice& choice, const BoundingBox& box, const ViewPose& pose) {
    if (choice.axis == ClipAxis::none || box.empty) return {};
    ClipPlane plane;
    if (choice.axis == ClipAxis::view) plane.normal = pose.direction();
    else plane.normal[static_cast<std::size_t>(choice.axis) - 1] = 1;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < 8; ++i) {
        const Vec3d corner{double(i & 1 ? box.max.x : box.min.x), double(i & 2 ? box.max.y : box.min.y), double(i & 4 ? box.max.z : box.min.z)};
        const double along = dot(plane.normal, corner);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    // From inside of the scene, what lies behind the eye is not seen anyway.
    if (choice.axis == ClipAxis::view && !pose.orthographic) low = std::max(low, dot(plane.normal, pose.position));
    plane.offset = low + std::clamp(double(choice.position), 0.0, 1.0) * std::max(high - low, 0.0);
    if (choice.flip) {
        plane.normal = -plane.normal;
        plane.offset = -plane.offset;
    }
    return plane;
}

}  // namespace emca::explorer
