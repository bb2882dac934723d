#pragma once

#include <cstdint>

#include "view_pose.h"

namespace emca::explorer {

/// Along what the scene is cut: an axis of the world, or the direction of the view.
enum class ClipAxis : std::uint8_t { none = 0, x = 1, y = 2, z = 3, view = 4 };

/// What a person chose.
struct ClipChoice {
    ClipAxis axis = ClipAxis::none;
    float position = 0.35f;   ///< share of the scene along the axis that is cut away from its low (view: near) end, in [0, 1]
    bool flip = false;        ///< the other side is cut away
    bool paths = false;       ///< paths are cut as well
    friend bool operator==(const ClipChoice&, const ClipChoice&) = default;
};

/// Everything with dot(normal, p) < offset is cut away. The default cuts nothing.
struct ClipPlane {
    Vec3d normal;             ///< unit; all zero: no plane
    double offset = 0;
    bool isOn() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
    bool keeps(Vec3d p) const { return !isOn() || dot(normal, p) >= offset; }
    friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// \param box  of the scene; if empty, there is no plane
ClipPlane clipPlane(const ClipChoice& choice, const BoundingBox& box, const ViewPose& pose);

}  // namespace emca::explorer
