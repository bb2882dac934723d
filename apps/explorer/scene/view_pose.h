#pragma once

#include <optional>
#include <span>

#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/vector.h"

namespace emca::explorer {

/// Size of the picture in pixels; y grows downwards in everything that is called "pixel" here, as in Qt.
struct Viewport {
    int width = 1, height = 1;
    double aspect() const { return height > 0 ? double(width) / height : 1; }
    friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// From where, in which direction and how wide the 3D view looks. World space. A plain value: every movement is a
/// function from one pose to another, so that flights, "back" and tests need no window.
struct ViewPose {
    Vec3d position{0, 0, 5};
    Vec3d focus;                       ///< on the view axis; zoom and pan keep their scale there
    Vec3d up{0, 1, 0};                 ///< unit, orthogonal to the direction
    double verticalFieldOfView = 45;   ///< degrees
    bool orthographic = false;         ///< then the view is as high as the perspective one is at the focus

    double distance() const { return length(focus - position); }
    Vec3d direction() const;           ///< unit
    Vec3d right() const;               ///< unit
    double heightAtFocus() const;      ///< world height of the view at the focus
    friend bool operator==(const ViewPose&, const ViewPose&) = default;
};

/// Where a world position is seen.
struct ScreenPoint {
    double x = 0, y = 0;   ///< pixels from the top-left corner
    double depth = 0;      ///< distance along the view direction
};

/// Maps world positions to pixels for one pose and one viewport.
class Projection {
  public:
    Projection(const ViewPose& pose, Viewport viewport);
    /// Nothing for positions behind the eye (perspective) and for those that are not finite.
    std::optional<ScreenPoint> project(Vec3d p) const;
    std::optional<ScreenPoint> project(Vec3f p) const { return project(Vec3d{p.x, p.y, p.z}); }
    const Viewport& viewport() const { return viewport_; }
    bool contains(const ScreenPoint& p) const {
        return p.x >= 0 && p.y >= 0 && p.x < viewport_.width && p.y < viewport_.height;
    }

  private:
    Vec3d position_, right_, up_, forward_;
    Viewport viewport_;
    double scale_ = 1;   ///< pixels per unit at depth 1 (perspective) or at any depth (orthographic)
    bool orthographic_ = false;
};

/// The renderer's camera. The whole image is visible: the field of view opens where the view is narrower than the
/// image (`imageAspect` = width / height; 0 if unknown). The focus is at the distance `focus` if that is positive, else at
/// the middle of the scene's box as far as that is in front. Spherical cameras get 60 degrees.
ViewPose poseOfCamera(const Camera& camera, double imageAspect, double viewAspect, const BoundingBox& box, double focus = 0);

/// Looks at the whole box from a corner, for a scene without a camera.
ViewPose poseOfBox(const BoundingBox& box, double viewAspect);

/// The axis of the world, with its sign, that is nearest to a direction; y of equally near ones.
Vec3d nearestAxis(Vec3d direction);

/// From one place to another, upright along the axis of the world that is nearest to the pose's up. Two equal places:
/// the pose as it is.
ViewPose lookingAt(const ViewPose& pose, Vec3d eye, Vec3d target);

/// Eased movement between two poses, t in [0, 1]: rotation along the shortest arc, distance geometrically.
ViewPose between(const ViewPose& a, const ViewPose& b, double t);

/// Smooth start and end: 0 -> 0, 1 -> 1, no velocity at both (3t^2 - 2t^3).
double eased(double t);

/// Turns around `pivot` as a turntable whose axis is `axis` (unit): `yaw` and `pitch` in radians. Stops before the poles.
ViewPose orbited(const ViewPose& pose, Vec3d pivot, Vec3d axis, double yaw, double pitch);

/// Moves sideways so that what is at the focus follows the cursor by (dx, dy) pixels.
ViewPose panned(const ViewPose& pose, Viewport viewport, double dx, double dy);

/// Moves towards (factor < 1) or away from what is under the pixel (x, y), which stays there at the focus' depth.
ViewPose zoomed(const ViewPose& pose, Viewport viewport, double factor, double x, double y);

/// Flies by world distances along the view's direction, right and up; the focus comes along.
ViewPose flown(const ViewPose& pose, double forward, double right, double up);

/// Nearest pose with the same direction that has all points inside the frame, `margin` (fraction of the view, each
/// side) away from its border. Within the slack that remains, the centre is half way between the middle of the points
/// and `interest`, and the focus goes to the depth of `interest`. Points that are not finite are ignored; without any, the pose stays.
ViewPose framed(const ViewPose& pose, Viewport viewport, std::span<const Vec3f> points, double margin,
                std::optional<Vec3f> interest = {});

/// As `framed`, but stays where it is if all points are already inside the margin and not tiny (their extent is at
/// least `minimumExtent` of the view): stepping along a path must not shake the view.
ViewPose framedIfNeeded(const ViewPose& pose, Viewport viewport, std::span<const Vec3f> points, double margin,
                        double minimumExtent, std::optional<Vec3f> interest = {});

}  // namespace emca::explorer
