#pragma once

#include <cstdint>

#include "emca/core/pixel.h"
#include "emca/core/vector.h"

namespace emca::probe {

/// How a sphere of directions is turned: `pole` is its top, `forward` the middle of a map of it. World space, unit and
/// orthogonal. Seen from inside, right is cross(forward, pole), so that nothing is mirrored.
struct SphereFrame {
    Vec3f pole{0, 0, 1};
    Vec3f forward{1, 0, 0};

    /// The pole as given (any length but 0), and of `forward` what is orthogonal to it; any such direction if there is
    /// nothing.
    static SphereFrame around(Vec3f pole, Vec3f forward);
    Vec3f right() const { return cross(forward, pole); }
    /// Coordinates (forward, left, up) of a direction in world space, and back.
    Vec3d toLocal(Vec3f world) const;
    Vec3f toWorld(Vec3d local) const;
    /// True if both are finite, unit and orthogonal within 1e-3.
    bool isValid() const;
    friend bool operator==(const SphereFrame&, const SphereFrame&) = default;
};

/// A sphere of directions as an image in latitudes and longitudes (equirectangular). The top row is around the pole; the
/// middle column looks along `forward`; longitude grows to the right as a person's view does that turns to the right.
/// Film coordinates are pixels, (0, 0) is the top-left corner of the image:
///     theta = pi y / height, phi = 2 pi (1/2 - x / width),
///     direction = sin(theta) (cos(phi) forward + sin(phi) left) + cos(theta) pole,    left = cross(pole, forward).
/// A plain value.
class SphereMap {
  public:
    SphereMap() = default;
    /// \param width, height  at least 1
    SphereMap(const SphereFrame& frame, std::uint32_t width, std::uint32_t height);

    const SphereFrame& frame() const { return frame_; }
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

    /// Unit, world space.
    Vec3f direction(Vec2d film) const;
    /// Inverse: x in [0, width), y in [0, height]. \param direction  of any length but 0
    Vec2d film(Vec3f direction) const;
    Pixel pixelOf(Vec3f direction) const;

    /// Of one pixel of a row; exactly, so that all pixels together have 4 pi. Steradian.
    double solidAngle(std::uint32_t row) const;
    /// A direction of the pixel, uniformly distributed over its solid angle. \param u  in [0, 1)^2
    Vec3f sample(Pixel pixel, Vec2f u) const;

  private:
    SphereFrame frame_;
    std::uint32_t width_ = 1, height_ = 1;
};

}  // namespace emca::probe
